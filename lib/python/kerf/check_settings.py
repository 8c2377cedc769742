# SPDX-License-Identifier: GPL-2.0-or-later
"""The part of linuxcnc_check_ini that goes beyond the documented checks.

Unknown names with the nearest known one, values of the wrong type, range or unit, combinations that
cannot work, files that are missing. Everything here is a warning or a remark: a machine that starts
today goes on to start.
"""

import difflib
import fnmatch
import os
import re
import shutil
from pathlib import Path

from .check_probing import dead_tests
from .ini_schema import OLD, OPEN_SECTIONS, SCHEMA

NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?")
MOTION_KEY = 100             # of motmod, where nothing else is said
NEAR = 0.75                  # similarity from which a name is taken for a typing error
# Speeds that no machine of this kind reaches, in units a second: they were meant a minute.
TOO_FAST = {"mm": 3000.0, "inch": 120.0}
TOO_LONG_INCH = 1000.0       # travel of an inch machine that must be in millimetres
INCH_WORDS = ("in", "inch", "imperial")
TEXT_DEPTH, TEXT_FILES = 3, 400     # how far the files beside the INI file are looked at
PROGRAM_SIZE = 100_000       # bytes: longer programs are none that people wrote
PLAIN = ("VERSION", "DISPLAY", "TASK", "HALUI", "PARAMETER_FILE", "COORDINATES", "TPMOD")   # texts without a # or ;
GROUPS = {"EMBED_TAB_NAME": "EMBED_TAB_COMMAND", "MESSAGE_TEXT": "MESSAGE_TYPE"}


def number(text):
    """Value of a number as the readers take it, or None."""
    m = NUMBER.match(text.strip())
    return float(m[0]) if m else None


class Settings:
    def __init__(self, checker, folder):
        self.c, self.ini, self.folder = checker, checker.ini, Path(folder)

    def get(self, section, name, default=None):
        """Number of a setting, or the default when it is missing or none."""
        value = number(self.ini.get(section, name) or "")
        return default if value is None else value

    def run(self):
        for check in (self.names, self.values, self.counts, self.speeds, self.homing, self.combinations,
                      self.files, self.probing):
            check()

    # -- names -------------------------------------------------------------------------------

    @staticmethod
    def pattern_of(section):
        """Section pattern of the schema, or None."""
        for pattern in SCHEMA:
            if fnmatch.fnmatchcase(section, pattern):
                suffix = section[len(pattern) - 1:] if pattern.endswith("*") else ""
                good = {"AXIS_*": r"[XYZABCUVW]", "JOINT_*": r"\d{1,2}", "SPINDLE_*": r"\d"}.get(pattern, "")
                if re.fullmatch(good, suffix):
                    return pattern
        return None

    def texts_of_the_folder(self):
        """All that lies beside the INI file and may use its settings: HAL, Tcl, Python, G-code, panels."""
        if not hasattr(self, "_texts"):
            parts = []
            for folder, folders, files in os.walk(self.folder):
                deep = len(Path(folder).relative_to(self.folder).parts) >= TEXT_DEPTH
                folders[:] = [] if deep else [f for f in folders if not f.startswith(".")]
                if len(parts) >= TEXT_FILES:            # a folder of something else: the start must not wait for it
                    break
                for name in files[:TEXT_FILES]:
                    if name.endswith((".hal", ".tcl", ".py", ".ngc", ".sh", ".xml", ".ui", ".glade")):
                        try:
                            with open(os.path.join(folder, name), errors="replace") as f:
                                parts.append(f.read(1 << 18))
                        except OSError:
                            pass
            self._texts = "\n".join(parts)
        return self._texts

    def is_used(self, section, name):
        """Some file of the machine names this setting of the user's own."""
        if any(f"[{section}]{name}" in v for values in self.ini.sections.values()
               for vs in values.values() for v in vs):
            return True
        texts = self.texts_of_the_folder()
        if re.search(rf"(\[{re.escape(section)}\]\s*\(?|::{re.escape(section)}\(){re.escape(name)}\b", texts, re.I):
            return True
        family = re.sub(r"_?\w$", "", section)
        return re.search(rf"\b{re.escape(name)}\b", texts) is not None and family in texts

    def names(self):
        wild = ["AXIS_X", "JOINT_0", "SPINDLE_0"]
        known = [s for s in SCHEMA if "*" not in s] + wild
        for section, values in self.ini.sections.items():
            if any(fnmatch.fnmatchcase(section, p) for p in OPEN_SECTIONS):
                continue
            pattern = self.pattern_of(section)
            if pattern is None:
                if not any(self.is_used(section, n) for n in values):
                    near = difflib.get_close_matches(section.upper(), known, 1, NEAR)
                    meant = section.upper() if self.pattern_of(section.upper()) else near[0] if near else None
                    hint = f"did you mean [{meant}]?" if meant else "nothing reads it"
                    self.c.warning(f"[{section}]: Unknown section; {hint}", section, next(iter(values)))
                continue
            for name, entries in values.items():
                setting = SCHEMA[pattern].get(name)
                if setting is None:
                    self.unknown(section, pattern, name)
                elif len(entries) > 1 and not setting.is_list and pattern not in ("AXIS_*", "JOINT_*"):
                    self.c.warning(f"[{section}]{name}: Duplicate entry found, values: {entries}", section, name)

    def unknown(self, section, pattern, name):
        old = OLD.get((pattern, name))
        if old is not None:
            if old:
                self.c.warning(f"[{section}]{name}: No longer read; write {old}", section, name)
            else:
                self.c.info(f"[{section}]{name}: No longer read; it can go", section, name)
            return
        if self.is_used(section, name) or section == "FILTER":
            return
        if pattern == "DISPLAY" and re.match(r"(MULTIMESSAGE|MESSAGE|MAX_SPINDLE|MIN_SPINDLE|DEFAULT_SPINDLE)_", name):
            return
        near = difflib.get_close_matches(name.upper(), SCHEMA[pattern], 1, NEAR)
        elsewhere = [s for s in SCHEMA if name in SCHEMA[s]]
        if near:
            self.c.warning(f"[{section}]{name}: Unknown; did you mean {near[0]}?", section, name)
        elif elsewhere:
            self.c.warning(f"[{section}]{name}: Unknown here; it belongs to [{elsewhere[0].replace('*', 'n')}]",
                           section, name)
        else:
            self.c.info(f"[{section}]{name}: Unknown; no program of ours and no file of this folder reads it",
                        section, name)

    # -- values ------------------------------------------------------------------------------

    def values(self):
        for section, values in self.ini.sections.items():
            pattern = self.pattern_of(section)
            for name, entries in values.items():
                setting = SCHEMA.get(pattern, {}).get(name)
                if setting and not setting.is_list:
                    self.value(section, name, setting, entries[0])

    def value(self, section, name, setting, text):
        tag = f"[{section}]{name}"
        where = (section, name)
        comment = re.search(r"\s[#;]", text)
        if comment and (setting.kind != "text" or name in PLAIN):
            self.c.warning(f"{tag}: '{text[comment.start():].strip()}' is part of the value; comments "
                           "stand on lines of "
                           "their own", *where)
        if setting.kind in ("int", "real"):
            m = NUMBER.match(text)
            if not m:
                if not self.c.has_int(section, name):
                    self.c.warning(f"{tag}: '{text}' is no number", *where)
                return
            rest = text[m.end():]
            if re.match(r",\d", rest):
                self.c.warning(f"{tag}: '{text}' is read as {m[0]}; the decimal sign is a point", *where)
            elif rest and not rest[0].isspace() and not re.match(r"0[xXoObB]", text):
                self.c.warning(f"{tag}: '{text}' is read as {m[0]}; write the number alone", *where)
            elif not self.c.has_int(section, name) and not setting.low <= float(m[0]) <= setting.high:
                limits = (f"at least {setting.low:.15g}" if setting.high > 1e100
                          else f"{setting.low:.15g} to {setting.high:.15g}")
                self.c.warning(f"{tag}: {m[0]} is out of range; allowed: {limits}", *where)
        elif setting.kind == "words" and text.upper() not in (w.upper() for w in setting.words) \
                and not self.c.has_enum(section, name):
            self.c.warning(f"{tag}: '{text}' is not one of {', '.join(setting.words)}", *where)
        elif setting.kind == "bool" and not self.c.has_bool(section, name) \
                and text.upper() not in ("TRUE", "YES", "ON", "1", "FALSE", "NO", "OFF", "0"):
            self.c.warning(f"{tag}: '{text}' is neither yes nor no", *where)

    # -- how many ----------------------------------------------------------------------------

    def option(self, section, name, option):
        """Value of option=... in a module line, or None."""
        m = re.search(rf"\b{option}=(\S+)", self.ini.get(section, name) or "")
        return m[1] if m else None

    def counts(self):
        joints = self.c.joints
        for section in self.ini.sections:
            m = re.fullmatch(r"JOINT_(\d+)", section)
            if m and int(m[1]) >= joints:
                self.c.warning(f"[{section}]: Not used; [KINS]JOINTS = {joints} means joints 0 to {joints - 1}",
                               section)
        if any(s.startswith("JOINT_") for s in self.ini.sections):
            for j in range(joints):
                if f"JOINT_{j}" not in self.ini.sections:
                    self.c.warning(f"[JOINT_{j}]: Missing; [KINS]JOINTS = {joints}", "KINS", "JOINTS")
        letters = "".join((self.ini.get("TRAJ", "COORDINATES") or "").upper().split())
        if any(re.fullmatch(r"AXIS_[XYZABCUVW]", s) for s in self.ini.sections):
            for letter in dict.fromkeys(c for c in letters if c in "XYZABCUVW"):
                if f"AXIS_{letter}" not in self.ini.sections:
                    self.c.warning(f"[AXIS_{letter}]: Missing; [TRAJ]COORDINATES = {letters} (1 unit/s, no limits)",
                                   "TRAJ", "COORDINATES")
        for section in self.ini.sections:
            if re.fullmatch(r"AXIS_[XYZABCUVW]", section) and letters and section[5] not in letters:
                self.c.info(f"[{section}]: Not used; [TRAJ]COORDINATES = {letters}", section)
            elif re.fullmatch(r"AXIS_\d", section):
                self.c.warning(f"[{section}]: Axes have letters ([AXIS_X]); motors are [JOINT_n]; update_ini converts",
                               section)
        given = self.option("KINS", "KINEMATICS", "coordinates")
        extra = int(number(self.option("EMCMOT", "EMCMOT", "num_extrajoints") or "0") or 0)
        if given and (self.ini.get("KINS", "KINEMATICS") or "").startswith("trivkins") and len(given) > joints - extra:
            self.c.warning(f"[KINS]JOINTS: {joints} joints are too few for coordinates={given}"
                           + (f" and {extra} extra joints" if extra else ""), "KINS", "JOINTS")
        spindles = self.option("EMCMOT", "EMCMOT", "num_spindles")
        if spindles and number(spindles) != self.get("TRAJ", "SPINDLES", 1):
            self.c.warning(f"[TRAJ]SPINDLES: {self.get('TRAJ', 'SPINDLES', 1):g} here, but [EMCMOT]EMCMOT has "
                           f"num_spindles={spindles}", "TRAJ", "SPINDLES")
        for a, b in GROUPS.items():
            if len(self.ini.all("DISPLAY", a)) != len(self.ini.all("DISPLAY", b)):
                self.c.warning(f"[DISPLAY]{a}: {len(self.ini.all('DISPLAY', a))} of them, but "
                               f"{len(self.ini.all('DISPLAY', b))} {b}", "DISPLAY", a)

    # -- units -------------------------------------------------------------------------------

    def speeds(self):
        units = "inch" if (self.ini.get("TRAJ", "LINEAR_UNITS") or "").lower() in INCH_WORDS else "mm"
        for section in self.ini.sections:
            m = re.fullmatch(r"(JOINT_\d+|AXIS_[XYZUVW])", section)
            if not m or (self.ini.get(section, "TYPE") or "LINEAR").upper() != "LINEAR":
                continue
            for name in ("MAX_VELOCITY", "HOME_SEARCH_VEL", "HOME_LATCH_VEL", "HOME_FINAL_VEL"):
                value = abs(self.get(section, name, 0))
                if TOO_FAST[units] < value < 1e9:
                    self.c.warning(f"[{section}]{name}: {value:g} {units}/s; velocities are per second, not per minute",
                                   section, name)
            for name in ("MIN_LIMIT", "MAX_LIMIT"):
                value = abs(self.get(section, name, 0))
                if units == "inch" and TOO_LONG_INCH < value < 1e9:
                    self.c.warning(f"[{section}]{name}: {value:g} inch; [TRAJ]LINEAR_UNITS = "
                                   f"{self.ini.get('TRAJ', 'LINEAR_UNITS')} while this looks like millimetres",
                                   section, name)
        base, servo = self.get("EMCMOT", "BASE_PERIOD", 0), self.get("EMCMOT", "SERVO_PERIOD", 0)
        for name, value in (("BASE_PERIOD", base), ("SERVO_PERIOD", servo)):
            if 0 < value < 1000:
                self.c.warning(f"[EMCMOT]{name}: {value:g} ns; periods are in nanoseconds", "EMCMOT", name)
        if base > servo > 0:
            self.c.warning(f"[EMCMOT]BASE_PERIOD: {base:g} ns is longer than SERVO_PERIOD ({servo:g} ns)",
                           "EMCMOT", "BASE_PERIOD")
        cycle = self.get("TASK", "CYCLE_TIME", 0)
        if cycle > 1:
            self.c.warning(f"[TASK]CYCLE_TIME: {cycle:g} s; it is in seconds", "TASK", "CYCLE_TIME")
        for section in self.ini.sections:
            if re.fullmatch(r"SPINDLE_\d", section):
                for way in ("FORWARD", "REVERSE"):
                    low = abs(self.get(section, f"MIN_{way}_VELOCITY", 0))
                    high = abs(self.get(section, f"MAX_{way}_VELOCITY", 1e99))
                    if low > high:
                        self.c.warning(f"[{section}]MIN_{way}_VELOCITY: {low:g} rpm is above "
                                       f"MAX_{way}_VELOCITY ({high:g} rpm)",
                                       section, f"MIN_{way}_VELOCITY")
                if self.get(section, "MAX_FORWARD_VELOCITY", 1) == 0:
                    self.c.warning(f"[{section}]MAX_FORWARD_VELOCITY: 0 rpm: M3 will not turn the spindle", section,
                                   "MAX_FORWARD_VELOCITY")

    # -- homing and limits -------------------------------------------------------------------

    def homing(self):
        for j in range(self.c.joints):
            s = f"JOINT_{j}"
            if s not in self.ini.sections:
                continue
            low, high = self.get(s, "MIN_LIMIT", -1e99), self.get(s, "MAX_LIMIT", 1e99)
            home = self.get(s, "HOME", 0)
            if not low <= home <= high:
                self.c.warning(f"[{s}]HOME: {home:g} is outside the joint's limits ({low:g} to {high:g})", s, "HOME")
            search, latch = self.get(s, "HOME_SEARCH_VEL", 0), self.get(s, "HOME_LATCH_VEL", 0)
            if search and not latch:
                self.c.warning(f"[{s}]HOME_LATCH_VEL: 0 with HOME_SEARCH_VEL {search:g}: homing will end in an error",
                               s, "HOME_SEARCH_VEL")
            most = self.get(s, "MAX_VELOCITY", 1)
            if abs(search) > most:
                self.c.warning(f"[{s}]HOME_SEARCH_VEL: {search:g} is above MAX_VELOCITY ({most:g})", s,
                               "HOME_SEARCH_VEL")
            error, least = self.get(s, "FERROR"), self.get(s, "MIN_FERROR")
            if error is not None and least is not None and least > error:
                self.c.warning(f"[{s}]MIN_FERROR: {least:g} is above FERROR ({error:g})", s, "MIN_FERROR")
        for s in self.ini.sections:
            if re.fullmatch(r"JOINT_\d+|AXIS_[XYZABCUVW]", s):
                low, high = self.get(s, "MIN_LIMIT", -1e99), self.get(s, "MAX_LIMIT", 1e99)
                if low >= high and (low or high):
                    self.c.warning(f"[{s}]MIN_LIMIT: {low:g} is not below MAX_LIMIT ({high:g})", s, "MIN_LIMIT")

    # -- what does not go together -----------------------------------------------------------

    def combinations(self):
        ini = self.ini
        if ini.all("HALUI", "MDI_COMMAND") and "HAL" in ini.sections and not ini.get("HAL", "HALUI"):
            self.c.warning("[HALUI]MDI_COMMAND: Has no effect without [HAL]HALUI = halui", "HALUI", "MDI_COMMAND")
        if ini.get("EMCIO", "TOOL_TABLE") and ini.get("EMCIO", "DB_PROGRAM"):
            self.c.info("[EMCIO]TOOL_TABLE: Not read while DB_PROGRAM is set", "EMCIO", "TOOL_TABLE")
        if (number(ini.get("TRAJ", "PLANNER_TYPE") or "") or 0) == 1 and self.get("TRAJ", "MAX_LINEAR_JERK", 1e9) < 1:
            self.c.warning("[TRAJ]PLANNER_TYPE: 1 needs MAX_LINEAR_JERK of at least 1", "TRAJ", "PLANNER_TYPE")
        for section, name, top in (("TRAJ", "DEFAULT_LINEAR_VELOCITY", "MAX_LINEAR_VELOCITY"),
                                   ("TRAJ", "DEFAULT_LINEAR_ACCELERATION", "MAX_LINEAR_ACCELERATION"),
                                   ("DISPLAY", "DEFAULT_LINEAR_VELOCITY", "MAX_LINEAR_VELOCITY"),
                                   ("DISPLAY", "MIN_LINEAR_VELOCITY", "MAX_LINEAR_VELOCITY"),
                                   ("DISPLAY", "MIN_SPINDLE_OVERRIDE", "MAX_SPINDLE_OVERRIDE")):
            low, high = self.get(section, name), self.get(section, top)
            if low is not None and high is not None and low > high:
                self.c.warning(f"[{section}]{name}: {low:g} is above {top} ({high:g})", section, name)
        position = ini.get("EMCIO", "TOOL_CHANGE_POSITION")
        if position and len(position.split()) not in (3, 6, 9):
            self.c.warning(f"[EMCIO]TOOL_CHANGE_POSITION: {len(position.split())} numbers; it takes 3, 6 or 9", "EMCIO",
                           "TOOL_CHANGE_POSITION")
        halfiles = ini.all("HAL", "HALFILE")
        self.motion_key(halfiles)
        if "" in halfiles and any(halfiles[halfiles.index(""):]):
            self.c.warning("[HAL]HALFILE: An empty one ends the list; what follows is not loaded", "HAL", "HALFILE")

    def motion_key(self, halfiles):
        """Task finds motion in shared memory of this key; motmod takes another unless it is told."""
        key = number(self.ini.get("EMCMOT", "SHMEM_KEY") or "")
        if key is None or key == MOTION_KEY or "key=" in (self.ini.get("EMCMOT", "EMCMOT") or ""):
            return
        paths = [self.find(entry.split()[0]) for entry in halfiles if entry.strip()]
        if not any("key=" in Path(p).read_text(errors="replace") for p in paths if p):
            self.c.warning("[EMCMOT]SHMEM_KEY: No HAL file gives motmod key=[EMCMOT]SHMEM_KEY, so task does not find "
                           "it; take the line out",
                           "EMCMOT", "SHMEM_KEY")

    # -- files -------------------------------------------------------------------------------

    def find(self, name):
        """The path of a file as the launcher looks for HAL files, or None."""
        name = os.path.expanduser(name)
        hallib = os.environ.get("HALLIB_DIR", "")
        folders = [str(self.folder) if f == "." else f for f in os.environ.get("HALLIB_PATH", f".:{hallib}").split(":")]
        if name.startswith("LIB:"):
            name, folders = name[4:], [hallib]
        return next((p for p in (os.path.join(f, name) for f in folders) if os.path.isfile(p)), None)

    def path(self, name):
        return self.folder / os.path.expanduser(name)

    def files(self):
        ini = self.ini
        for name in ("HALFILE", "POSTGUI_HALFILE"):
            for n, entry in enumerate(ini.all("HAL", name)):
                if name == "HALFILE" and not entry:
                    break
                for word in entry.split()[:1] if name == "HALFILE" else entry.replace(",", " ").split():
                    if not self.find(word):
                        self.c.warning(f"[HAL]{name}: Cannot find '{word}'", "HAL", name, n + 1)
        for section, values in ini.sections.items():
            pattern = self.pattern_of(section)
            for name, entries in values.items():
                setting = SCHEMA.get(pattern, {}).get(name)
                if setting is None or setting.kind not in ("file", "dir", "dirs"):
                    continue
                for n, entry in enumerate(entries):
                    for part in entry.split(":") if setting.kind == "dirs" else [entry]:
                        self.exists(section, name, n + 1, setting.kind, part.strip())
        if ini.get("EMCIO", "TOOL_TABLE") and not ini.get("EMCIO", "DB_PROGRAM"):
            self.exists("EMCIO", "TOOL_TABLE", 1, "file", ini.get("EMCIO", "TOOL_TABLE"))
        if parameters := ini.get("RS274NGC", "PARAMETER_FILE"):
            path = self.path(parameters)
            if path.is_dir() or path.exists() and not os.access(path, os.R_OK):
                self.exists("RS274NGC", "PARAMETER_FILE", 1, "file", parameters)
            elif path.parent.is_dir() and not os.access(path.parent, os.W_OK):
                self.c.warning(f"[RS274NGC]PARAMETER_FILE: '{parameters}' can not be saved, the folder is not "
                               "writable for this user: offsets will be lost",
                               "RS274NGC", "PARAMETER_FILE")
            elif not path.parent.is_dir():
                self.c.warning(f"[RS274NGC]PARAMETER_FILE: '{parameters}' can not be saved: there is no "
                               f"folder {path.parent}", "RS274NGC", "PARAMETER_FILE")
        for section, name in (("EMCIO", "DB_PROGRAM"), ("TASK", "TASK"), ("DISPLAY", "DISPLAY"), ("HAL", "HALUI")):
            words = (ini.get(section, name) or "").split()
            if words and not self.program(words[0]):
                self.c.warning(f"[{section}]{name}: No program '{words[0]}' in this folder, its bin/ or on PATH",
                               section, name)
        for n, line in enumerate(ini.all("RS274NGC", "REMAP")):
            m = re.search(r"\bngc=(\S+)", line)
            if m and not any((d / f"{m[1]}.ngc").is_file() for d in self.program_folders()):
                self.c.warning(f"[RS274NGC]REMAP: No file {m[1]}.ngc in PROGRAM_PREFIX or SUBROUTINE_PATH "
                               f"({line.split()[0]})",
                               "RS274NGC", "REMAP", n + 1)

    def probing(self):
        """FP-078: macros that branch on the success of a probe move which ends the program without one."""
        files = [f for folder in dict.fromkeys(self.program_folders()) for f in sorted(folder.glob("*.ngc"))]
        for f in files[:TEXT_FILES]:
            if f.is_file() and f.stat().st_size <= PROGRAM_SIZE and os.access(f, os.R_OK):
                for line, code in dead_tests(f.read_text(errors="replace")):
                    self.c.warning(f"{f}:{line}: {code} ends the program when there is no contact, so "
                                   "this test of #5070 "
                                   f"is always true: use {code[:-1]}{int(code[-1]) + 1}")

    def program_folders(self):
        names = [self.ini.get("DISPLAY", "PROGRAM_PREFIX") or "."]
        names += (self.ini.get("RS274NGC", "SUBROUTINE_PATH") or "").split(":")
        folders = [self.path(n.strip()) for n in names if n.strip()] + [self.folder]
        root = self.ini.get("WIZARD", "WIZARD_ROOT")
        return folders + ([p for p in self.path(root).rglob("*") if p.is_dir()] if root else [])

    def program(self, name):
        if name in ("tkemc", "tklinuxcnc", "dummy", "emctask"):
            return True
        if os.path.dirname(name):
            return os.access(self.path(name), os.X_OK)
        return any(os.access(self.folder / d / name, os.X_OK) for d in ("", "bin")) or shutil.which(name) is not None

    def exists(self, section, name, n, kind, value):
        if not value:
            return
        path = self.path(value)
        if kind == "file" and not path.is_file():
            reason = "is a folder" if path.is_dir() else "does not exist"
        elif kind == "file" and not os.access(path, os.R_OK):
            reason = "may not be read by this user"
        elif kind != "file" and not path.is_dir():
            reason = "is not a folder" if path.exists() else "does not exist"
        else:
            return
        self.c.warning(f"[{section}]{name}: '{value}' {reason}", section, name, n)
