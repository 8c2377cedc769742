# SPDX-License-Identifier: GPL-2.0-or-later
# What widgets set in GStat reaches other programs (here hal_bridge's pins), and what these ask for reaches the widgets.
import os
import time

os.environ["INI_FILE_NAME"] = os.path.abspath("mill.ini")

import hal
from gi.repository import GLib

import hal_glib
from mill import *

me = hal.component("panel")
me.ready()
need(lambda s: s.state == RCS_DONE and s.heartbeat > 0, "a machine that is ready")
g = hal_glib.GStat()
heard = []
for name in ("ok-request", "cancel-request", "cycle-start-request", "macro-call-request", "reload-display"):
    g.connect(name, lambda _, *args, name=name: heard.append((name, *args)))


def comes(condition):
    """Messages take their way through sockets: wall time."""
    for _ in range(1000):
        while GLib.MainContext.default().iteration(False):
            pass
        if condition():
            return True
        sleep(0.1)
        time.sleep(0.005)
    return False


def pin(name, value):
    return lambda: hal.get_value(f"bridge.{name}") == value


def pressed(name):
    hal.set_p(f"bridge.{name}", "1")
    there = comes(lambda: any(h[0].startswith(name.rsplit("-", 1)[0]) for h in heard))
    hal.set_p(f"bridge.{name}", "0")
    return there


rates = iter(range(1, 1000))


def first():
    """A subscriber that comes late misses what was said before."""
    g.set_jograte(next(rates))
    return hal.get_value("bridge.jog-rate") > 0


print("jog rate:", comes(first))
g.set_jograte_angular(720)
g.set_jog_increments(0.5, "0.5 mm")
g.set_jog_increment_angular(15, "15 deg")
g.set_selected_joint(2)
g.set_selected_axis("Y")
print("pins:", [(name, comes(pin(name, value)))
                for name, value in (("jog-rate-angular", 720), ("jog-increment", 0.5), ("jog-increment-angular", 15),
                                    ("joint-selected", 2), ("axis-y-is-selected", True))])
hal.set_p("bridge.jog-rate-in", "33")
print("asked for:", comes(lambda: g.get_jograte() == 33), pressed("ok-in"), pressed("cancel-in"),
      pressed("cycle-start-in"), pressed("reload-display-in"))
hal.set_p("bridge.axis-z-select", "1")
print("axis:", comes(lambda: g.get_selected_axis() == "Z"), sorted(set(heard)))
