# SPDX-License-Identifier: GPL-2.0-or-later
"""The syntax tree of a .comp file: one class per declaration.

`offset` is the place of the name (or of the declaration's first word) in the
source text. A `Value` keeps what was written; its meaning depends on where
it stands (see grammar in parser.py).
"""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass(frozen=True)
class Value:
    kind: str          # BOOL NAME FPNUMBER NUMBER STRING
    text: str          # as written; for STRING its evaluated text
    offset: int = 0

    @property
    def truth(self) -> bool:
        return self.text in ("yes", "true", "TRUE")


@dataclass(frozen=True)
class Condition:
    """An expression over `personality`; tokens as written."""
    tokens: tuple[str, ...]
    offset: int

    def text(self, personality: str = "personality") -> str:
        return " ".join(personality if t == "personality" else t for t in self.tokens)


@dataclass(frozen=True)
class Array:
    size: int                           # number of places
    used: Condition | None = None       # how many of them an instance has


@dataclass
class ComponentDecl:
    name: str
    doc: str | None
    offset: int


@dataclass
class Item:
    """A pin or a parameter."""
    kind: str                           # "pin" or "param"
    direction: str                      # in out io, r rw
    type: str
    name: str
    array: Array | None
    start: Value | None
    condition: Condition | None
    doc: str | None
    offset: int


@dataclass
class Function:
    name: str
    fp: str | None
    doc: str | None
    offset: int


@dataclass
class Variable:
    ctype: str
    ctype_offset: int
    stars: str
    name: str
    size: int | None
    value: Value | None
    offset: int


@dataclass
class Option:
    name: str
    value: Value | None
    offset: int


@dataclass
class ModParam:
    type: str
    name: str
    default: Value | None
    doc: str | None
    offset: int


@dataclass
class Include:
    header: str
    offset: int


@dataclass
class Text:
    """description, examples, notes, see_also, author, license."""
    section: str
    text: str
    offset: int


Declaration = Item | Function | Variable | Option | ModParam | Include | Text


@dataclass
class File:
    name: str                           # path as given
    text: str                           # the whole text, newlines are \n
    component: ComponentDecl
    declarations: list[Declaration] = field(default_factory=list)
    code: str = ""                      # what follows the ;;
    code_line: int = 1                  # line number of its first line
