# SPDX-License-Identifier: GPL-2.0-or-later
import re
from pathlib import Path

from kerf.ini_schema import SCHEMA

# HAL files and HAL library files read these through [SECTION]NAME.
FOLDERS = {"core": ["src", "lib/python/kerf", "lib/hallib", "tcl", "lib/python/rs274", "lib/python/axis"],
           "table": ["lib/python/kerf/ini_schema.py", "lib/python/kerf/check_ini.py",
                     "lib/python/kerf/check_settings.py", "lib/python/kerf/update_ini.py"]}


def words_of(folders, without=()):
    found = set()
    for folder in folders:
        for path in Path(folder).rglob("*"):
            if path.suffix in (".cc", ".hh", ".c", ".h", ".py", ".tcl", ".hal", ".def", "") and path.is_file() \
                    and str(path) not in without:
                comment = (r"//.*|/\*(?s:.*?)\*/" if path.suffix in (".cc", ".hh", ".c", ".h", ".def")
                           else r"(?m)^\s*#.*|\s# .*")
                found.update(re.findall(r"[A-Z][A-Z0-9_]+", re.sub(comment, "", path.read_text(errors="replace"))))
    return found


# Settings of screens that are not part of the tree.
LATER = set("""GRAPHICS_CYCLE_TIME HALPIN_CYCLE_TIME LATHE_WEAR_OFFSETS ANGULAR_INCREMENTS MIN_SPINDLE_SPEED MAX_SPINDLE_SPEED
SPINDLE_INCREMENT MAX_SPINDLE_POWER EMBED_TAB_LOCATION USER_CSS_FILE MACHINE_LOG_PATH PREFERENCE_FILE_PATH MESSAGE_TEXT
MESSAGE_TYPE MESSAGE_PINNAME MESSAGE_BOLDTEXT MESSAGE_DETAILS MESSAGE_ICON MULTIMESSAGE_ID TTT TTT_PREAMBLE
ICON MAX_DISPLAYED_ERRORS DISABLE_REPEAT_KEYS NO_MULTIPLE_DOT_FILENAME MACRO GLADEFILE""".split())

read = words_of(FOLDERS["core"], FOLDERS["table"])
for section, settings in SCHEMA.items():
    missing = [s.name for s in settings.values() if s.is_read and s.name not in read
               and not (section == "DISPLAY" and s.name in LATER)]
    if missing:
        print(f"[{section}]", " ".join(missing))
print("more than 250 settings:", sum(len(s) for s in SCHEMA.values()) > 250)
