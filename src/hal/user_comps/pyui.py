#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Checks _panelui.ini: pyui [FILE]"""

import sys
from pathlib import Path

here = Path(__file__).resolve().parent
if (here.parent / "lib/python/kerf").is_dir():
    sys.path.insert(0, str(here.parent / "lib/python"))

from panelui import config


def main(words):
    if len(words) > 1 or words[:1] in (["-h"], ["--help"]):
        sys.exit(__doc__)
    path = words[0] if words else "_panelui.ini"
    try:
        settings = config.load(path)
    except (config.ConfigError, OSError) as error:
        sys.exit(f"pyui: {error}")
    print(f"{path}: {len(settings.buttons)} buttons, {len(settings.groups)} groups")


if __name__ == "__main__":
    main(sys.argv[1:])
