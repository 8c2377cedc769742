# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs a small program with and without each setting that the interpreter reads: prints what differs."""
import difflib
import os
import re
import subprocess
from pathlib import Path

CIRCLE = "G21 G90 G0 X0 Y0\nF100 G2 X10.015 Y0 I5 J0\nM2\n"  # 0.015 mm between the radii
CASES = [  # settings ("SECTION.NAME=VALUE"), program
    ("RS274NGC.PROGRAM_START_CODE=G61", "G64\nG0 X1\nM2\n"),
    ("RS274NGC.G64_DEFAULT_TOLERANCE=0.25", "G21 G64\nM2\n"),
    ("RS274NGC.G64_DEFAULT_NAIVETOLERANCE=0.125", "G21 G64\nM2\n"),
    ("RS274NGC.CENTER_ARC_RADIUS_TOLERANCE_MM=0.005", CIRCLE),
    ("RS274NGC.CENTER_ARC_RADIUS_TOLERANCE_INCH=0.0001", "G20 G90 G0 X0 Y0\nF10 G2 X1.0015 Y0 I0.5 J0\nM2\n"),
    ("RS274NGC.CENTER_ARC_RADIUS_TOLERANCE_MM=1", "M2\n"),
    ("RS274NGC.INI_VARS=0", "G0 X#<_ini[traj]own>\nM2\n"),
    ("RS274NGC.RETAIN_G43=1", "G21 T1 M6 G43\nT2 M6\nM2\n"),
    ("RS274NGC.OWORD_NARGS=1", "o<a> sub\n(print,#<n_args>)\no<a> endsub\no<a> call [1] [2]\nM2\n"),
    ("RS274NGC.NO_DOWNCASE_OWORD=1", "#<Abc>=2\n(print,#<Abc>)\nM2\n"),
    ("RS274NGC.OWORD_WARNONLY=1", "o<a> return\nG0 X1\nM2\n"),
    ("RS274NGC.DISABLE_G92_PERSISTENCE=1", "(print,#5211)\nM2\n"),
    ("RS274NGC.DISABLE_AUTO_G54=1", "G55\nM2\n(print,#5220)\n"),
    ("RS274NGC.DISABLE_FANUC_STYLE_SUB=1", "M98 P5\nM2\nO5\nG0 X5\nM99\n"),
    ("RS274NGC.CYCLES_BOTH_WAYS=1", "G21 G90 G0 Z-5\nG81 X1 Z2 R1 F100\nM2\n"),
    ("RS274NGC.G73_PECK_CLEARANCE=0.5", "G21 G90 G0 Z1\nG73 X1 Z-4 R0 Q3 F100\nM2\n"),
    ("RS274NGC.G83_PECK_CLEARANCE=0.5", "G21 G90 G0 Z1\nG83 X1 Z-4 R0 Q3 F100\nM2\n"),
    ("RS274NGC.ORIENT_OFFSET=30", "M19 R10\nM2\n"),
    ("RS274NGC.SUBROUTINE_PATH=subs", "o<one> call\nM2\n"),
    ("WIZARD.WIZARD_ROOT=subs", "o<one> call\nM2\n"),
    ("DISPLAY.PROGRAM_PREFIX=subs", "o<one> call\nM2\n"),
    ("RS274NGC.REMAP=M400 modalgroup=10 ngc=one|RS274NGC.SUBROUTINE_PATH=subs", "M400\nM2\n"),
    ("EMCIO.TOOL_CHANGE_WITH_SPINDLE_ON=1", "S100 M3\nT1 M6\nM2\n"),
    ("EMCIO.TOOL_CHANGE_QUILL_UP=1", "T1 M6\nM2\n"),
    ("EMCIO.TOOL_CHANGE_AT_G30=1", "T1 M6\nM2\n"),
    ("TRAJ.SPINDLES=2", "S100 M3 $1\nM2\n"),
    ("AXIS_A.WRAPPED_ROTARY=1", "G0 A350\nG0 A-10\nM2\n"),
    ("AXIS_A.LOCKING_INDEXER_JOINT=3", "G0 A350\nM2\n"),
    ("RS274NGC.LOG_LEVEL=2", "G0 X1\no<one> call\n#<a>=1\nM2\n"),
    ("RS274NGC.LOG_LEVEL=4|RS274NGC.LOG_FILE=my.log|DISPLAY.PROGRAM_PREFIX=subs", "G0 X1\no<one> call\n#<a>=1\nM2\n"),
    ("EMC.DEBUG=0x2000|DISPLAY.PROGRAM_PREFIX=subs", "G0 X1\no<one> call\n#<a>=1\nM2\n"),
    ("EMC.DEBUG=0x10000", "G0 X1\n#<a>=1\nM2\n"),
    ("RS274NGC.LOG_FILE=/nowhere/my.log", "M2\n"),
]
END = ("SET_XY_ROT", "SET_FEED_", "STOP_SPINDLE_TURNING(0", "SET_SPINDLE_MODE", "PROGRAM_END")
BASE = {"TRAJ": ["COORDINATES = XYZA", "LINEAR_UNITS = mm", "OWN = 3"], "RS274NGC": ["PARAMETER_FILE = p.var"],
        "EMC": [], "DISPLAY": [], "WIZARD": [], "EMCIO": [],
        "AXIS_A": []}


def run(settings, program):
    text = {section: list(lines) for section, lines in BASE.items()}
    for setting in filter(None, settings.split("|")):
        name, value = setting.split("=", 1)
        section, name = name.split(".")
        text[section].insert(0, f"{name} = {value}")
    Path("m.ini").write_text("".join(f"[{s}]\n" + "\n".join(lines) + "\n" for s, lines in text.items()))
    Path("p.var").write_text("5181\t3\n5182\t4\n5183\t5\n5210\t1\n5211\t7\n5220\t1\n")
    Path("p.ngc").write_text(program)
    done = subprocess.run(["rs274", "-g", "-i", "m.ini", "-t", "t.tbl", "-v", "p.var", "p.ngc"], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, env=dict(os.environ, INI_FILE_NAME="m.ini"))
    return [re.sub(r"^ *\d+ N\.+ *", "", line).replace(os.getcwd(), ".") for line in done.stdout.splitlines()]


Path("t.tbl").write_text("T1 P1 Z10\nT2 P2 Z20\n")
Path("subs").mkdir()
Path("subs/one.ngc").write_text("o<one> sub\nG0 X11\no<one> endsub\nM2\n")
for settings, program in CASES:
    print("==", settings)
    for line in difflib.unified_diff(run("", program), run(settings, program), n=0, lineterm=""):
        if not line.startswith(("---", "+++", "@@")) and not line[1:].startswith(END):
            print(line)
print("== my.log")
print(Path("my.log").read_text().replace(os.getcwd(), "."), end="")
