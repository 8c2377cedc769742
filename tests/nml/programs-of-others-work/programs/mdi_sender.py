#!/usr/bin/env python3
import sys
import linuxcnc

s = linuxcnc.stat()
c = linuxcnc.command()


def ok_for_mdi():
    s.poll()
    return not s.estop and s.enabled and (s.homed.count(1) == s.joints) and (s.interp_state == linuxcnc.INTERP_IDLE)


if not ok_for_mdi():
    sys.exit("not ready")
c.mode(linuxcnc.MODE_MDI)
c.wait_complete()
for cmd in sys.argv[1:]:
    c.mdi(cmd)
    rv = c.wait_complete(60)
    s.poll()
    print(cmd, "->", rv, [round(p, 3) + 0.0 for p in s.actual_position[:3]])
