# SPDX-License-Identifier: GPL-2.0-or-later
"""check.py PROGRAM... -- MODULE...: prints what is wrong with their manual pages.

Each program has a page of section 1 that names it, each module one of section 9, each function that a public header
declares one of section 3. A page of docs/man has its sections. The options in bold of a page with `:source:` stand in
those files, and options that the files tell a parser of stand on the page. Pages named in SEE ALSO exist, and variables
in ENVIRONMENT. The pins of halui, motion, task and limitcheck stand on their pages.
"""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

BUILT = Path("docs/build/man")
SECTIONS = ("NAME", "SYNOPSIS", "DESCRIPTION", "EXIT STATUS", "SEE ALSO")
TITLE_1 = re.compile(r"^= \S+\(1\)$", re.M)
LETTERS = re.compile(r"""getopt(?:_long|s)?\b[^"'\n]*["']\+?([A-Za-z0-9?:]+)["']""")


def page_of(name: str, section: int) -> Path | None:
    path = BUILT / f"man{section}/{name}.{section}"
    if not path.exists():
        return None
    if reference := re.match(r"\.so (\S+)\n", path.read_text()):
        path = BUILT / reference.group(1)
    return path if path.exists() else None


def plain(troff: str) -> str:
    return re.sub(r"\\f[BIRP]|\\&", "", troff).replace("\\-", "-")


def check_page(name: str, section: int) -> None:
    path = page_of(name, section)
    if not path:
        print(f"{name}: no manual page")
        return
    names = re.search(r"^\.SH NAME\n(.*?) - ", plain(path.read_text()), re.M | re.S)
    if not names or name not in re.split(r"[,\s]+", names.group(1)):
        print(f"{path}: is not about {name}")


def check_references(path: Path) -> None:
    section = re.search(r"^\.SH SEE ALSO\n(.*?)(?=^\.SH|\Z)", plain(path.read_text()), re.M | re.S)
    for name, number in re.findall(r"([\w.-]+)\(([139])\)", section.group(1) if section else ""):
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


def options_on(page: str) -> set[str]:
    text = re.sub(r"^----$.*?^----$|^== (PINS|PARAMETERS)$.*?(?=^== )", "", page, flags=re.M | re.S)
    return set(re.findall(r"(?<![\w*])\*\*?(--?[A-Za-z0-9?][\w-]*)", text))


def check_options(path: Path, source: str) -> None:
    documented = options_on(path.read_text())
    for option in sorted(documented):
        if not stands_in(option, source):
            print(f"{path}: {option} is not in the source")
    for option in sorted(told_to_parsers(source) - documented):
        print(f"{path}: {option} is missing")


def check_functions(library: str) -> None:
    """What a public header declares and the library has can be looked up."""
    declared = "\n".join(path.read_text() for path in Path("include").glob("*.h"))
    symbols = subprocess.run(["nm", "-D", "--defined-only", library], stdout=subprocess.PIPE, text=True, check=True)
    names = re.findall(r" T (\w+)$", symbols.stdout, re.M)
    found = [name for name in names if re.search(rf"\b{name}\(", declared)]
    for name in found:
        if not (BUILT / f"man3/{name}.3").exists():
            print(f"{name}: no manual page")
    if len(found) < 100:
        print(f"{library}: only {len(found)} functions")


def check_environment(pages: list[Path]) -> None:
    sections = [re.search(r"^== ENVIRONMENT$.*?(?=^== )", page.read_text(), re.M | re.S) for page in pages]
    named = {name for section in sections if section for name in re.findall(r"\*([A-Z_]{4,})\*", section.group())}
    known = subprocess.run(["grep", "-IrhowE", "|".join(named), "src", "lib/python", "scripts"],
                           stdout=subprocess.PIPE, text=True, check=False).stdout.split()
    for name in sorted(named - set(known)):
        print(f"no program looks at the variable {name}")


def check_pins(page: str, source: str, *forms: str) -> None:
    """What the forms find in the source are pins; the page has them, in bold, with or without their prefix."""
    text, made = Path(page).read_text(), Path(source).read_text()
    names = {re.sub(r"^%s|%\w+$", "", name) for form in forms for name in re.findall(form, made)}
    for name in sorted(names):
        if not re.search(rf"[*.]{re.escape(name.lstrip('.'))}\*", text):
            print(f"{page}: no {name}")
    if not names:
        print(f"{page}: no pins in {source}")


def main(names: list[str]) -> None:
    between = names.index("--")
    programs, modules = set(names[:between]), set(names[between + 1:]) - {"hal_lib"}     # a part of HAL itself
    print("90 programs or more:", len(programs) >= 90)
    print("150 modules or more:", len(modules) >= 150)
    for section, members in ((1, programs), (9, modules)):
        for name in sorted(members):
            check_page(name, section)
    for path in sorted(BUILT.glob("man?/*")):
        check_references(path)
    for path in sorted([*Path("docs/man").glob("*.adoc*"), *Path("src/hal/components/man").glob("*.adoc")]):
        text = path.read_text()
        for title in SECTIONS if path.parts[0] == "docs" and TITLE_1.search(text) else ():
            if f"\n== {title}\n" not in text:
                print(f"{path}: no {title}")
        if files := re.search(r"^:source: (.*)$", text, re.M):
            check_options(path, "\n".join(Path(f).read_text() for f in files.group(1).split()))
        elif path.parts[0] == "docs" or TITLE_1.search(text) and options_on(text):
            print(f"{path}: no :source:")
    check_functions("lib/liblinuxcnchal.so")
    check_environment(sorted(Path("docs/man").glob("*.adoc*")))
    check_pins("docs/man/halui.adoc", "src/emc/usr_intf/halui/halui.cc",
               r'(?:in_\w+|out\w*)\(\s*(?:std::string\()?"([^"]+)"',
               r'(?:out\w*|in_\w+)\(name \+ "([^"]+)"')
    check_pins("docs/man/motmod.adoc", "src/emc/motion/pins.c", r'ROW\(\w+, "([^"]+)"')
    check_pins("docs/man/milltask.adoc", "src/emc/task/io_control.cc", r'(?:bit|s32)\([^;]*"([a-z-]+)"\);')
    check_pins("docs/man/limitcheck.adoc", "src/emc/motion/limitcheck.c", r'"limitcheck\.%d\.([a-z-]+)"')


main(sys.argv[1:])
