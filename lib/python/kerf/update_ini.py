# SPDX-License-Identifier: GPL-2.0-or-later
"""update_ini: brings configurations of older versions to version 1.1.

1.0 to 1.1 renames spindle pins in HAL files. Older files (axes instead of joints) are
written anew with [KINS], [AXIS_L] and [JOINT_n]. All plain files of the folder are
copied to a backup folder first. Rules: INI reference, section 9.
"""

import getopt
import math
import os
import re
import shutil
import sys
from datetime import datetime
from pathlib import Path

CANCELLED = 42
LETTERS = "XYZABCUVW"
SPINDLE_PINS = ("brake forward index-enable inhibit on reverse revs speed-in speed-out speed-out-abs speed-out-rps "
                "speed-out-rps-abs orient-angle orient-mode orient is-oriented orient-fault locked at-speed")
HALUI_SPINDLE_PINS = ("brake-is-on brake-off brake-on decrease forward increase is-on reverse runs-backward "
                      "runs-forward start stop override.count-enable override.counts override.decrease "
                      "override.direct-value override.increase override.scale override.value")
JOINT_PINS = ("active amp-enable-out amp-fault-in backlash-corr backlash-filt backlash-vel coarse-pos-cmd error "
              "f-error f-error-lim f-errored faulted free-pos-cmd free-tp-enable free-vel-lim home-state home-sw-in "
              "homed homing in-position index-enable is-unlocked joint-pos-cmd joint-pos-fb joint-vel-cmd "
              "kb-jog-active motor-offset motor-pos-cmd motor-pos-fb neg-hard-limit neg-lim-sw-in pos-hard-limit "
              "pos-lim-sw-in unlock wheel-jog-active")
JOINT_RENAMES = {"joint-pos-cmd": "pos-cmd", "joint-pos-fb": "pos-fb", "joint-vel-cmd": "vel-cmd"}
TRAJ_RENAMES = {"MAX_VELOCITY": "MAX_LINEAR_VELOCITY", "DEFAULT_VELOCITY": "DEFAULT_LINEAR_VELOCITY",
                "MAX_ACCELERATION": "MAX_LINEAR_ACCELERATION", "DEFAULT_ACCELERATION": "DEFAULT_LINEAR_ACCELERATION"}
AXIS_ITEMS = ("MIN_LIMIT", "MAX_LIMIT", "MAX_VELOCITY", "MAX_ACCELERATION")
ORDER = ("EMC", "DISPLAY", "FILTER", "RS274NGC", "EMCMOT", "TASK", "HAL", "HALUI", "TRAJ", "EMCIO")


def read_sections(text):
    """([lines before the first section], {section: [lines]}) in file order."""
    head, sections, current = [], {}, None
    for line in text.splitlines():
        m = re.match(r"\s*\[\s*(\w+)\s*\]", line)
        if m:
            current = sections.setdefault(m[1], [])
        elif current is None:
            head.append(line)
        else:
            current.append(line)
    return head, sections


def value(lines, name):
    """First value of a variable in a section's lines, or None."""
    for line in lines or []:
        m = re.match(rf"\s*{name}\s*=\s*(.*?)\s*$", line)
        if m:
            return m[1]
    return None


def values(lines, name):
    return [m[1] for line in lines or [] if (m := re.match(rf"\s*{name}\s*=\s*(.*?)\s*$", line))]


def without(lines, *names):
    pattern = "|".join(names)
    return [line for line in lines if not re.match(rf"\s*(?:{pattern})\s*=", line)]


def renamed(lines, old, new):
    return [re.sub(rf"^(\s*){old}(\s*=)", rf"\g<1>{new}\2", line) for line in lines]


def rename_spindle_pins(text):
    """The change of HAL files from 1.0 to 1.1."""
    for name in SPINDLE_PINS.split():
        text = re.sub(rf"\bmotion\.spindle-{re.escape(name)}(?![\w.-])", f"spindle.0.{name}", text)
    for name in HALUI_SPINDLE_PINS.split():
        text = re.sub(rf"\bhalui\.spindle\.{re.escape(name)}(?![\w.-])", f"halui.spindle.0.{name}", text)
    return text


def unit_words(lines):
    """[TRAJ] lines with words instead of numbers: units per mm, units per degree."""
    known = {"LINEAR_UNITS": (("mm", 1.0), ("inch", 1 / 25.4)),
             "ANGULAR_UNITS": (("degree", 1.0), ("grad", 10 / 9), ("grad", 0.9), ("radian", math.pi / 180))}
    changed = []
    for line in lines:
        m = re.match(r"(\s*(LINEAR_UNITS|ANGULAR_UNITS)\s*=\s*)([\d.eE+-]+)\s*$", line)
        try:
            near = [w for w, v in known[m[2]] if abs(float(m[3]) / v - 1) < 1e-3] if m else []
        except ValueError:
            near = []
        changed.append(m[1] + near[0] if near else line)
    return changed


class OldConfig:
    """A configuration of before 1.0, where [AXIS_n] meant both axis and joint."""

    def __init__(self, text, hal_texts):
        self.head, self.sections = read_sections(text)
        self.hal = "\n".join(hal_texts)
        traj = self.sections.get("TRAJ", [])
        letters = (value(traj, "COORDINATES") or "X Y Z").replace(" ", "").upper()
        axes = int(value(traj, "AXES") or len(letters))
        if axes == 9 and len(letters) < 9:
            letters = LETTERS
        self.letters = letters
        self.numbers = [LETTERS.index(c) for c in letters]
        self.tandem = self.gantry_letters()
        if self.tandem:
            self.letters, self.numbers = self.tandem, list(range(len(self.tandem)))

    def gantry_letters(self):
        """Letters of gantrykins.joint-N, or "" on other machines."""
        if not re.search(r"^\s*loadrt\s+gantrykins\b", self.hal, re.M):
            return ""
        found = dict(re.findall(r"^\s*setp\s+gantrykins\.joint-(\d)\s+(\w)", self.hal, re.M))
        return "".join(found[k].upper() if not found[k].isdigit() else LETTERS[int(found[k])] for k in sorted(found))

    def kinematics(self):
        m = re.search(r"^\s*loadrt\s+(\w*kins\w*)", self.hal, re.M)
        name = m[1] if m else "trivkins"
        if name == "gantrykins":
            return f"trivkins coordinates={self.tandem or self.letters} kinstype=BOTH"
        if name in ("gentrivkins", "trivkins"):
            return f"trivkins coordinates={self.letters}"
        return name

    def rs274ngc(self):
        lines = self.sections.get("RS274NGC", [])
        features = value(lines, "FEATURES")
        if features is None:
            return lines
        bits = int(features, 0)
        new = [f"RETAIN_G43 = {bits & 1}", f"INI_VARS = {bits >> 2 & 1}", f"HAL_PIN_VARS = {bits >> 3 & 1}"]
        new += [f"{name} = 1" for name, bit in (("OWORD_NARGS", 2), ("NO_DOWNCASE_OWORD", 0x10),
                                                ("OWORD_WARNONLY", 0x20)) if bits & bit]
        return without(lines, "FEATURES") + new

    def traj(self):
        lines = without(self.sections.get("TRAJ", []), "AXES", "CYCLE_TIME", "COORDINATES")
        for old, new in TRAJ_RENAMES.items():
            lines = renamed(lines, old, new)
        if value(lines, "MAX_LINEAR_VELOCITY") is None:
            fastest = max((float(v) for n in self.numbers
                           for v in values(self.sections.get(f"AXIS_{n}"), "MAX_VELOCITY")), default=1.0)
            lines.append(f"MAX_LINEAR_VELOCITY = {fastest:g}")
        lines = unit_words(lines)
        return [f"COORDINATES = {self.letters}"] + lines

    def is_tandem(self, number):
        return self.letters.count(self.letters[self.numbers.index(number)]) > 1

    def joint(self, number):
        lines = [re.sub(r"^(\s*HOME_SEQUENCE\s*=\s*)-1\s*$", r"# \1-1", line)
                 for line in without(self.sections.get(f"AXIS_{number}", []), "LOCKING_INDEXER_JOINT")]
        # Groups are numbered from -1: with one at 0 every sequence moves up by one.
        up = any(self.is_tandem(n) and value(self.sections.get(f"AXIS_{n}"), "HOME_SEQUENCE") == "0"
                 for n in self.numbers)
        sign = "-" if self.is_tandem(number) else ""
        return [re.sub(r"^(\s*HOME_SEQUENCE\s*=\s*)(\d+)", lambda m: f"{m[1]}{sign}{int(m[2]) + up}", line)
                for line in lines]

    def text(self, backup):
        out = [f"# This config file was created {datetime.now():%Y-%m-%d %H:%M:%S} by the update_ini script",
               f"# The original config files may be found in the {backup} directory"] + self.head
        emc = without(self.sections.get("EMC", []), "VERSION")
        parts = dict(self.sections, EMC=["VERSION = 1.1"] + emc, RS274NGC=self.rs274ngc(), TRAJ=self.traj(),
                     EMCMOT=without(self.sections.get("EMCMOT", []), "COMM_WAIT"))
        done = set()
        for name in ORDER:
            if name in parts:
                out += [f"[{name}]"] + parts[name]
                done.add(name)
        out += ["[KINS]", f"KINEMATICS = {self.kinematics()}", f"JOINTS = {len(self.letters)}", ""]
        seen = set()
        for letter, number in zip(self.letters, self.numbers):
            old = self.sections.get(f"AXIS_{number}", [])
            if letter not in seen:
                out += ["", f"[AXIS_{letter}]"] if out[-1].strip() else [f"[AXIS_{letter}]"]
                out += [f"{item} = {value(old, item)}" for item in AXIS_ITEMS if value(old, item) is not None]
                if value(old, "LOCKING_INDEXER") is not None:
                    out.append(f"LOCKING_INDEXER_JOINT = {self.numbers.index(number)}")
                out.append("")
                seen.add(letter)
                for index in (i for i, c in enumerate(self.letters) if c == letter):
                    out += [f"[JOINT_{index}]"] + self.joint(self.numbers[index])
                    done.add(f"AXIS_{self.numbers[index]}")
        for name, lines in self.sections.items():
            if name not in done and name != "KINS" and not re.fullmatch(r"AXIS_\d", name):
                out += [f"[{name}]"] + lines
        return "\n".join(out) + "\n"

    def hal_text(self, text):
        """A HAL file with joints and axes told apart."""
        for index, number in enumerate(self.numbers):
            for pin in JOINT_PINS.split():
                text = re.sub(rf"\baxis\.{number}\.{pin}(?![\w-])",
                              f"joint.{index}.{JOINT_RENAMES.get(pin, pin)}", text)
            letter = self.letters[index].lower()
            lines = []
            for line in text.splitlines(keepends=True):
                # `net` takes both pins, other commands come twice
                joint, axis = f"joint.{index}.jog-", f"axis.{letter}.jog-"
                wheel = rf"\baxis\.{number}\.jog-(counts|enable|scale|vel-mode)(?![\w-])"
                if not re.search(wheel, line):
                    lines.append(line)
                elif re.match(r"\s*net\s", line):
                    lines.append(re.sub(wheel, rf"{joint}\1 {axis}\1", line))
                else:
                    lines += [re.sub(wheel, rf"{joint}\1", line.rstrip("\n") + "\n"), re.sub(wheel, rf"{axis}\1", line)]
            text = "".join(lines)
            text = re.sub(rf"\bhalui\.(?:jog|axis)\.{number}\.", f"halui.axis.{letter}.", text)
            text = re.sub(rf"\bhalui\.joint\.{number}\.((?:is-)?select(?:ed)?)(?![\w-])",
                          rf"halui.axis.{letter}.\1", text)
        # at once: [AXIS_2] may become [JOINT_1]
        text = re.sub(r"(\[|\$::|\$)AXIS_(\d)(?=[\](])",
                      lambda m: f"{m[1]}JOINT_{self.numbers.index(int(m[2]))}" if int(m[2]) in self.numbers else m[0],
                      text)
        for old, new in TRAJ_RENAMES.items():
            text = re.sub(rf"(\[TRAJ\]\(?|\$(?:::)?TRAJ\(){old}\b", rf"\g<1>{new}", text)
        text = re.sub(r"\bhalui\.jog\.selected\.", "halui.axis.selected.", text)
        text = re.sub(r"\bhalui\.jog-(speed|deadband)(?![\w-])", r"halui.axis.jog-\1", text)
        text = re.sub(r"^(\s*)loadrt\s+(\w*kins\w*)(.*)$", r"\1loadrt [KINS]KINEMATICS\n#autoconverted \2\3", text,
                      count=1, flags=re.M)
        text = re.sub(r"\[TRAJ\](\(?)AXES\b", r"[KINS]\1JOINTS", text)
        text = re.sub(r"\$(::)?TRAJ\(AXES\)", r"$\1KINS(JOINTS)", text)
        text = re.sub(r"\bshuttle(?:xpress|pro)\b", "shuttle", text)
        text = re.sub(r"^(\s*setp\s+gantrykins\.)", r"#\1", text, flags=re.M)
        return rename_spindle_pins(text)


def hal_files(folder, sections):
    """HAL files of the INI file that belong to the configuration's folder."""
    hal = sections.get("HAL", [])
    names = [v.split()[0] for v in values(hal, "HALFILE") + values(hal, "POSTGUI_HALFILE") if v]
    if (folder / "touchy.hal").exists():
        names.append("touchy.hal")
    found = []
    for name in dict.fromkeys(names):
        if (folder / name).is_file():
            found.append(folder / name)
        elif (folder / "hallib" / name).is_file():
            shutil.copyfile(folder / "hallib" / name, folder / name)
            found.append(folder / name)
    return found


def read(path):
    """Its text; bytes that are no UTF-8 (comments in Latin-1, say) come back unchanged with replace()."""
    return path.read_text(encoding="utf-8", errors="surrogateescape")


def replace(texts):
    """Gives files new texts: all are written before the first is replaced."""
    for path, text in texts.items():
        new = path.with_name(path.name + ".new")
        with open(new, "w", encoding="utf-8", errors="surrogateescape") as f:
            f.write(text)
            f.flush()
            os.fsync(f.fileno())
        shutil.copymode(path, new)
    for path in texts:
        os.replace(path.with_name(path.name + ".new"), path)


def backup_of(folder, name):
    target = folder / f"{name}.old"
    while target.exists():
        target = target.with_name(target.name + ".old")
    target.mkdir()
    for f in folder.iterdir():
        if f.is_file():
            shutil.copy2(f, target / f.name)
    return target


def agreed(question, dialogs):
    """The user's yes or no, in a window or on the terminal."""
    if dialogs:
        import tkinter
        from tkinter import messagebox

        from . import tkstyle
        try:
            root = tkinter.Tk(className="Update_ini")
        except tkinter.TclError as e:
            raise UpdateError(f"{e}: without -d it asks on the terminal, with -f not at all") from None
        root.withdraw()
        tkstyle.apply(root)
        answer = messagebox.askyesno("update_ini", question)
        root.destroy()
        return answer
    try:
        return input(question + " [Y/n] ").strip().lower() in ("", "y", "yes")
    except EOFError:
        print()
        return False


class UpdateError(Exception):
    """The configuration stays as it was; the text says why."""


def convert(path, version):
    """Rewrites the configuration, the INI file last; returns the backup folder."""
    try:
        text = read(path)
        _, sections = read_sections(text)
        texts = {f: read(f) for f in hal_files(path.parent, sections)}
        backup = backup_of(path.parent, path.stem)
        if version == "1.0" or "KINS" in sections and "JOINT_0" in sections:    # joints and axes are told apart already
            known = value(sections.get("EMC"), "VERSION") is not None
            head = r"(?m)(^\s*\[\s*EMC\s*\][^\[]*?^\s*VERSION\s*=\s*).*$" if known else r"(?m)^(\s*\[\s*EMC\s*\].*\n)"
            changed, count = re.subn(head, r"\g<1>1.1" if known else r"\g<1>VERSION = 1.1\n", text, count=1)
            new = {f: rename_spindle_pins(old) for f, old in texts.items()}
            new[path] = changed if count else "[EMC]\nVERSION = 1.1\n" + text
        else:
            old_config = OldConfig(text, list(texts.values()))
            new = {f: old_config.hal_text(old) for f, old in texts.items()}
            new[path] = old_config.text(backup.name)
        replace(new)
    except OSError as e:
        raise UpdateError(f"{path}: version {version} can't be updated to 1.1: {e.filename or path.parent}: "
                          f"{e.strerror} (the folder has to be writable)") from None
    return backup


def main(argv):
    try:
        options, files = getopt.getopt(argv, "df")
    except getopt.GetoptError as e:
        print(f"update_ini: {e}\nUsage: update_ini [-d] [-f] FILE")
        return 0
    flags = [o for o, _ in options]
    if len(files) != 1:
        print("Usage: update_ini [-d] [-f] FILE")
        return 0
    path = Path(re.sub(r"\.expanded$", "", files[0])).resolve()
    try:
        _, sections = read_sections(read(path))
    except OSError as e:
        print(f"update_ini: {path}: {e.strerror}", file=sys.stderr)
        return 1
    version = value(sections.get("EMC"), "VERSION") or "0.0"
    if version.startswith("$"):
        version = "0.1"
    if version >= "1.1":
        print(f"{path.name}: already at version {version}")
        return 0
    if "-f" not in flags:
        question = (f"{path.name} has version {version}. It will be updated to 1.1; the present files are "
                    "kept in a backup folder. Go on?")
        if value(sections.get("KINS"), "JOINTS") and version != "1.0":
            question = f"{path.name} looks as if it had been updated already. " + question
        try:
            if not agreed(question, "-d" in flags):
                return CANCELLED if "-d" in flags else 0
        except UpdateError as e:
            print(f"update_ini: {e}", file=sys.stderr)
            return 1
    try:
        backup = convert(path, version)
    except UpdateError as e:
        print(f"update_ini: {e}", file=sys.stderr)
        return 1
    if "-f" in flags:
        shutil.rmtree(backup)
    else:
        print(f"Updated; the old files are in {backup}")
    return 0
