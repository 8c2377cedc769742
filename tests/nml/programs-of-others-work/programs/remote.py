#!/usr/bin/env python3
"""From another computer: sends a program and runs it."""
import sys
import time
import linuxcnc

linuxcnc.nmlfile = sys.argv[1]
s, c, e = linuxcnc.stat(), linuxcnc.command(), linuxcnc.error_channel()
with open("sent.ngc", "w") as f:
    f.write("G21 G90\n" + "(" + "x" * 200 + ")\n" * 1 + "(filler)\n" * 1000 + "G0 X4\nG1 F900 Y5\nM2\n")
c.mode(linuxcnc.MODE_AUTO)
c.wait_complete()
c.program_open("sent.ngc")
print("opened", c.wait_complete(30))
c.auto(linuxcnc.AUTO_RUN, 0)
print("ran", c.wait_complete(60))
s.poll()
print([round(p, 3) for p in s.position[:3]], s.interp_state == linuxcnc.INTERP_IDLE,
      s.file.rsplit("/", 1)[-1].startswith("sent.ngc."), e.poll())
