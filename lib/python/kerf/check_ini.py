# SPDX-License-Identifier: GPL-2.0-or-later
"""linuxcnc_check_ini: finds mistakes in an INI file before anything starts.

Exit status: 0 nothing worse than warnings, 1 errors, 2 usage or unreadable file.
Checks and texts here: INI reference, section 5; check_settings.py has what goes beyond.
Each message begins with file and line of the setting, or the file alone when there is none.
"""

import fnmatch
import os
import re
import sys

from .check_settings import Settings
from .inivalues import IniError, IniValues

MANY_JOINTS = 16
AXIS_LETTERS = "XYZABCUVW"
FAR = 1e99

ENUMS = [
    ("TRAJ", "LINEAR_UNITS", "mm,metric,in,inch,imperial", True),
    ("TRAJ", "ANGULAR_UNITS", "deg,degree,grad,gon,rad,radian", True),
    ("JOINT_*", "TYPE", "LINEAR,ANGULAR", False),
    ("AXIS_*", "TYPE", "LINEAR,ANGULAR", False),
    ("DISPLAY", "POSITION_OFFSET", "RELATIVE,MACHINE", False),
    ("DISPLAY", "POSITION_FEEDBACK", "COMMANDED,ACTUAL", False),
    ("EMC", "RCS_DEBUG_DEST", "NULL,STDOUT,STDERR,FILE,LOGGER,MSGBOX", False),
]
BOOLS = {
    "TRAJ": "NO_FORCE_HOMING ARC_BLEND_ENABLE ARC_BLEND_FALLBACK_ENABLE",
    "EMCIO": "TOOL_CHANGE_WITH_SPINDLE_ON TOOL_CHANGE_QUILL_UP TOOL_CHANGE_AT_G30 RANDOM_TOOLCHANGER",
    "RS274NGC": "INI_VARS HAL_PIN_VARS RETAIN_G43 OWORD_NARGS NO_DOWNCASE_OWORD OWORD_WARNONLY "
                "DISABLE_G92_PERSISTENCE DISABLE_AUTO_G54 DISABLE_FANUC_STYLE_SUB",
    "DISPLAY": "DISABLE_CONE_SCALING HOMING_PROMPT LATHE BACK_TOOL_LATHE FOAM",
    "AXIS_*": "WRAPPED_ROTARY",
    "JOINT_*": "LOCKING_INDEXER HOME_USE_INDEX HOME_INDEX_NO_ENCODER_RESET HOME_IGNORE_LIMITS "
               "HOME_IS_SHARED VOLATILE_HOME",
}
INTS = [
    ("EMCMOT", "BASE_PERIOD", 0, 2 ** 63 - 1), ("EMCMOT", "SERVO_PERIOD", 0, 2 ** 63 - 1),
    ("EMCMOT", "TRAJ_PERIOD", 0, 2 ** 63 - 1), ("TRAJ", "SPINDLES", 0, 8), ("TRAJ", "PLANNER_TYPE", 0, 1),
    ("JOINT_*", "COMP_FILE_TYPE", 0, 1), ("JOINT_*", "HOME_ABSOLUTE_ENCODER", 0, 2),
]


def integer(text):
    """Value of an integer as the INI reader takes it, or None."""
    m = re.match(r"\s*([+-]?)(0[xX][0-9a-fA-F]+|0[oO][0-7]+|0[bB][01]+|\d+)", text)
    if not m:
        return None
    digits = m[2]
    base = {"x": 16, "o": 8, "b": 2}.get(digits[1:2].lower(), 10)
    value = int(digits[2:] if base != 10 else digits, base)
    return -value if m[1] == "-" else value


def real(text, default):
    """Value of a real, or the default when there is none or it does not convert."""
    try:
        return float(text.split()[0]) if text else default
    except ValueError:
        return default


class Checker:
    def __init__(self, ini):
        self.ini = ini
        self.messages = {"info": [], "warning": [], "error": []}

    # Messages; the place is the n-th (from 1) NAME of the section, by default what the text begins with.

    def info(self, text, section=None, name=None, n=1):
        self.messages["info"].append((text, section, name, n))

    def warning(self, text, section=None, name=None, n=1):
        self.messages["warning"].append((text, section, name, n))

    def error(self, text, section=None, name=None, n=1):
        self.messages["error"].append((text, section, name, n))

    @staticmethod
    def covered(table, section, name):
        return any(fnmatch.fnmatchcase(section, pattern) and name in names for pattern, names in table)

    def has_enum(self, section, name):
        return self.covered([(p, [n]) for p, n, *_ in ENUMS], section, name)

    def has_bool(self, section, name):
        return self.covered([(p, names.split()) for p, names in BOOLS.items()], section, name)

    def has_int(self, section, name):
        return self.covered([(p, [n]) for p, n, *_ in INTS], section, name)

    def sections(self, pattern):
        return [s for s in self.ini.sections if fnmatch.fnmatchcase(s, pattern)]

    def present(self, pattern, name):
        """(section, value) of each first occurrence in the matching sections."""
        for section in self.sections(pattern):
            value = self.ini.get(section, name)
            if value is not None:
                yield section, value

    # -- the checks, in the documented order; False stops ------------------------------------

    def mandatory(self):
        kinematics, joints = self.ini.get("KINS", "KINEMATICS"), self.ini.get("KINS", "JOINTS")
        good = True
        if kinematics is None:
            self.error("[KINS]KINEMATICS: Missing entry")
            good = False
        elif not kinematics:
            self.error("[KINS]KINEMATICS: Expected a string value")
            good = False
        if joints is None:
            self.error("[KINS]JOINTS: Missing entry")
            return False
        number = integer(joints)
        if number is None:
            self.error("[KINS]JOINTS: Expected an integer value")
            return False
        if not 0 <= number <= MANY_JOINTS:
            self.error(f"[KINS]JOINTS: Integer value '{number}' out of range [0,{MANY_JOINTS}]")
            return False
        self.joints = number
        return good

    def duplicates(self):
        for pattern in ("JOINT_*", "AXIS_*"):
            for section in self.sections(pattern):
                for name, values in self.ini.sections[section].items():
                    if len(values) > 1:
                        self.warning(f"[{section}]{name}: Duplicate entry found, values: {values}")

    def enums(self):
        for pattern, name, words, required in ENUMS:
            if required and self.ini.get(pattern, name) is None:
                self.error(f"[{pattern}]{name}: Missing")
            for section, value in self.present(pattern, name):
                if value.lower() not in words.lower().split(","):
                    self.error(f"[{section}]{name}: Must be one of [{words}]")

    def bools(self):
        for pattern, names in BOOLS.items():
            for name in names.split():
                for section, value in self.present(pattern, name):
                    if value.upper() not in ("TRUE", "YES", "ON", "1", "FALSE", "NO", "OFF", "0"):
                        self.error(f"[{section}]{name}: Invalid boolean value")

    def ints(self):
        for pattern, name, low, high in INTS:
            for section, value in self.present(pattern, name):
                number = integer(value)
                if number is None:
                    self.error(f"[{section}]{name}: Invalid integer value")
                elif not low <= number <= high:
                    self.error(f"[{section}]{name}: Integer value '{number}' out of range [{low},{high}]")

    def module(self, section, name):
        """Module name and options of `module opt=val ...`."""
        words = (self.ini.get(section, name) or "").split()
        if not words:
            self.error(f"[{section}]{name}: Missing content")
            return "", {}
        options = {}
        for word in words[1:]:
            key, equals, value = word.partition("=")
            if not equals:
                self.error(f"[{section}]{name}: Option '{word}' is missing a '=' and value")
            elif key in options:
                self.error(f"[{section}]{name}: Duplicate option key '{key}'")
            else:
                options[key] = value
        return words[0], options

    def motion(self):
        if self.ini.get("EMCMOT", "EMCMOT") is None:
            return
        _, options = self.module("EMCMOT", "EMCMOT")
        if "num_extrajoints" in options:
            self.info(f"Extra joints specified={options['num_extrajoints']}; [KINS]JOINTS={self.joints} must "
                      "accommodate kinematic joints *plus* extra joints")

    def kinematics(self):
        name, options = self.module("KINS", "KINEMATICS")
        letters = options.get("coordinates", "").upper()
        for letter in letters:
            if letter not in AXIS_LETTERS:
                self.error(f"Invalid axis '{letter}' in kinematics coordinates option")
                return
        if name != "trivkins":
            if name:
                self.info(f"[KINS]KINEMATICS={self.ini.get('KINS', 'KINEMATICS')}: Unchecked")
            return
        self.trivkins(letters)

    def speeds(self, section):
        names = ["MAX_VELOCITY", "MAX_ACCELERATION"]
        if (integer(self.ini.get("TRAJ", "PLANNER_TYPE", "0")) or 0) > 0:
            names.append("MAX_JERK")
        for name in names:
            if self.ini.get(section, name) is None:
                default = "0.0" if name == "MAX_JERK" else "1.0"
                self.warning(f"[{section}]{name}: Unspecified, default used: {default}")

    def limit(self, section, name, default):
        text = self.ini.get(section, name)
        if text is None and section.startswith("AXIS"):
            self.warning(f"[{section}]{name}: Unspecified, default used: {default:g}")
        return real(text, default)

    def trivkins(self, given):
        letters = given or AXIS_LETTERS
        for joint in range(self.joints):
            self.speeds(f"JOINT_{joint}")
        for letter in dict.fromkeys(letters):
            axis = f"AXIS_{letter}"
            if axis not in self.ini.sections:
                continue
            self.speeds(axis)
            low, high = self.limit(axis, "MIN_LIMIT", -FAR), self.limit(axis, "MAX_LIMIT", FAR)
            for joint, owner in enumerate(letters[:self.joints]):
                if owner != letter:
                    continue
                section = f"JOINT_{joint}"
                joint_low, joint_high = self.limit(section, "MIN_LIMIT", -FAR), self.limit(section, "MAX_LIMIT", FAR)
                if joint_low > low:
                    self.error(f"[{section}]MIN_LIMIT > [{axis}]MIN_LIMIT ({joint_low:g} > {low:g})")
                if joint_high < high:
                    self.error(f"[{section}]MAX_LIMIT < [{axis}]MAX_LIMIT ({joint_high:g} < {high:g})")
        self.groups(letters)
        wanted = "".join((self.ini.get("TRAJ", "COORDINATES") or "").split()).upper()
        if given and given != AXIS_LETTERS and given != wanted:
            self.warning(f"Inconsistent coordinates specifications: trivkins coordinates={given} vs. "
                         f"[TRAJ]COORDINATES={wanted}")

    def groups(self, letters):
        """Joints that drive one axis together have to home together, or they rack it."""
        for joint in range(self.joints):
            if re.match(r"-0+$", (self.ini.get(f"JOINT_{joint}", "HOME_SEQUENCE") or "").strip()):
                self.error(f"[JOINT_{joint}]HOME_SEQUENCE=-0 makes no group: number groups from -1")
        for letter in dict.fromkeys(letters):
            joints = [j for j, owner in enumerate(letters[:self.joints]) if owner == letter]
            numbers = {integer(self.ini.get(f"JOINT_{j}", "HOME_SEQUENCE", "999")) for j in joints}
            if len(joints) > 1 and (len({abs(n or 0) for n in numbers}) > 1 or min(n or 0 for n in numbers) >= 0):
                self.warning(f"Joints {', '.join(map(str, joints))} drive {letter} together but can be "
                             "homed and jogged "
                             "apart: give them the same negative HOME_SEQUENCE")

    def run(self):
        """The documented checks. False: what is mandatory is missing, nothing else was looked at."""
        if not self.mandatory():
            return False
        for check in (self.duplicates, self.enums, self.bools, self.ints, self.motion, self.kinematics):
            check()
        return True

    def places(self, path):
        """{(section, name, n): "file:line"} of the settings that messages are about."""
        import linuxcnc
        ini = linuxcnc.ini(path)
        found = {}
        for texts in self.messages.values():
            for text, section, name, n in texts:
                m = re.match(r"\[(\S+?)\](\w*)", text)
                if section is None and m:
                    section, name = m[1], m[2]
                if name is None and section in self.ini.sections:
                    name = next(iter(self.ini.sections[section]), None)
                if name and name in self.ini.sections.get(section, {}):
                    file, line = ini.lineof(section, name, n)
                    if file:
                        found[text] = f"{file}:{line}"
        return found


def check(ini, path, strict=False, dry_run=False):
    """Prints what is wrong with an INI file; 1 when a machine must not start with it, else 0.

    strict: warnings are errors. dry_run: the HAL files are loaded too.
    """
    checker = Checker(ini)
    if checker.run():
        Settings(checker, os.path.dirname(path) or ".").run()
    if dry_run and not checker.messages["error"]:
        from .dry_run import load_hal
        for text in load_hal(path):
            checker.error(text)
    places = checker.places(path) if any(checker.messages.values()) else {}
    for kind, texts in checker.messages.items():
        for text, *_ in texts:
            print(f"{places.get(text, path)}: {kind}: {text}", file=sys.stderr)
    bad = checker.messages["error"] or (strict and checker.messages["warning"])
    return 1 if bad else 0


def main(argv):
    usage = ("Usage: linuxcnc_check_ini [-e|--error] [-n|--dry-run] [-h|--help] FILE\n"
             "  -e  warnings are errors\n"
             "  -n  also load the HAL files, in an instance of its own; no thread is started and no display,\n"
             "      but programs and drivers that the HAL files name are loaded")
    if any(a in ("-h", "--help") for a in argv):
        print(usage)
        return 2
    files = [a for a in argv if not a.startswith("-")]
    options = {"-e": "error", "--error": "error", "-n": "dry-run", "--dry-run": "dry-run"}
    unknown = [a for a in argv if a.startswith("-") and a not in options]
    if unknown:
        print(f"Unhandled option: '{unknown[0]}'", file=sys.stderr)
        return 2
    wanted = {options[a] for a in argv if a in options}
    if len(files) != 1:
        print("Must have exactly one argument specifying the INI-file path.", file=sys.stderr)
        return 2
    path = files[0]
    try:
        ini = IniValues(path)
    except IniError as e:
        sys.stderr.write(str(e))
        return 2
    return check(ini, path, "error" in wanted, "dry-run" in wanted)
