# SPDX-License-Identifier: GPL-2.0-or-later
import re
import signal
import sys
import time

import session
from mill import *

part = sys.argv[1]
folder = Path.cwd()
journal = folder / "mill.var.journal"
TEXT = """G21 G90 G17 G94 G64 P0.05
T2 M6
G43
G10 L2 P2 X10 Y5
G55
M3 S1200
M8
G0 Z60
G1 X10 F6000
G1 X20 F60
G1 Y10
G1 X0
M2
"""


def gone():
    for _ in range(1000):
        if not journal.exists():
            return True
        time.sleep(0.01)
    return False


def standing(words):
    """Holds the program until the journal says so: it is written in wall time."""
    c.auto(AUTO_PAUSE)
    for _ in range(400):
        if journal.exists() and words in journal.read_text():
            return
        c.auto(AUTO_RESUME)
        sleep(0.001)
        c.auto(AUTO_PAUSE)
        time.sleep(0.05)


def journal_now(*words):
    """Those lines of a journal of what is now: the second one that is written from now on."""
    written = set()
    for _ in range(400):
        if journal.exists():
            written.add(journal.stat().st_mtime_ns)
        if len(written) > 2:
            return [line for line in journal.read_text().splitlines() if line.split()[0] in words]
        time.sleep(0.05)         # of wall time, as it is written
        sleep(0.001)
    return []


def told_at_start(count=1):
    told = []
    clock.wait_until(lambda: told.extend(messages()) or len(told) >= count, 5)
    return told


def bit(pin):
    return halcmd("getp", pin) == "TRUE"


if part == "cut":
    print("nothing was cut off before:", messages())
    on()
    run("G0 X1\nM2\n")
    print("a program that ended leaves nothing:", gone())
    program(TEXT, "part.ngc")
    c.auto(AUTO_RUN, 0)
    need(lambda s: s.motion_line == 10 and s.position[0] > 21, "line 10")
    standing("line 10\n")
    for text in journal.read_text().splitlines():
        if not text.startswith(("time", "position", "hash", "table", "ini")):
            print("   ", text)
    session.kill("milltask")
    signal.pause()
elif part == "power":           # all at once
    Path("helper.ngc").write_text("o<helper> sub\n(first)\nG1 X20 F60\nG1 Y10\no<helper> endsub\n")
    on()
    program(TEXT.replace("G1 X20 F60", "o<helper> call"), "caller.ngc")
    c.auto(AUTO_RUN, 0)
    need(lambda s: s.motion_line == 3 and s.position[0] > 21 and s.call_level == 1, "line 3 of the subroutine")
    standing("line 10\n")
    told = journal.read_text()
    print("   ", *[l for l in told.splitlines() if l.startswith(("line", "called"))], sep="\n    ")
    print("    hashes:", [len(l.split()[1]) for l in told.splitlines() if l.startswith(("hash", "table", "ini"))])
    session.kill_all()
elif part == "change":          # while the changer works
    on()
    program("G21 G90\nT2 M6\nG43\nG0 X5\nT3 M6\nG43\nG1 X10 F600\nM2\n", "changes.ngc")
    halcmd("unlinkp", "iocontrol.0.tool-changed")
    c.auto(AUTO_RUN, 0)
    for changed in (1, 0):
        need(lambda s: bit("iocontrol.0.tool-change"), "the change")
        if changed:
            print("    in the first change:", *journal_now("tool", "change", "line"))
            halcmd("setp", "iocontrol.0.tool-changed", "1")
            need(lambda s: not bit("iocontrol.0.tool-change"), "the end of the change")
            halcmd("setp", "iocontrol.0.tool-changed", "0")
    print("    in the second change:", *journal_now("tool", "change", "line"))
    session.kill_all()
elif part == "unsure":
    print(told_at_start(2)[1:])
    on()
    mode(MODE_AUTO)
    c.program_open(s.cut_off_file)
    c.wait_complete()
    c.restore(s.cut_off_line)
    print("restore:", until(lambda s: s.restore_line == s.cut_off_line, 10), s.restore_line)
    print(re.sub(r"\d+-\d+-\d+ [\d:]+", "TIME", s.restore_text))
    c.abort()
elif part == "again":
    told = told_at_start()
    print(len(told), told[0].split(" (", 1)[0] if told else None)
    on()
    mode(MODE_AUTO)
    c.program_open(str(folder / "part.ngc"))
    c.wait_complete()
    before = xyz()
    line = int([l for l in journal.read_text().splitlines() if l.startswith("line ")][0].split()[1])
    c.restore(line)
    print("restore:", until(lambda s: s.restore_line == line, 10))
    print(re.sub(r"\d+-\d+-\d+ [\d:]+", "TIME", re.sub(r"stood at X21.\d+", "stood at X21", s.restore_text)))
    sleep(2)
    poll()
    print("nothing moved or started:", xyz() == before, s.spindle[0]["enabled"], s.flood, s.tool_in_spindle)
    c.restore_confirm(line)
    need(lambda s: s.motion_line == line and s.spindle[0]["enabled"] and s.current_vel > 0 and s.g5x_index == 2,
         "the line", 100)
    print("goes on:", s.spindle[0]["speed"], s.flood, s.tool_in_spindle, s.g5x_index)
    c.abort()
    c.wait_complete()
    print("stopped by the operator, it leaves nothing:", gone())
elif part == "changed":         # program, tool table, INI file, offset and tool length since
    on()
    print("cut off:", s.cut_off_line, Path(s.cut_off_file).name)
    mode(MODE_AUTO)
    c.program_open(s.cut_off_file)
    c.wait_complete()
    for line in (10, 8):
        c.restore(line)
        print("restore:", until(lambda s: s.restore_line == line, 10))
        print(re.sub(r"\d+-\d+-\d+ [\d:]+", "TIME",
                     re.sub(r"stood at X21.\d+", "stood at X21", s.restore_text.partition("The run that")[2])))
    c.abort()
    run("M2\n", name="other.ngc")
    print("forgotten when another program has run:", poll().cut_off_line, s.cut_off_file, gone())
else:
    print("nothing was cut off:", messages())
