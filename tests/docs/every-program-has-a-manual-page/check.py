# SPDX-License-Identifier: GPL-2.0-or-later
"""check.py PROGRAM...: prints what is wrong with the manual pages of these programs.

Each has a page of section 1 that names it. A page of docs/man has its sections. The options in bold of a page with
`:source:` stand in those files, and options that the files tell a parser of stand on the page. Pages named in SEE
ALSO exist. The pins of halui are those of its source.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

BUILT = Path("docs/build/man")
SECTIONS = ("NAME", "SYNOPSIS", "DESCRIPTION", "EXIT STATUS", "SEE ALSO")
LETTERS = re.compile(r"""getopt(?:_long|s)?\b[^"'\n]*["']\+?([A-Za-z0-9?:]+)["']""")


def page_of(name: str) -> Path | None:
    path = BUILT / f"man1/{name}.1"
    if not path.exists():
        return None
    if reference := re.match(r"\.so (\S+)\n", path.read_text()):
        path = BUILT / reference.group(1)
    return path if path.exists() else None


def plain(troff: str) -> str:
    return re.sub(r"\\f[BIRP]|\\&", "", troff).replace("\\-", "-")


def check_program(name: str) -> None:
    path = page_of(name)
    if not path:
        print(f"{name}: no manual page")
        return
    names = re.search(r"^\.SH NAME\n(.*?) - ", plain(path.read_text()), re.M | re.S)
    if not names or name not in re.split(r"[,\s]+", names.group(1)):
        print(f"{path}: is not about {name}")


def check_references(path: Path) -> None:
    section = re.search(r"^\.SH SEE ALSO\n(.*?)(?=^\.SH|\Z)", plain(path.read_text()), re.M | re.S)
    for name, number in re.findall(r"([\w.-]+)\(([19])\)", section.group(1) if section else ""):
        if not (BUILT / f"man{number}/{name}.{number}").exists():
            print(f"{path}: there is no {name}({number})")


def told_to_parsers(source: str) -> set[str]:
    """Options that a program's parser knows, as far as one can see."""
    arguments = " ".join(re.findall(r'add_argument\(((?:\s*"-[^"]*",?)+)', source))
    found = set(re.findall(r'"(--?[\w?-]+)"', arguments))
    if "ArgumentParser(" in source and "add_help=False" not in source:
        found |= {"-h", "--help"}
    for letters in LETTERS.findall(source):
        found |= {f"-{c}" for c in letters if c != ":"}
    table = re.findall(r'\{ *"([a-z][\w-]*)", *(?:\d|no_argument|required_argument), ', source)
    found |= {f"--{name}" for name in table}
    return found


def stands_in(option: str, source: str) -> bool:
    name = re.escape(option.lstrip("-"))
    forms = [rf"(?<![\w-]){re.escape(option)}(?![\w-])", rf"[\"']{name}=?[\"']"]
    return any(re.search(form, source) for form in forms) or option in told_to_parsers(source)


def check_options(path: Path, source: str) -> None:
    text = re.sub(r"^----$.*?^----$|^== (PINS|PARAMETERS)$.*?(?=^== )", "", path.read_text(), flags=re.M | re.S)
    documented = set(re.findall(r"(?<![\w*])\*\*?(--?[A-Za-z0-9?][\w-]*)", text))
    for option in sorted(documented):
        if not stands_in(option, source):
            print(f"{path}: {option} is not in the source")
    for option in sorted(told_to_parsers(source) - documented):
        print(f"{path}: {option} is missing")


def check_halui() -> None:
    page = Path("docs/man/halui.adoc").read_text()
    source = Path("src/emc/usr_intf/halui/halui.cc").read_text()
    made = set(re.findall(r'(?:in_\w+|out\w*)\(\s*(?:std::string\()?"([^"]+)"', source))
    made |= set(re.findall(r'(?:out\w*|in_\w+)\(name \+ "([^"]+)"', source))
    for name in sorted(re.sub(r"^%s|%\w+$", "", name) for name in made):
        if not re.search(rf"\*{re.escape(name)}\*", page):
            print(f"halui.adoc: no {name}")
    for name in re.findall(r"\*\*(halui\.[\w.-]*\w)\*\*", page):
        if f'"{name}' not in source and not any(f'"{name}'.endswith(f'.{p}') for p in ("jog-speed", "jog-deadband")):
            print(f"halui.adoc: {name} is not in the source")


def main(programs: list[str]) -> None:
    print("90 programs or more:", len(set(programs)) >= 90)
    for name in sorted(set(programs)):
        check_program(name)
    for path in sorted(BUILT.glob("man?/*")):
        check_references(path)
    for path in sorted([*Path("docs/man").glob("*.adoc*"), *Path("src/hal/components/man").glob("*.adoc")]):
        text = path.read_text()
        for title in SECTIONS:
            if path.parent.name == "man" and path.parts[0] == "docs" and f"\n== {title}\n" not in text:
                print(f"{path}: no {title}")
        if files := re.search(r"^:source: (.*)$", text, re.M):
            check_options(path, "\n".join(Path(f).read_text() for f in files.group(1).split()))
        elif path.parts[0] == "docs":
            print(f"{path}: no :source:")
    check_halui()


main(sys.argv[1:])
