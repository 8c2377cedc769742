# SPDX-License-Identifier: GPL-2.0-or-later
import struct
import threading
import warnings

import linuxcnc as module
import linuxcnc_util
from mill import *

print("== linuxcnc_util")
l = linuxcnc_util.LinuxCNC(c, s, e)
l.wait_for_linuxcnc_startup()
on(home=False)
print(l.all_joints_homed([1, 1, 1]))
c.home(-1)
l.wait_for_home([1, 1, 1])
print(l.all_joints_homed([1, 1, 1]), l.all_joints_homed([0, 0, 0]))
need(lambda s: s.motion_mode == TRAJ_MODE_TELEOP, "teleop")
import contextlib
import io

said = io.StringIO()
with contextlib.redirect_stdout(said):
    l.jog_axis("y", -3)
    l.jog_axis("X", 2.5, 10)
print("jogged:", said.getvalue().count("jogg"), 2.5 < poll().position[0] < 3.5, -3.5 < s.position[1] < -3)
for what, call in (("jog", lambda: l.jog_axis("Z", 5, 0.1, timeout=0.5)),
                   ("stop at", lambda: l.wait_for_axis_to_stop_at("X", 50, timeout=0.5)),
                   ("tool", lambda: l.wait_for_tool_in_spindle(7, timeout=0.3)),
                   ("interp", lambda: l.wait_for_interp_state(INTERP_PAUSED, timeout=0.3)),
                   ("home", lambda: l.wait_for_home([1, 1, 1, 1], timeout=0.3))):
    with contextlib.redirect_stdout(said):
        try:
            call()
            problem = None
        except linuxcnc_util.LinuxCNC_Exception as p:
            problem = type(p).__name__
    print(what, problem)
c.jog(JOG_STOP, 0, 2)
with contextlib.redirect_stdout(said):
    l.wait_for_axis_to_stop("z")
mdi("T1 M6")
l.wait_for_tool_in_spindle(1)
mdi("G0 X0 Y0 Z0")
mdi("G43")

print("== positionlogger")
colors = [(n * 10, n * 20, n * 30, 255) for n in range(6)]
p = module.positionlogger(s, *colors, "XYZ", 0)
print(p.npts, p.last(), p.get_colors() == tuple(colors))
thread = threading.Thread(target=p.start, args=(0.005,))
thread.start()
until(lambda s: p.npts >= 2, 10)
print("idle:", p.npts)


def points():
    data, n, xyuv = p.points()
    return [struct.unpack("3f4B3f4B", data[i * 32:(i + 1) * 32]) for i in range(n)], xyuv


sleep(0.1)
one = points()[0][-1]
print("point:", [round(v, 3) + 0.0 for v in one[:3]], one[3:7], len(p.points()[0]) == 32 * p.npts)
for line, corner in (("G1 F3000 X10", (10, 0)), ("G1 Y10", (10, 10)), ("G0 X0", (0, 10))):
    mdi(line)
    until(lambda s: (at := p.last(0)) and abs(at[0] - corner[0]) < 1e-3 and abs(at[1] - corner[1]) < 1e-3, 1000)
path, xyuv = points()
near = lambda c: any(abs(q[0] - c[0]) < 1 and abs(q[1] - c[1]) < 1 for q in path)
print("corners:", all(near(c) for c in ((0, 0), (10, 0), (10, 10), (0, 10))), "few:", len(path) < 60, "colors:",
      sorted({q[3:7] for q in path if q[3:7] in (tuple(colors[1]), tuple(colors[2]))}), xyuv)
print("last drawn:", [round(v, 3) + 0.0 for v in p.last()], "logged:", [round(v, 3) + 0.0 for v in p.last(0)])
p.clear()
until(lambda s: p.npts == 2, 10)
p.set_colors(*reversed(colors))
print(p.get_colors()[0])
p.set_depth(1, 2)
p.stop()
clock.suspend()  # the thread ends with its present wait
thread.join(20)
clock.resume()
print("stopped:", not thread.is_alive())
for bad in (lambda: module.positionlogger(s, *colors[:5], "XYZ"),
            lambda: module.positionlogger(s, *colors[:5], (1, 2), "XYZ")):
    try:
        bad()
    except TypeError:
        print("TypeError")
with warnings.catch_warnings(record=True) as told:
    warnings.simplefilter("always")
    p.call()
    module.line9("XYZ", (0,) * 9, (0,) * 9)
    module.line9("XYZ", (0,) * 9, (0,) * 9)
    module.draw_lines("XYZ", [])
    module.draw_dwells("XYZ", [], 0.5, 0, 0)
for w in told:
    print(w.category.__name__, w.message)
show = lambda v: [round(x, 4) + 0.0 for x in v]
print("vertex9:", show(module.vertex9("XYZ", (1, 2, 3, 90, 0, 0, 4, 5, 6))),
      show(module.vertex9("-XYZ", (1, 2, 3, 0, 0, 0, 0, 0, 0))),
      show(module.vertex9("AXYZ", (1, 2, 3, 90, 0, 0, 0, 0, 0))),
      show(module.vertex9("XYZC", (1, 0, 0, 0, 0, 90, 0, 0, 0))),
      show(module.vertex9("XYZUVW", (1, 2, 3, 0, 0, 0, 10, 20, 30))))
module.gui_respect_offsets("C", 1)
module.gui_rot_offsets(1, 0, 0)
print("about an offset:", show(module.vertex9("XYZC", (1, 0, 0, 0, 0, 90, 0, 0, 0))),
      show(module.vertex9("XYZA", (0, 1, 0, 90, 0, 0, 0, 0, 0))))
