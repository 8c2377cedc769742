#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""headers.py FOLDER HEADER...: pages of section 3 for the functions of public headers, in FOLDER/man3.

What the headers say of themselves: functions that stand below one comment share a page, found by the name of each;
functions without one share that of their part (a comment with ----). The header itself has a page of its name with
what its head says and the list of its functions.
"""

from __future__ import annotations

import re
import sys
from dataclasses import dataclass, field
from pathlib import Path

from halcompile import man

CONTEXTS = {"init": "while a module is loaded or unloaded, and in ordinary processes; may wait",
            "rt": "in realtime cycles: takes no lock, bounded",
            "user": "in ordinary processes only",
            "task": "in threads of ordinary processes",
            "any": "everywhere"}
TAGS = re.compile(r"\[(?:" + "|".join(CONTEXTS) + r")\]")
FUNCTION = re.compile(r"(?!typedef|struct \w+ *\{|union|enum|extern|[A-Z_]+\()[a-zA-Z][\w *]*?\b\w+\((?!\()")
SENTENCE_ENDS = (r"\.(?:\s|$)", r"(?<=[\w)])[:;](?:\s|$)")
LONGEST_SUMMARY = 100


@dataclass
class Group:
    """Functions of one comment."""
    text: str
    part: str
    part_text: str
    prototypes: list[str] = field(default_factory=list)

    @property
    def names(self) -> list[str]:
        return [re.search(r"(\w+)\(", p).group(1) for p in self.prototypes]

    @property
    def contexts(self) -> list[str]:
        for text in (self.text, self.part, self.part_text):
            if tags := TAGS.findall(text):
                return list(dict.fromkeys(tag[1:-1] for tag in tags))
        return []

    def summary(self, header: str) -> str:
        """The first sentence, or what the part or the header is about when that is of a parameter or too long."""
        text = " ".join(TAGS.sub("", self.text).split())
        first = next((s for s in (re.split(end, text)[0] for end in SENTENCE_ENDS) if len(s) <= LONGEST_SUMMARY), "")
        opening = re.match(r"\W*(\w*)", first).group(1)
        unfit = {"", "NULL", "Legacy", *re.findall(r"\w+", "".join(self.prototypes))}
        if first.startswith("-") or opening in unfit:
            first = TAGS.sub("", self.part).strip() or header
        return first[:1].lower() + first[1:] if re.match(r"A |.[a-z]", first) else first


def comment_text(lines: list[str]) -> str:
    text = "\n".join(re.sub(r"^\s*(?:/\*+|\*(?!/))? ?", "", line) for line in lines)
    return re.sub(r"\s*\*+/\s*$", "", text).strip()


def take(lines: list[str], at: int, done: str) -> tuple[list[str], int]:
    """Lines up to the first that matches; what follows them."""
    end = at
    while end + 1 < len(lines) and not re.search(done, lines[end]):
        end += 1
    return lines[at:end + 1], end + 1


def skip_block(lines: list[str], at: int) -> int:
    """Behind a declaration or definition that begins here."""
    depth, opened = 0, False
    while at < len(lines):
        code = re.sub(r"/\*.*?\*/|\"(?:\\.|[^\"\\])*\"", "", lines[at])
        opened |= "{" in code
        depth += code.count("{") - code.count("}")
        at += 1
        if depth <= 0 and (opened or ";" in code):
            break
    return at


def prototype(lines: list[str]) -> str:
    text = re.split(r"[;{]", " ".join(line.strip() for line in lines))[0]
    text = re.sub(r"\b(?:HAL_INLINE_|static inline|extern)\b|__attribute__\(\(.*\)\)|HAL_PRINTF_\(\d+, \d+\)", "", text)
    return " ".join(text.split()) + ";"


def groups_of(text: str) -> tuple[str, list[Group]]:
    """What the head says, and the groups."""
    lines = text.split("\n")
    head, at = take(lines, 0, r"\*/")
    part, part_text, doc, groups, group = "", "", None, [], None
    while at < len(lines):
        line = lines[at]
        if line.startswith("/*"):
            found, at = take(lines, at, r"\*/")
            doc, group = comment_text(found), None
            if title := re.match(r"-{3,} *(.*?) *-{3,} *(.*)", doc, re.S):
                part, part_text, doc = title.group(1), comment_text(title.group(2).split("\n")), None
        elif not line.strip():
            doc, group, at = None, None, at + 1
        elif line.startswith("#"):
            _, at = take(lines, at, r"(?<!\\)$")
        elif FUNCTION.match(line) and "=" not in line:
            found, _ = take(lines, at, r"[;{]")
            at = skip_block(lines, at)
            if group is None:
                group = next((g for g in groups if doc is None and not g.text and g.part == part), None)
                if group is None:
                    group = Group(doc or "", part, part_text)
                    groups.append(group)
            group.prototypes.append(prototype(found))
        else:
            at = at + 1 if re.match(r"extern \"C\"|RTAPI_\w+_DECLS|}|\w+\(.*\);?$", line) else skip_block(lines, at)
            doc, group = None, None
    return comment_text(head), [g for g in groups if g.prototypes]


def paragraphs(text: str) -> list[str]:
    out = []
    for paragraph in re.split(r"\n\s*\n", text):
        lines = paragraph.split("\n")
        table = [line for line in lines if line.startswith(("  ", "\t"))]
        out += [".PP", *(man.safe(man.escape(line)) for line in lines if line not in table)]
        if table:
            out += [".RS 4", ".nf", *(man.safe(man.escape(line.strip())) for line in table), ".fi", ".RE"]
    return out


def page(name: str, header: str, names: list[str], summary: str, synopsis: list[str], body: list[str]) -> str:
    lines = man.heading(name, 3, header, "Kerf")
    lines += [".SH NAME", man.escape(f"{', '.join(names)} - {summary}"), ".SH SYNOPSIS", ".nf",
              f"#include <{header}>", "", *(man.escape(line) for line in synopsis), ".fi", *body]
    return "\n".join(lines) + "\n"


def write_header(folder: Path, path: Path) -> None:
    head, groups = groups_of(path.read_text())
    head = re.sub(r"SPDX-License-Identifier: \S+\s*", "", head)
    own = path.stem
    said = re.match(rf"{re.escape(path.name)} - ((?:.|\n)*?)(?:\.(?:\s|$)|\n\n|\Z)", head)
    about = " ".join(said.group(1).split()) if said else "a public header"
    for group in groups:
        body = [".SH DESCRIPTION", *paragraphs(TAGS.sub("", group.text).strip() or group.part_text or group.part)]
        if group.text and group.part_text:
            body += [".SH NOTES", *paragraphs(group.part_text)]
        if group.contexts:
            alone = len(group.contexts) == 1
            texts = [f"[{c}] {CONTEXTS[c]}." if alone else f"[{c}] {CONTEXTS[c].removesuffix(' only')}."
                     for c in group.contexts]
            body += [".SH CONTEXT", *(man.escape(text) + "\n.br" for text in texts)]
        body += [".SH SEE ALSO", man.escape(f"{own}(3)")]
        main = group.names[0]
        (folder / f"{main}.3").write_text(
            page(main, path.name, group.names, group.summary(about), group.prototypes, body))
        for name in group.names[1:]:
            (folder / f"{name}.3").write_text(f".so man3/{main}.3\n")
    names = [name for group in groups for name in group.names]
    if names and own not in names:
        body = [".SH DESCRIPTION", *paragraphs(head), ".SH FUNCTIONS",
                man.escape(", ".join(f"{name}(3)" for name in names))]
        (folder / f"{own}.3").write_text(
            page(own, path.name, [own], about, [], body))


def main(folder: str, *headers: str) -> None:
    target = Path(folder) / "man3"
    target.mkdir(parents=True, exist_ok=True)
    for header in headers:
        write_header(target, Path(header))


if __name__ == "__main__":
    main(*sys.argv[1:])
