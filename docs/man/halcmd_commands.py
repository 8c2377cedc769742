#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""halcmd_commands.py HALCMD TEMPLATE: the manual page of halcmd, on standard output.

@COMMANDS@ in the template becomes what halcmd itself says about each of its commands.
"""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path


def said(halcmd: str, *words: str) -> str:
    return subprocess.run([halcmd, "-h", *words], stdout=subprocess.PIPE, text=True, check=True).stdout


def paragraphs(halcmd: str) -> str:
    names = re.search(r"^Commands:\n((?: +\S.*\n)+)", said(halcmd), re.M).group(1).split()
    out = []
    for name in names:
        if name == "help":
            out += ["*help* [COMMAND]::", "Explains a command, or lists all.", ""]
            continue
        synopsis, *lines = said(halcmd, name).rstrip("\n").split("\n")
        out.append(f"*{name}*{synopsis.removeprefix(name)}::")
        table = [line.lstrip() for line in lines if line.startswith("  ")]
        out += [line for line in lines if not line.startswith("  ")]
        out += ["....", *table, "...."] if table else []
        out.append("")
    return "\n".join(out)


def main(halcmd: str, template: str) -> None:
    print(Path(template).read_text().replace("@COMMANDS@\n", paragraphs(halcmd)), end="")


if __name__ == "__main__":
    main(*sys.argv[1:])
