# SPDX-License-Identifier: GPL-2.0-or-later
"""The manual page as troff (man macros).

Texts of components are AsciiDoc; the part of it that manuals use is
translated here: paragraphs, lists, literal and listing blocks, block titles,
tables as listings, bold, italic, monospace, links. Lines and escapes that are
troff already (older components) pass unchanged.
"""

from __future__ import annotations

import re

from . import adoc
from .checker import Component

_TROFF_REQUEST = re.compile(
    r"\.(?:B|BI|BR|I|IB|IR|RB|RI|SB|SM|IP|TP|HP|LP|P|PP|RS|RE|EX|EE|SH|SS|UR|UE)(?: "
    r"|$)|\.(?:br|sp|ie|if|nf|fi|in|ti)\b|\.\\\"")
_TROFF_ESCAPE = re.compile(r"\\f[BIRP]|\\-|\\&|\\e|\\\(..")
_FENCES = ("----", "....", "|===", "====", "```", "____", "****", "--")


def escape(text: str) -> str:
    """Plain text to troff; troff escapes that are there stay."""
    out, at = [], 0
    for found in _TROFF_ESCAPE.finditer(text):
        out.append(_escape_plain(text[at:found.start()]))
        out.append(found.group())
        at = found.end()
    out.append(_escape_plain(text[at:]))
    return "".join(out)


def _escape_plain(text: str) -> str:
    text = text.replace("\\", "\\e").replace("-", "\\-").replace("'", "\\(aq")
    return text.replace("“", "\\(lq").replace("”", "\\(rq")


_INLINE = re.compile(
    r"\\(?P<mark>\*\*?|__?|`)"
    r"|\*\*(?P<b2>.+?)\*\*|__(?P<i2>.+?)__"
    r"|(?<![\w*])\*(?P<b1>(?:\\\*|[^\s*])(?:(?:\\\*|[^*])*(?:\\\*|[^\s*]))?)\*(?![\w*])"
    r"|(?<![\w_])_(?P<i1>[^\s_](?:(?:[^_]|_(?=\w))*[^\s_])?)_(?![\w_])"
    r"|`\+?(?P<m>[^`]+?)\+?`"
    r"|(?:link:)?(?P<url>https?://[^\s\[]+)\[(?P<label>[^\]]*)\]"
    r"|(?:link:|xref:)(?P<target>[^\s\[]+)\[(?P<ltext>[^\]]*)\]"
    r"|<<(?P<ref>[^,>]+)(?:,(?P<reftext>[^>]+))?>>", re.S)


def inline(text: str, font: str = "R") -> str:
    """AsciiDoc marks inside a paragraph. font: that of the text around."""
    out, at = [], 0
    for found in _INLINE.finditer(text):
        out.append(escape(text[at:found.start()]))
        part = found.groupdict()
        bold = part["b2"] or part["b1"]
        italic = part["i2"] or part["i1"]
        if part["mark"]:
            out.append(part["mark"])
        elif bold:
            out.append(f"\\fB{inline(bold, 'B')}\\f{font}")
        elif italic:
            out.append(f"\\fI{inline(italic, 'I')}\\f{font}")
        elif part["m"]:
            out.append(f"\\fB{escape(part['m'])}\\f{font}")
        elif part["url"]:
            out.append(escape(f"{part['label']} <{part['url']}>" if part["label"] else part["url"]))
        else:
            out.append(escape(part["ltext"] or part["target"] or part["reftext"] or part["ref"]))
        at = found.end()
    out.append(escape(text[at:]))
    return "".join(out)


def safe(line: str) -> str:
    """A text line may not begin like a request."""
    return "\\&" + line if line[:1] in (".", "'") else line


class _Body:
    """Translates the text of one section."""

    def __init__(self) -> None:
        self.lines: list[str] = []

    def put(self, line: str) -> None:
        self.lines.append(line)

    def paragraph(self, collected: list[str]) -> None:
        if collected:
            for line in inline("\n".join(collected)).split("\n"):
                line = line.strip()
                self.put(safe(line.removesuffix(" +")))
                if line.endswith(" +"):
                    self.put(".br")
            collected.clear()

    def text(self, text: str) -> None:
        pending: list[str] = []
        lines = text.strip("\n").split("\n")
        at = 0
        after_term = False
        while at < len(lines):
            line = lines[at]
            bare = line.strip()
            item = re.match(r"\s*(?:[*-]|\.|[0-9]+\.)\s+(.*)", line)
            term = re.match(r"(\S.*?)::(?:\s+(\S.*))?$", bare)
            if _TROFF_REQUEST.match(bare):
                self.paragraph(pending)
                self.put(bare)
            elif not bare:
                self.paragraph(pending)
                if not after_term:
                    self.put(".PP")
            elif bare == "+" or re.fullmatch(r"\[[^\]]*\]", bare) or bare.startswith("//"):
                self.paragraph(pending)
            elif bare in _FENCES or re.fullmatch(r"(-{4,}|\.{4,}|={4,})", bare):
                self.paragraph(pending)
                at = self.fenced(lines, at)
            elif re.match(r"\.[A-Za-z]", bare):
                self.paragraph(pending)
                self.put("\\fB" + inline(bare[1:], "B") + "\\fR")
                self.put(".br")
            elif re.match(r"={2,4} ", bare):
                self.paragraph(pending)
                self.put(".SS " + escape(bare.lstrip("= ")))
            elif term and (not term.group(2) or " " not in term.group(1).strip("`*_")):
                self.paragraph(pending)
                self.put(".TP")
                self.put(safe(inline(term.group(1))))
                if term.group(2):
                    pending.append(term.group(2))
                after_term = True
                at += 1
                continue
            elif item and not pending:
                self.put(".IP \\(bu 2")
                pending.append(item.group(1))
            elif item and not line[:1].isalnum():
                self.paragraph(pending)
                self.put(".IP \\(bu 2")
                pending.append(item.group(1))
            elif line[:1] in " \t" and not pending and not item:
                at = self.indented(lines, at)
            else:
                pending.append(line)
            after_term = after_term and not bare
            at += 1
        self.paragraph(pending)

    def fenced(self, lines: list[str], at: int) -> int:
        fence = lines[at].strip()
        end = at + 1
        while end < len(lines) and lines[end].strip() != fence:
            end += 1
        if fence in ("--", "====", "****", "____"):
            self.text("\n".join(lines[at + 1:end]))
        else:
            self.literal(lines[at + 1:end])
        return end

    def indented(self, lines: list[str], at: int) -> int:
        end = at
        while end < len(lines) and (lines[end][:1] in (" ", "\t")) and lines[end].strip():
            end += 1
        self.literal(lines[at:end])
        return end - 1

    def literal(self, lines: list[str]) -> None:
        self.put(".RS 4\n.nf")
        for line in lines:
            self.put(safe(escape(line)))
        self.put(".fi\n.RE")


def heading(name: str, number: int | str, source: str, manual: str = "HAL Component") -> list[str]:
    return [f'.\\" Generated by halcompile from {source}',
            f'.TH "{name.upper()}" "{number}" "" "" "{manual}"', ".ad l", ".nh"]


def render_page(text: str, source: str) -> str:
    """A hand-written page: AsciiDoc of the manpage document type. source: its file's name."""
    title = re.search(r"^= (\S+)\((\w+)\)", text, re.M)
    out = heading(title.group(1), title.group(2), source, "Kerf" if title.group(2) == "1" else "HAL Component")
    for section in re.split(r"^== ", text, flags=re.M)[1:]:
        name, _, content = section.partition("\n")
        out.append(f".SH {name.strip()}")
        body = _Body()
        body.text(content)
        out += [line for piece in body.lines for line in piece.split("\n")]
        while out[-1] == ".PP":
            out.pop()
    return "\n".join(out) + "\n"


def render(component: Component) -> str:
    """The whole page."""
    number = adoc.section_number(component)
    out = heading(component.name, number, component.name + ".comp")
    for title, blocks in adoc.document(component):
        out.append(f".SH {title}")
        for number, block in enumerate(blocks):
            body = _Body()
            if number and isinstance(blocks[number - 1], tuple) and not isinstance(block, tuple):
                out.append(".PP")
            if isinstance(block, tuple):
                term, text = block
                out.append(".TP")
                out.append(safe(inline(term)))
                if text:
                    body.text(text)
            else:
                body.text(block)
                body.put(".PP")
            lines = [line for piece in body.lines for line in piece.split("\n")]
            while lines and lines[-1] == ".PP" and isinstance(block, tuple):
                lines.pop()
            if isinstance(block, tuple):
                lines = [".sp" if line == ".PP" else line for line in lines]
            out += lines
        while out[-1] == ".PP":
            out.pop()
    return "\n".join(out) + "\n"
