# SPDX-License-Identifier: GPL-2.0-or-later
# Every question that GStat answers, in each state of the machine, and each request that it passes on.
import os

os.environ["INI_FILE_NAME"] = os.path.abspath("mill.ini")

import hal
from gi.repository import GObject

import hal_glib
from mill import *

need(lambda s: s.state == RCS_DONE and s.heartbeat > 0, "a machine that is ready")
g = hal_glib.GStat()
QUESTIONS = ("machine_is_on", "estop_is_clear", "is_man_mode", "is_mdi_mode", "is_auto_mode", "is_on_and_idle",
             "is_auto_running", "is_auto_paused", "is_interp_running",
             "is_interp_paused", "is_interp_reading", "is_interp_waiting", "is_interp_idle", "is_file_loaded",
             "is_metric_mode", "is_spindle_on", "is_joint_mode",
             "is_world_mode", "is_status_valid", "is_limits_override_set", "is_hard_limits_tripped", "is_homing",
             "is_all_homed")


def ask(what):
    sleep(0.02)
    g.update()
    print(f"{what}: {' '.join(q for q in QUESTIONS if getattr(g, q)())}; modes {g.get_current_mode()} "
          f"{g.get_previous_mode()}"
          f" tool {g.get_current_tool()} command {g.get_current_command()!r} joint 0 homed {bool(g.is_joint_homed(0))}")


ask("emergency stop")
print(g.get_linuxcnc_version() == linuxcnc.version)
c.state(STATE_ESTOP_RESET)
ask("reset")
c.state(STATE_ON)
ask("on")
c.home(1)
ask("homing a joint")
c.home(-1)
need(lambda s: all(s.homed[:3]), "homing")
idle()
ask("homed")
hal.set_p("joint.0.neg-lim-sw-in", "1")
c.override_limits()
ask("limit switch overridden")
hal.set_p("joint.0.neg-lim-sw-in", "0")
sleep(0.1)
if poll().task_state != STATE_ON:
    c.state(STATE_ON)
    need(lambda s: s.task_state == STATE_ON, "on")
messages()
c.mode(MODE_MDI)
ask("MDI")
mdi("T2 M6")
mdi("G43 G20")
ask("inch, T2")
c.mdi("G4 P1")
sleep(0.05)
ask("dwell by MDI")
c.wait_complete()
mdi("G21 M3 S100")
ask("spindle")
mdi("M5 G38.3 Z-2 F600")
print("probed", [round(v, 3) for v in g.get_probed_position()[:3]],
      [round(v, 3) for v in g.get_probed_position_with_offsets()[:3]])
program("G0 X1\nM66 P0 L3 Q1\nG4 P1\nM0\nM2\n")
ask("program open")
c.auto(AUTO_RUN, 0)
sleep(0.2)
ask("reading")
sleep(1.2)
ask("waiting")
c.auto(AUTO_PAUSE)
ask("paused")
c.auto(AUTO_RESUME)
need(lambda s: s.interp_state == INTERP_PAUSED, "M0")
ask("M0")
c.auto(AUTO_RESUME)
idle()
c.mode(MODE_MANUAL)
ask("manual again")
c.teleop_enable(0)
ask("joint mode")
heard = []
for name in ("ok-request", "cancel-request", "cycle-start-request", "cycle-pause-request", "macro-call-request",
             "reload-display", "shutdown-request", "shutdown"):
    g.connect(name, lambda _, *args, name=name: heard.append((name, *args)))
g.request_ok(True)
g.request_cancel(True)
g.request_cycle_start(False)
g.request_cycle_pause(True)
g.request_macro_call("probe")
g.request_reload_display(None)
g.request_shutdown()
g.shutdown()
print(heard)
names = set(GObject.signal_list_names(g))
hands = {"mdi-line-selected": ("a", "b"), "gcode-line-selected": (1,), "graphics-line-selected": (2,),
         "graphics-loading-progress": (50,), "graphics-gcode-error": ("e",),
         "graphics-gcode-properties": ({"a": 1},), "graphics-view-changed": ("x", None), "mdi-history-changed": (),
         "machine-log-changed": (), "update-machine-log": ("t", "o"),
         "move-text-lineup": (), "move-text-linedown": (), "dialog-request": ({},), "dialog-update": ({},),
         "focus-overlay-changed": (True, "m", None), "play-sound": ("s",),
         "virtual-keyboard": ("on",), "dro-reference-change-request": (1,), "system_notify_button_pressed": ("b", True),
         "show-preference": (), "status-message": ({}, {}),
         "general": ({},), "forced-update": (), "progress": (1, None)}
heard.clear()
for name, args in hands.items():
    g.connect(name, lambda _, *got, name=name: heard.append((name, got)))
    g.emit(name, *args)
print("passed on between widgets:", len(heard), [n for n, a in hands.items() if (n, a) not in heard])


class Status(hal_glib.GStat):
    """As the screens of others derive it: their own signals, methods and start, one object."""
    __gsignals__ = {"of-mine": (GObject.SignalFlags.RUN_FIRST, GObject.TYPE_NONE, (GObject.TYPE_INT,))}
    started = 0

    def __init__(self):
        if Status.started == 0:
            GObject.Object.__init__(self)
            super().__init__()
        Status.started += 1

    def doubled(self):
        return 2 * self.get_jograte()


own, told = Status(), []
own.connect("of-mine", lambda _, n: told.append(n))
own.connect("jograte-changed", lambda _, rate: told.append(rate))
own.emit("of-mine", 5)
own.set_jograte(12)
print("derived:", own is Status(), isinstance(own, hal_glib.GStat), own.doubled(), told,
      g is hal_glib.GStat(), Status.MDI)
