#!/usr/bin/env python3
import linuxcnc
try:
    s = linuxcnc.stat()
    s.poll()
except linuxcnc.error as detail:
    print("error", detail)
    raise SystemExit(1)
names = [x for x in dir(s) if not x.startswith("_")]
for x in names:
    str(getattr(s, x))
print(len(names) > 90, "attributes; homed", s.homed[:s.joints], "file", repr(s.file), "mode", s.task_mode,
      "gcodes", s.gcodes[1:9])
print("joint 0", sorted(s.joint[0])[:4], s.joint[0]["jointType"], "spindle", s.spindle[0]["override"], "axis",
      s.axis[2]["max_position_limit"])
