# SPDX-License-Identifier: GPL-2.0-or-later
import re
import subprocess
import tarfile
import tempfile
from pathlib import Path

import gcode

CALLS = re.compile(r"( *\d+ N(?!.*NURBS).*\n)+")  # what (PRINT,...) writes is none, and splines print no points
CASES = 120


def rs274(*arguments):
    return subprocess.run(["rs274", "-g", "-v", "new.var", *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          text=True, cwd=scratch)


with tempfile.TemporaryDirectory() as scratch:
    calls = Path(scratch, "calls")
    kinds, different = set(), []
    with tarfile.open("../golden-short.tar.xz") as tar, tarfile.open("../golden-kinds.tar.xz") as more:
        names = [(t, n) for t in (tar, more) for n in sorted(t.getnames()) if n.endswith(".canon")]
        for t, name in names[::len(names) // CASES]:
            text = t.extractfile(name).read().decode(errors="replace")
            if not CALLS.fullmatch(text):
                continue
            calls.write_text(text)
            done = rs274("-p", "canterp.so", "calls")
            kinds |= {line[13:].split("(")[0] for line in text.splitlines()}
            if done.stdout != text or done.returncode:
                different.append(name)
    for name in sorted(Path("../../../nc_files").resolve().glob("*.ngc")):
        text = rs274(str(name)).stdout
        calls.write_text(text)
        if rs274("-p", "canterp.so", "calls").stdout != text:
            different.append(name.name)
    print("different:", different)
    print("at least 25 kinds of calls:", len(kinds) >= 25 or sorted(kinds))
    calls.write_text("UNKNOWN()")
    known = rs274("-p", "canterp.so", "calls").stderr.rsplit(": ", 1)[1].split()
    calls.write_text("".join(f"{name}(\n" for name in known))
    print("known names that are unknown:",
          [l for l in rs274("-n", "0", "-p", "canterp.so", "calls").stderr.splitlines() if "Unknown" in l],
          "missing:", sorted(kinds - set(known) - {"SPINDLE.0.WAIT_ORIENT_COMPLETE"}))

    bare = "; by hand\n\nUSE_LENGTH_UNITS(CANON_UNITS_INCHES)\n# feed\nSET_FEED_RATE ( 10 )   ; inches a minute\r\n" \
        "STRAIGHT_FEED(1 2 3 0 0 0)\nN7 STRAIGHT_FEED(+1,2.5,3,0,0,0,0,0,0)\nWAIT_SPINDLE_ORIENT_COMPLETE(0, 2)"
    calls.write_text(bare)
    print(rs274("-p", "canterp.so", "calls").stdout)

    for line in ("    1 N..... STRAIGT_FEED(1.0, 2.0, 3.0, 0, 0, 0)", "G1 X1", "SET_FEED_RATE(fast)", "SET_FEED_RATE(1",
                 "SELECT_PLANE(XY)", "SET_G5X_OFFSET(10, 0, 0, 0, 0, 0, 0)", "COMMENT(hello)", "DWELL(1) x",
                 "STRAIGHT_FEED(1, 2)", "STRAIGHT_FEED(1, 2, 3, 0, 0, 0)", "   12 N..... NURBS_G5_FEED(3, ...)"):
        calls.write_text("\n" + line + "\n")
        done = rs274("-p", "canterp.so", "calls")
        print(done.returncode, "\n".join(l[:100]
                                         for l in done.stderr.splitlines()
                                         if not l.startswith(("executing", "emcTask"))))
    # no cut-off or overgrown line does more than end with a message
    whole = "   12 N0010  SET_MOTION_CONTROL_MODE(CANON_CONTINUOUS, 0.050000) ; x\nN\n N..... \n COMMENT(\nCANON_ERROR)(\n" + "9" * 5000
    ends = set()
    for line in [whole[:n] for n in range(66)] + whole.split("\n") + ["MESSAGE(\"" + "x" * 3000 + "\")"]:
        calls.write_text(line)
        ends.add(rs274("-p", "canterp.so", "calls").returncode)
    print("ends:", sorted(ends))
    missing = rs274("-p", "nothing.so", "calls").stderr
    print("a missing library is named:", "could not open interpreter" in missing and "nothing.so" in missing)

    calls.write_text("USE_LENGTH_UNITS(CANON_UNITS_MM)\nSTRAIGHT_TRAVERSE(0,0,5,0,0,0)\nSET_FEED_RATE(100)\n"
                     "STRAIGHT_FEED(10,0,0,0,0,0)\nARC_FEED(0,10,0,0,1,0,0,0,0)\nPROGRAM_END()\n")
    shown = gcode.load(str(calls), interpreter="canterp.so", initcodes=["G20 G90"])
    print("preview:", shown.error or "no error", len(shown.lines) > 4, sorted(set(shown.lines)))
    print(gcode.load(str(calls), interpreter="nothing.so").error.split("'")[0])
