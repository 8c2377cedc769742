# SPDX-License-Identifier: GPL-2.0-or-later
"""Tokens of the declaration part.

The language is context sensitive: `in-0` is one name after a pin type and
a subtraction inside a condition. So the parser says which kinds of token may
stand at the present place, and the longest one wins.
"""

from __future__ import annotations

import ast
import re
import warnings
from dataclasses import dataclass

from .errors import CompError

_BLANK = re.compile(r"(?:\s+|//[^\n]*|/\*.*?\*/)+", re.S)

KINDS = {
    "NAME": re.compile(r"[A-Za-z_][A-Za-z0-9_]*"),
    "HALNAME": re.compile(r"[#A-Za-z_][-#A-Za-z0-9_.]*"),
    "STARREDNAME": re.compile(r"\**[A-Za-z_][A-Za-z0-9_]*"),
    "FPNUMBER": re.compile(
        r"[-+]?(?:(?:[0-9]*\.[0-9]+|[0-9]+\.)(?:[Ee][-+]?[0-9]+)?|[0-9]+[Ee][-+]?[0-9]+)[fF]?"),
    "NUMBER": re.compile(r"0[xX][0-9a-fA-F]+|0[bB][01]+|0[oO][0-7]+|[-+]?[0-9]+"),
    "STRING": re.compile(r'r?"""(?:\\.|[^\\])*?"""|"(?!"")(?:\\.|[^\\"])*"', re.S),
    "HEADER": re.compile(r'"[^"\n]*"|<[^>\n]*>'),
    "OPERATOR": re.compile(r"&&|\|\||==|!=|<<|>>|<=|>=|[-()+*/:?&<>]"),
    "CONDNUMBER": re.compile(r"0[xX][0-9a-fA-F]+|0[bB][01]+|0[oO][0-7]+|[0-9]+"),
    "END": re.compile(r"\Z"),
}


@dataclass(frozen=True)
class Token:
    kind: str      # a key of KINDS, or the literal text itself for keywords and punctuation
    text: str
    offset: int


class Lexer:
    """Reads tokens from the declaration part of a file."""

    def __init__(self, text: str):
        self.text = text
        self.offset = 0

    def skip(self) -> int:
        """Moves over blanks and comments; the offset of the next token."""
        blank = _BLANK.match(self.text, self.offset)
        if blank:
            self.offset = blank.end()
        if self.text.startswith("/*", self.offset):
            raise CompError("Comment without end", self.offset)
        return self.offset

    def peek(self, *kinds: str) -> Token | None:
        """The longest of the wanted tokens that stands here, or None. A kind
        that is not in KINDS is a literal text; a literal word wins over a name of
        the same length."""
        start = self.skip()
        best: Token | None = None
        for kind in kinds:
            if kind in KINDS:
                found = KINDS[kind].match(self.text, start)
                text = found.group() if found else None
            elif kind[0].isalpha():
                found = KINDS["NAME"].match(self.text, start)
                text = kind if found and found.group() == kind else None
            else:
                text = kind if self.text.startswith(kind, start) else None
            if text is None:
                continue
            literal = kind not in KINDS
            if best is None or len(text) > len(best.text) or (literal and len(text) == len(best.text)):
                best = Token(kind, text, start)
        return best

    def take(self, token: Token) -> Token:
        self.offset = token.offset + len(token.text)
        return token


def string_value(token: Token) -> str:
    """The text of a STRING token: a Python literal, which may span lines."""
    literal = token.text
    if not literal.endswith('"""'):
        literal = literal.replace("\n", "\\n")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return ast.literal_eval(literal)
    except (SyntaxError, ValueError) as error:
        raise CompError(f"Bad string: {error}", token.offset) from None
