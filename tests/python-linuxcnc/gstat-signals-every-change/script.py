# SPDX-License-Identifier: GPL-2.0-or-later
# GStat, looked at by hand instead of by the GLib timer: which signals each act brings.
import os

os.environ["INI_FILE_NAME"] = os.path.abspath("mill.ini")

import hal
from gi.repository import GObject

import hal_glib
from mill import *

need(lambda s: s.state == RCS_DONE and s.heartbeat > 0, "a machine that is ready")
g = hal_glib.GStat()
print("one object:", g is hal_glib.GStat(), g.cycle_time_ms, hal_glib.GStat.WARNING, hal_glib.GStat.TEMPARARY_MESSAGE)
seen = []
BORING = {"periodic", "current-feed-rate", "current-x-rel-position", "current-position", "following-error",
          "actual-spindle-speed-changed", "line-changed"}


def listen(name):
    def heard(_, *args):
        if name == "file-loaded":
            args = (os.path.basename(args[0]),)
        if name not in BORING:
            seen.append(name + (str(tuple(round(a, 3) if isinstance(a, float) else a for a in args)) if args else ""))
    g.connect(name, heard)


for name in GObject.signal_list_names(g):
    if name != "notify":
        listen(name)


def look(what, settle=0.3):
    sleep(settle)
    g.update()
    g.update()
    print(f"{what}:")
    for s in seen:
        print("   ", s)
    seen.clear()


look("the first look")
look("nothing")
print(g.machine_is_on(), g.estop_is_clear(), g.is_man_mode(), g.is_all_homed(), g.is_interp_idle(), g.is_metric_mode(),
      g.check_for_modes(), g.get_jograte())
c.state(STATE_ESTOP_RESET)
look("estop reset")
c.state(STATE_ON)
look("on")
c.home(1)
look("home 1")
c.home(-1)
need(lambda s: all(s.homed[:3]), "homing")
look("home all")
c.feedrate(0.5)
c.rapidrate(0.6)
c.spindleoverride(0.7)
c.maxvel(10)
look("overrides")
c.flood(1)
c.mist(1)
c.set_optional_stop(0)
c.set_block_delete(0)
c.set_feed_hold(0)
look("switches")
c.spindle(SPINDLE_FORWARD, 500)
look("spindle")
print(g.is_spindle_on(), g.get_spindle_speed(0))
c.spindle(SPINDLE_OFF)
c.mode(MODE_MDI)
look("MDI mode")
print(g.get_current_mode(), g.get_previous_mode(), g.check_for_modes(g.MDI), g.check_for_modes([g.MANUAL, g.AUTO]))
for line in ("G20 G91 G95 G18 F3", "G21 G90 G94 G17 G55", "G64 P0.1 Q0.2 S700", "G93 G7", "G94 G8 G54",
             "G96 D1000 S100", "G97"):
    mdi(line)
    look(line)
mdi("T1 M6")
mdi("G43")
look("tool")
mdi("G10 L2 P1 X1 Y2 R30")
look("offsets")
mdi("G0 X3 Y0")
position, relative, dtg = g.get_position()
print([round(v, 3) for v in position[:3]], [round(v, 3) for v in relative[:3]], dtg[:3])
mdi("G10 L2 P1 X0 Y0 R0")
look("back")
c.mdi("G1 F0 X1")
c.wait_complete()
look("an error")
program("G0 X1\nG4 P2\nG0 X0\nM2\n")
look("a program")
c.auto(AUTO_RUN, 0)
look("run")
print(g.is_auto_running(), g.check_for_modes(g.MANUAL))
c.auto(AUTO_PAUSE)
look("pause")
print(g.is_auto_paused(), g.is_interp_paused())
c.auto(AUTO_RESUME)
idle()
look("end")
c.mode(MODE_MANUAL)
c.wait_complete()
look("manual")
print("== what the widgets say")
g.set_jograte(30)
g.set_jograte_angular(720)
g.set_jog_increments(0.1, "0.1mm")
g.set_jog_increment_angular(5, "5 deg")
g.set_selected_joint(2)
g.set_selected_axis("y")
g.request_cycle_start(True)
g.request_reload_display(None)
look("board")
print(g.get_jograte(), g.get_jog_increment(), g.get_selected_joint(), g.get_selected_axis(), g.get_max_velocity(),
      g.jnum_for_axisnum(2), g.get_jjogmode(), g.get_jog_info(1))
c.maxvel(200)
c.teleop_enable(0)
sleep(0.1)
g.do_jog(0, 1, 2)
sleep(5)
print("jogged:", xyz(3)[0], g.get_jog_info(0))
g.set_jograte(600)
y = xyz(3)[1]
g.do_jog(1, -1)
sleep(0.5)
g.do_jog(1, 0)
sleep(0.5)
print("jogged until stopped:", -5.5 < xyz(3)[1] - y < -4.5)
g.set_axis_origin("X", 7)
sleep(0.2)
g.update()
print("origin:", round(g.get_position()[1][0], 3), g.is_man_mode())
g.set_tool_touchoff(1, "Z", 3)
seen.clear()
g.forced_update()
print("forced:", seen[:3], len(seen) > 40)
seen.clear()
c.state(STATE_ESTOP)
look("estop")

print("== HAL pins")
component = hal_glib.GComponent(hal.component("glib-test"))
pin = component.newpin("in", hal.HAL_S32, hal.HAL_IN)
heard = []
pin.connect("value-changed", lambda p: heard.append(p.get()))
component.comp.ready() if hasattr(component, "comp") else None
pin.update()
hal.set_p("glib-test.in", "5")
pin.update()
pin.update()
component["in"]
print(heard, component["in"], component.getpin("in") is not None)
hal_glib.GPin.update_stop()
component.exit()
