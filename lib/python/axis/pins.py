# SPDX-License-Identifier: GPL-2.0-or-later
"""HAL pins of the screen (component axisui), and widgets that nothing in HAL listens to."""

import os
import traceback

import hal

from .commands import ABORT_PULSE_MS
from .settings import LETTERS


class PinsPart:
    """Part of App: what HAL sees of the screen."""

    def make_pins(self):
        """The component axisui; ready() comes after the user's code."""
        self.comp = None
        if os.environ.get("AXIS_NO_HAL"):
            return
        comp = hal.component("axisui")
        for c in LETTERS.lower():
            comp.newpin(f"jog.{c}", hal.HAL_BIT, hal.HAL_OUT)
        comp.newpin("jog.increment", hal.HAL_FLOAT, hal.HAL_OUT)
        for name in ("notifications-clear", "notifications-clear-info", "notifications-clear-error", "resume-inhibit"):
            comp.newpin(name, hal.HAL_BIT, hal.HAL_IN)
        comp.newpin("error", hal.HAL_BIT, hal.HAL_OUT)
        comp.newpin("abort", hal.HAL_BIT, hal.HAL_OUT)
        self.comp = comp
        self.seen_pins = {}
        self.vars.has_ladder.set(int(hal.component_exists("classicladder_rt")))

    def set_pin(self, name, value):
        if getattr(self, "comp", None) is not None:
            self.comp[name] = value

    def pin_value(self, name):
        return bool(self.comp[name]) if getattr(self, "comp", None) is not None else False

    def hal_value(self, name):
        """Of any HAL pin; None where there is none."""
        if getattr(self, "comp", None) is None:
            return None
        try:
            return hal.get_value(name)
        except RuntimeError:
            return None

    def pulse_abort(self):
        self.set_pin("abort", True)
        self.root.after(ABORT_PULSE_MS, lambda: self.set_pin("abort", False))

    def errors_shown(self, error):
        self.set_pin("error", error)

    def hide_unconnected(self):
        """Hides spindle, coolant and limit widgets that nothing in HAL listens to."""
        if os.environ.get("AXIS_NO_AUTOCONFIGURE") or self.comp is None:
            return
        has = self.writers = (self.former or {}).get("writers") or {pin: hal.pin_has_writer(pin)
                                                                    for pin in self.watched_pins()}
        speeds = [f"spindle.0.{n}" for n in ("speed-out", "speed-out-abs", "speed-out-rps", "speed-out-rps-abs")]

        def any_of(*names):
            return any(has.get(n) for n in names)
        f, r, on, brake = (f"spindle.0.{n}" for n in ("forward", "reverse", "on", "brake"))
        mist, flood = "iocontrol.0.coolant-mist", "iocontrol.0.coolant-flood"
        manual = ".pane.top.tabs.fmanual"
        rules = (((brake,), ("pack", f"{manual}.spindlef.brake")),
                 ((f, on, *speeds), ("pack", f"{manual}.spindlef.cw")),
                 ((r, *speeds), ("pack", f"{manual}.spindlef.ccw")),
                 ((f, r, on, *speeds), ("pack", f"{manual}.spindlef.stop")),
                 (speeds, ("pack", f"{manual}.spindlef.spindleminus")),
                 (speeds, ("pack", f"{manual}.spindlef.spindleplus")),
                 (speeds, ("grid", ".pane.top.spinoverride")),
                 ((f, r, on, brake, *speeds), ("grid", f"{manual}.spindlef")),
                 ((f, r, on, brake, *speeds), ("grid", f"{manual}.spindlel")), ((mist,), ("grid", f"{manual}.mist")),
                 ((flood,), ("grid", f"{manual}.flood")), ((mist, flood), ("grid", f"{manual}.coolant")),
                 (tuple(n for n in has if n.endswith("-lim-sw-in")), ("pack", f"{manual}.jogf.override")))
        for pins, (manager, path) in rules:
            if not any_of(*pins):
                self.root.tk.call(manager, "forget" if manager == "pack" else "remove", path)

    def watched_pins(self):
        names = ["spindle.0." + n
                 for n in ("brake", "forward", "reverse", "on", "speed-out", "speed-out-abs", "speed-out-rps",
                                            "speed-out-rps-abs")]
        names += ["iocontrol.0.coolant-mist", "iocontrol.0.coolant-flood"]
        return names + [f"joint.{j}.{side}-lim-sw-in" for j in range(self.settings.joints) for side in ("neg", "pos")]

    def look_at_pins(self):
        if self.comp is None:
            return
        for name, kind in (("notifications-clear", None), ("notifications-clear-info", "info"),
                           ("notifications-clear-error", "error")):
            value = bool(self.comp[name])
            if value and not self.seen_pins.get(name):
                self.notifications.clear(kind)
            self.seen_pins[name] = value
        inhibit = self.pin_value("resume-inhibit")
        if inhibit != self.seen_pins.get("resume-inhibit"):
            self.seen_pins["resume-inhibit"] = inhibit
            self.root.tk.call("pause_image_override" if inhibit else "pause_image_normal")

    def finish_pins(self):
        """The user's own pins, then ready."""
        if self.comp is None:
            return
        try:
            self.user.get("user_hal_pins", lambda: None)()
        except Exception:
            traceback.print_exc()
        if not hal.component_is_ready("axisui"):        # the user's code may have been first
            self.comp.ready()
        self.show_selected()
