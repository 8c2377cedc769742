#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""A window for the offsets of the component moveoff, which must be named mv (LIB:hookup_moveoff.tcl)."""

import argparse
import os
import sys
from pathlib import Path

here = Path(__file__).resolve().parent
if (here.parent / "lib/python/kerf").is_dir():
    sys.path.insert(0, str(here.parent / "lib/python"))

import hal
from hal import query
from kerf import tkstyle
from kerf.inivalues import trivkins_letters
from kerf.language import _, N_
from kerf.numbertext import plain, with_point

POLL_MS = 1000
PULSE_MS = 100              # of halui.program.resume
LETTERS = "xyzabcuvw"
MAX_INCREMENTS = 4
USAGE_SHOWN, USAGE_HIGH = 50, 80        # % of the waypoints
PAUSED, RESUME = "halui.program.is-paused", "halui.program.resume"
NEEDED = ("move-enable", "apply-offsets", "offset-applied", "waypoint-limit", "waypoint-percent-used",
          "backtrack-enable")
DISABLED, ENABLED, ACTIVE = N_("Offsets Disabled"), N_("Offsets Enabled"), N_("OFFSETS ACTIVE")
REMOVING, LIMIT = N_("Removing offsets"), N_("Waypoint limit (Disable required)")
COLORS = {DISABLED: "#7fd67f", ENABLED: "cyan", ACTIVE: "#ff5a4d", REMOVING: "yellow", LIMIT: "orange"}
MOTION_OFF = N_("Motion Off")
PX_PER_POINT = 4 / 3


class Unusable(Exception):
    """Says what is missing or in the way, and what to do."""


def parse(words):
    parser = argparse.ArgumentParser(prog="moveoff_gui", add_help=False, allow_abbrev=False,
                                     description="A window for the offsets of the component moveoff (named mv).")
    parser.add_argument("-h", "-?", "-help", "--help", action="help", help="print this and exit")
    parser.add_argument("-mode", choices=("onpause", "always"), default="onpause",
                        help="show the window while the program is paused (default), or always")
    parser.add_argument("-axes", default="xyz", help="letters of the axes that get offsets (default xyz)")
    parser.add_argument("-inc", action="append", type=float, metavar="SIZE",
                        help="an increment, up to four times (default .001 .01 .10 1.0)")
    parser.add_argument("-size", type=int, default=14, help="size of the letters (default 14)")
    parser.add_argument("-loc", default="center", help="place: center (default) or +X+Y")
    parser.add_argument("-autoresume", action="store_true", help="resume the program when the offsets are removed")
    parser.add_argument("-delay", type=float, default=5, help="s before that (default 5)")
    for name, text in (("noentry", "no entries for numbers"),
                       ("no_resume_inhibit", "leave the screen's pin resume-inhibit alone"),
                       ("no_pause_requirement", f"do not look at {PAUSED}"),
                       ("no_cancel_autoresume", "no Cancel while the resume is counted down"),
                       ("no_display", "no window, only the resume")):
        parser.add_argument("-" + name, action="store_true", help=text)
    options = parser.parse_args(words)
    options.axes = options.axes.lower()
    options.inc = options.inc or [.001, .01, .10, 1.0]
    if not options.axes or set(options.axes) - set(LETTERS) or len(set(options.axes)) < len(options.axes):
        parser.error(f"-axes {options.axes}: different letters out of {LETTERS} are expected")
    if len(options.inc) > MAX_INCREMENTS or min(options.inc) <= 0:
        parser.error(f"-inc: at most {MAX_INCREMENTS}, each above 0")
    if options.delay < 0 or not 4 <= options.size <= 72:
        parser.error("-delay must be at least 0 and -size from 4 to 72")
    return options


def joint_numbers(axes, kinematics):
    """Joint of each letter. kinematics: [KINS]KINEMATICS, or None where no INI file is known. Raises Unusable."""
    if kinematics is None:
        return {axis: number for number, axis in enumerate(axes)}
    coordinates = trivkins_letters(kinematics).lower()
    if not coordinates:
        raise Unusable(f"[KINS]KINEMATICS = {kinematics}: offsets of axes need trivkins")
    if missing := [axis for axis in axes if axis not in coordinates]:
        raise Unusable(f"-axes {axes}: {missing[0]} is not among the coordinates {coordinates} of trivkins")
    return {axis: coordinates.index(axis) for axis in axes}


class Offsets:
    """moveoff as the window sees it: connects what is free, reads and sets. Raises Unusable."""

    def __init__(self, options, joints):
        self.options, self.joints = options, joints
        for pin in [f"mv.{name}" for name in NEEDED] + ["motion.motion-enabled"]:
            if not query.pin(pin):
                raise Unusable(f"no pin {pin}: moveoff must be loaded with names=mv (LIB:hookup_moveoff.tcl), "
                               "and the motion controller too")
        for axis, joint in joints.items():
            if not query.pin(f"mv.offset-in-{joint}"):
                raise Unusable(f"no pin mv.offset-in-{joint} for axis {axis}: loadrt moveoff needs "
                               f"personality={joint + 1}")
        self.needs_pause = not options.no_pause_requirement
        if (self.needs_pause or options.mode == "onpause") and not query.pin(PAUSED):
            raise Unusable(f"no pin {PAUSED}: load halui ([HAL]HALUI = halui)")
        self.display_only = bool(query.pin("mv.move-enable")["signal"])
        if not self.display_only:
            self._take_over()
        if options.autoresume:
            self._check_resume()
        if not options.no_resume_inhibit:
            self._inhibit_resume()

    def _take_over(self):
        for pin in ("mv.apply-offsets", "mv.backtrack-enable", *(f"mv.offset-in-{j}" for j in self.joints.values())):
            if signal := query.pin(pin)["signal"]:
                raise Unusable(f"{pin} is connected to {signal}, though mv.move-enable is free: connect both for "
                               "controls of your own, or neither (halcmd unlinkp)")
        self.enable(False)
        if self.options.mode == "onpause":
            self._share(PAUSED, "mv.apply-offsets", "mvoff_gui:apply_offsets")
        else:
            hal.set_p("mv.apply-offsets", True)

    def _share(self, source, reader, name):
        """Links reader to the signal of source; one by that name is made if there is none."""
        signal = query.pin(source)["signal"]
        if not signal:
            if not query.signal(name):
                hal.new_sig(name, hal.HAL_BIT)
            hal.connect(source, name)
            signal = name
        hal.connect(reader, signal)

    def _check_resume(self):
        pin = query.pin(RESUME)
        if not pin:
            raise Unusable(f"-autoresume: no pin {RESUME}: load halui ([HAL]HALUI = halui)")
        if pin["signal"]:
            raise Unusable(f"-autoresume: {RESUME} is connected to {pin['signal']}: it must be free (halcmd unlinkp)")

    def _inhibit_resume(self):
        """No screen resumes while an offset is there: linked, so that it holds in every cycle."""
        for pin in query.pins().values():
            if pin["name"].endswith(".resume-inhibit") and pin["dir"] == hal.HAL_IN and not pin["signal"]:
                self._share("mv.offset-applied", pin["name"], "mvoff_gui:offset_applied")

    def paused(self):
        """Where a pause is not required, always."""
        return not self.needs_pause or bool(hal.get_p(PAUSED))

    def motion_on(self):
        return bool(hal.get_p("motion.motion-enabled"))

    def applied(self):
        return bool(hal.get_p("mv.offset-applied"))

    def enabled(self):
        return bool(hal.get_p("mv.move-enable"))

    def may_enable(self):
        return self.motion_on() and self.paused()

    def enable(self, on):
        """Switches the offsets; all begin with 0, so that nothing moves by itself."""
        if on:
            for axis in self.joints:
                self.set(axis, 0)
        hal.set_p("mv.move-enable", bool(on))

    def set(self, axis, value):
        hal.set_p(f"mv.offset-in-{self.joints[axis]}", float(value))

    def wanted(self, axis):
        return hal.get_p(f"mv.offset-in-{self.joints[axis]}")

    def limits(self, axis):
        return tuple(hal.get_p(f"mv.offset-{end}-{self.joints[axis]}") for end in ("min", "max"))

    def current(self, axis):
        return hal.get_p(f"mv.offset-current-{self.joints[axis]}")

    def usage(self):
        return hal.get_p("mv.waypoint-percent-used")

    def status(self):
        """(text, color)"""
        moving = self.enabled() and bool(hal.get_p("mv.apply-offsets"))
        if hal.get_p("mv.waypoint-limit"):
            text = LIMIT
        elif self.applied():
            text = ACTIVE if moving else REMOVING
        else:
            text = ENABLED if self.enabled() else DISABLED
        if not self.motion_on():
            return f"{_(text)} --- {_(MOTION_OFF)}", "white"
        return _(text), COLORS[text]


class Resumer:
    """Counts down and resumes once the offsets have been removed."""

    def __init__(self, offsets, root, options, popup):
        """popup(seconds left or None, cancel) shows the countdown."""
        self.offsets, self.root, self.options, self.popup = offsets, root, options, popup
        self.had_offsets, self.left, self.timer = False, None, None

    def may_resume(self):
        """The offsets are gone and nobody is about to make new ones."""
        offsets = self.offsets
        return not offsets.applied() and not offsets.enabled() and offsets.motion_on() and offsets.paused()

    def look(self):
        """At every poll."""
        may = self.may_resume()
        self.had_offsets = (self.had_offsets or self.offsets.applied()) and self.offsets.paused()
        if may and self.had_offsets:
            self.had_offsets = False
            self.left = self.options.delay
            self.tick()
        elif self.left is not None and not may:
            self.cancel()

    def tick(self):
        if self.left <= 0:
            self.cancel()
            if self.may_resume():
                self.pulse()
            return
        self.popup(self.left, self.cancel)
        step = min(1, self.left)
        self.left -= step
        self.timer = self.root.after(round(step * 1000), self.tick)

    def cancel(self):
        if self.timer:
            self.root.after_cancel(self.timer)
        self.timer = self.left = None
        self.popup(None, self.cancel)

    def pulse(self):
        hal.set_p(RESUME, True)
        self.root.after(PULSE_MS, lambda: hal.set_p(RESUME, False))


class Window:
    """The controls (or only the values, when others control moveoff)."""

    def __init__(self, root, offsets, options):
        import tkinter as tk
        import tkinter.font
        from tkinter import ttk
        self.tk, self.root, self.offsets, self.options = tk, root, offsets, options
        self.style = tkstyle.apply(root)
        self.increment = tk.DoubleVar(root, value=options.inc[0])
        self.enable = tk.BooleanVar(root, value=offsets.enabled())
        self.backtrack = tk.BooleanVar(root, value=bool(hal.get_p("mv.backtrack-enable")))
        # Pixels: points depend on what the display says of its size. A font with a name becomes smaller where the
        # screen has no room.
        self.font = tkinter.font.Font(root, family="DejaVu Sans", size=-self.style.px(options.size * PX_PER_POINT))
        self.values, self.entries, self.controls, self.countdown = {}, {}, [], None
        root.title("moveoff_gui")
        for kind in ("TCheckbutton", "TRadiobutton"):
            ttk.Style(root).configure(f"Offsets.{kind}", font=self.font)
        self.status = tk.Label(root, foreground="black", width=len(f"{_(LIMIT)} --- {_(MOTION_OFF)}"), relief="ridge",
                               font=self.font)
        self.status.pack(fill="x", padx=6, pady=6)
        if not offsets.display_only:
            self._switches()
        table = tk.Frame(root)
        table.pack(fill="x", padx=6)
        for row, axis in enumerate(options.axes):
            self._row(table, row, axis)
        if not offsets.display_only:
            self._increments()
        self.note = tk.Label(root, font=self.font)
        self.note.pack(fill="x", padx=6, pady=4)
        self.resumer = Resumer(offsets, root, options, self.popup) if options.autoresume else None
        root.resizable(False, False)
        root.protocol("WM_DELETE_WINDOW", self.close)
        root.withdraw()
        self.poll()

    def _switches(self):
        from tkinter import ttk
        frame = self.tk.Frame(self.root)
        frame.pack(fill="x", padx=6)
        self.switch = ttk.Checkbutton(frame, text=_("Enable Offsets"), variable=self.enable,
                                      style="Offsets.TCheckbutton", command=self.switched)
        self.switch.pack(side="left")
        self.backtracking = ttk.Checkbutton(
            frame, text=_("Backtrack On"), variable=self.backtrack, style="Offsets.TCheckbutton",
            command=lambda: hal.set_p("mv.backtrack-enable", self.backtrack.get()))
        self.backtracking.pack(side="right")

    def _row(self, table, row, axis):
        tk = self.tk
        tk.Label(table, text=axis.upper(), font=self.font, width=3).grid(row=row, column=0)
        self.values[axis] = tk.Label(table, width=11, anchor="e", relief="sunken", font=self.font)
        self.values[axis].grid(row=row, column=1, padx=2, pady=2)
        if self.offsets.display_only:
            return
        buttons = [("-", lambda: self.step(axis, -1)), ("+", lambda: self.step(axis, 1)),
                   ("0", lambda: self.set(axis, 0))]
        for column, (text, action) in enumerate(buttons, 2):
            button = tk.Button(table, text=text, width=2, font=self.font, command=action)
            button.grid(row=row, column=column, padx=1)
            self.controls.append(button)
        if not self.options.noentry:
            entry = tk.Entry(table, width=9, justify="right", font=self.font)
            entry.grid(row=row, column=5, padx=4, sticky="ns", ipady=self.style.roomy(1, 5))
            for key in ("<Return>", "<KP_Enter>"):
                entry.bind(key, lambda _event: self.enter(axis))
            self.entries[axis] = entry
            self.controls.append(entry)

    def _increments(self):
        from tkinter import ttk
        frame = self.tk.Frame(self.root)
        frame.pack(fill="x", padx=6)
        self.tk.Label(frame, text=_("Increment"), font=self.font).pack(side="left")
        self.radios = [ttk.Radiobutton(frame, text=f"{size:g}", value=size, variable=self.increment,
                                       style="Offsets.TRadiobutton")
                       for size in self.options.inc]
        for radio in self.radios:
            radio.pack(side="left", padx=self.style.px(6))

    def switched(self):
        on = self.enable.get() and self.offsets.may_enable()
        self.offsets.enable(on)
        self.show()

    def step(self, axis, sign):
        self.set(axis, self.offsets.wanted(axis) + sign * self.increment.get())

    def enter(self, axis):
        """The number of an entry; what is no number stays in it, red."""
        text = self.entries[axis].get()
        try:
            value = float(with_point(plain(text)))
            good = value == value and abs(value) != float("inf")
        except ValueError:
            good = False
        self.entries[axis].configure(fg=self.style.colours["ink" if good else "bad"])
        if good:
            self.set(axis, value)

    def set(self, axis, value):
        if self.offsets.enabled() and self.offsets.may_enable():
            low, high = self.offsets.limits(axis)
            self.offsets.set(axis, min(max(value, low), high))
        self.show()

    def show(self):
        """Brings everything up to date."""
        offsets = self.offsets
        text, color = offsets.status()
        self.status.configure(text=text, bg=color)
        for axis, label in self.values.items():
            label.configure(text=f"{offsets.current(axis):.4f}")
        usage = offsets.usage()
        self.note.configure(text=_("Waypoints used: %d%%") % usage if usage >= USAGE_SHOWN else "",
                            fg=self.style.colours["bad" if usage > USAGE_HIGH else "ink"])
        if offsets.display_only:
            return
        self.enable.set(offsets.enabled())
        self.backtrack.set(bool(hal.get_p("mv.backtrack-enable")))
        self.switch.configure(state="normal" if offsets.enabled() or offsets.may_enable() else "disabled")
        # The way back is chosen before the offsets are removed.
        state = "normal" if offsets.enabled() and offsets.may_enable() else "disabled"
        for control in self.controls:
            control.configure(state=state)

    def appear(self):
        """The window is there always, or while there is something to do."""
        wanted = not self.options.no_display and (
            self.options.mode == "always" or self.offsets.paused() or self.offsets.applied())
        if not wanted:
            self.root.withdraw()
        elif self.root.state() == "withdrawn":
            self.place()
            self.root.deiconify()

    def place(self):
        root = self.root
        root.update_idletasks()
        x, y = ((root.winfo_screenwidth() - root.winfo_reqwidth()) // 2,
                (root.winfo_screenheight() - root.winfo_reqheight()) // 2)
        root.geometry(f"+{x}+{y}" if self.options.loc == "center" else self.options.loc)

    def look(self):
        """At every poll. False when HAL is gone."""
        try:
            if self.offsets.enabled() and not self.offsets.display_only and not self.offsets.may_enable():
                # Resumed, stopped or off: offsets do not come back with the next pause.
                self.offsets.enable(False)
            self.show()
            self.appear()
            if self.resumer:
                self.resumer.look()
        except (RuntimeError, TypeError) as error:      # HAL was unloaded
            print(f"moveoff_gui: {error}", file=sys.stderr)
            self.root.destroy()
            return False
        return True

    def poll(self):
        if self.look():
            self.root.after(POLL_MS, self.poll)

    def popup(self, seconds, cancel):
        """The countdown; seconds None takes it away."""
        if seconds is None:
            if self.countdown:
                self.countdown.destroy()
                self.countdown = None
            return
        if not self.countdown:
            self.countdown = self.tk.Toplevel(self.root)
            self.countdown.title(_("Resume"))
            self.countdown.protocol("WM_DELETE_WINDOW",
                                    cancel if not self.options.no_cancel_autoresume else lambda: None)
            self.seconds = self.tk.Label(self.countdown, font=self.font, padx=20, pady=10)
            self.seconds.pack()
            if not self.options.no_cancel_autoresume:
                self.cancel = self.tk.Button(self.countdown, text=_("Cancel"), font=self.font, command=cancel)
                self.cancel.pack(pady=10)
            self.countdown.attributes("-topmost", True)
        self.seconds.configure(text=_("The program is resumed in %.0f s") % seconds)

    def close(self):
        """Offsets do not stay behind a closed window."""
        if not self.offsets.display_only:
            try:
                self.offsets.enable(False)
            except RuntimeError:
                pass
        self.root.destroy()


def kinematics():
    if not os.environ.get("INI_FILE_NAME"):
        return None
    import linuxcnc
    return linuxcnc.ini(os.environ["INI_FILE_NAME"]).find("KINS", "KINEMATICS") or "trivkins"


def main():
    options = parse(sys.argv[1:])
    try:
        if not os.environ.get("DISPLAY"):
            raise Unusable("no display (DISPLAY is not set)")
        offsets = Offsets(options, joint_numbers(options.axes, kinematics()))
    except (Unusable, RuntimeError) as error:
        sys.exit(f"moveoff_gui: {error}")
    root = tkstyle.open_display("moveoff_gui", "moveoff_gui")
    tkstyle.run(root, Window(root, offsets, options).close)


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        pass
