#!/usr/bin/python3
# Ten working days at the screen; after every step screen and machine are compared by lib/screen_agrees.py.
import os
import random
import re
import sys

import hal
import linuxcnc
import operator_lib as lib
import screen_agrees
from axis import dialogs

HERE = os.path.dirname(os.path.abspath(sys.argv[-1]))
lib.CYCLE_S = 0.04         # the screen looks around less often: the days are long


class Day:
    """One day; `do` is one thing that an operator or somebody else does, then everything must agree."""

    def __init__(self, op, name):
        self.op, self.app, self.name, self.steps, self.faults = op, op.app, name, 0, []
        self.other = linuxcnc.command()

    def do(self, what, action, *args, rest=0.2):
        self.steps += 1
        action(*args)
        self.op.wait(rest)
        for wrong in screen_agrees.all_of_it(self.op):
            self.faults.append(f"{what}: {wrong}")

    def answer(self, index):
        dialogs.ask = lambda *question, **more: index

    def true(self, what, condition):
        if not condition:
            self.faults.append(f"{what}; messages: {self.op.messages()}")

    def say(self, value):
        """What is typed into the dialog of a touch off."""
        def wait(dialog, focus=None):
            dialog.value.set(value)
            dialog.accept()
            dialog.window.destroy()
            return dialog.result
        dialogs.Touchoff.wait = wait

    def keys(self, *names, rest=0.2):
        for name in names:
            state = 4 if name.startswith("ctrl+") else 1 if name.startswith("shift+") else 0
            self.do(f"key {name}", self.op.key, name.split("+")[-1], None, state, rest=rest)

    def run(self):
        before, op = self.op.stat.echo_serial_number, self.op
        self.keys("r")
        op.until(lambda: op.stat.echo_serial_number > before + 1 and not self.app.loading, f"{self.name} runs")
        self.idle()

    def mdi(self, *lines):
        self.do("F5", self.op.key, "F5")
        for line in lines:
            self.do(f"MDI {line}", self.op.type, line)
            self.op.idle()
            self.do(f"MDI {line} is done", lambda: None)

    def manual(self):
        self.do("F3", self.op.key, "F3")

    def open(self, name, text):
        with open(os.path.join(HERE, name), "w") as f:
            f.write(text)
        self.do(f"open {name}", self.app.open_file_guts, os.path.join(HERE, name))

    def pin(self, name, value="1", back="0"):
        self.do(f"{name} {value}", hal.set_p, name, value)
        if back is not None:
            self.do(f"{name} {back}", hal.set_p, name, back)

    def touch(self, axis, value):
        self.say(value)
        self.do(f"selects {axis}", self.op.key, axis)
        self.do(f"touch off {axis} {value}", self.op.key, "End")
        self.true(f"{axis} stands at {value}", abs(self.shown(axis) - float(value)) < 2e-3)

    def shown(self, axis):
        """Value of an axis on the display."""
        lines = self.app.widgets.numbers_text.get("1.0", "end").splitlines()
        line = next(line for line in lines if line.strip().startswith(axis.upper() + ":"))
        return float(line.split(":")[1].split()[0])

    def until(self, what, condition):
        self.op.until(condition, f"{self.name}, {what}")
        self.do(what, lambda: None)

    def moving(self):
        return self.op.stat.current_vel > 0

    def idle(self):
        self.op.idle()
        self.do("is idle", lambda: None)

    def in_line(self, line):
        self.until(f"runs in line {line}", lambda: self.op.stat.motion_line >= line)


def setting_up(d):
    """Power, homing, touch off in the hand, the first part."""
    d.keys("Right", rest=0.1)
    for axis, value in (("x", "0"), ("y", "-2.5"), ("z", "10")):
        d.touch(axis, value)
    d.mdi("T1 M6")
    d.manual()
    d.do("selects z", d.op.key, "z")
    d.say("25")
    d.do("tool touch off", d.op.key, "End", None, 4)
    d.true("the tool's length is set", abs(d.shown("z") - 25) < 2e-3)
    d.keys("exclam", "exclam", "numbersign", "numbersign", "at", "at")
    d.open("first.ngc", "G21 G90 F3000\nG1 X10\nG1 Y5\nG1 X0\nG1 Y-2.5\nM2\n")
    d.keys("r", "p", "s", "p", "s")
    d.idle()
    d.true("the part ends where it should", abs(d.shown("y") + 2.5) < 2e-3)
    d.do("undo touch off", d.op.root.tk.call, "undo_touch_off")


def tool_table(d):
    """The tool table is edited while a program runs."""
    d.open("long.ngc", "G21 G90 F600\nT2 M6 G43\nG1 X10\nG1 X0\nG1 X10\nG1 X0\nM2\n")
    d.keys("r")
    d.in_line(3)
    table = os.path.join(os.path.dirname(d.app.settings.ini_path), d.app.settings.find("EMCIO", "TOOL_TABLE"))
    with open(table) as f:
        text = f.read()
    with open(table, "w") as f:
        f.write(re.sub("^T2 .*", "T2 P2 Z51.0 D6.5", text, flags=re.M) + "T77 P7 Z33.000 D3.000 ;new\n")
    d.do("edited", lambda: None)
    d.true("not reloaded while it runs", screen_agrees.entry_state(d.op, "file", "Reload tool data") == "disabled")
    d.idle()
    d.do("reloads the table", d.op.root.tk.call, "reload_tool_table")
    d.true(f"the tool in the spindle is told anew: {d.app.vars.tool.get()}", "6.5" in d.app.vars.tool.get())
    d.mdi("T77 M6", "G43")
    d.true("the new tool", d.app.vars.tool.get() == "Tool 77, offset 33, diameter 3")
    d.mdi("T0 M6", "G49")
    d.manual()


def aborted(d):
    """A job is stopped in the middle, and begun again at a line."""
    d.open("job.ngc", "G21 G90 F1200\nG0 X0 Y0\nM3 S500\nG1 X10\nG1 Y10\nG1 X0\nG1 Y0\nM5\nM2\n")
    d.keys("r")
    d.in_line(5)
    d.keys("Escape")
    d.true("the spindle stands", d.op.stat.spindle[0]["direction"] == 0)
    d.true("the line is kept", d.app.vars.highlight_line.get() >= 5)
    for answer in (2, 0):
        d.answer(answer)
        d.do("sets the line", d.app.set_highlight_line, 6)
        d.do("run from the line", d.op.root.tk.call, "task_run_line")
    d.until("runs again", lambda: d.op.stat.interp_state != linuxcnc.INTERP_IDLE)
    d.idle()
    d.true("ended at the end", abs(d.shown("x")) + abs(d.shown("y")) < 2e-3)


def broken_tool(d):
    """A tool breaks: pause, stop, another tool, on from the line."""
    d.open("slots.ngc", "G21 G90 F900\nT1 M6\nG43 H1\nM3 S300\nG1 X8\nG1 Y8\nG1 X0\nG1 Y0\nM5 G49\nM2\n")
    d.keys("r")
    d.in_line(6)
    d.keys("p")
    d.keys("Escape")
    d.mdi("T3 M6")
    d.manual()
    d.keys("Up", rest=0.2)
    d.answer(0)
    d.do("sets the line", d.app.set_highlight_line, 6)
    d.do("run from the line", d.op.root.tk.call, "task_run_line")
    d.until("runs again", lambda: d.op.stat.interp_state != linuxcnc.INTERP_IDLE)
    d.idle()
    d.true("the tool of the program is back", d.op.stat.tool_in_spindle == 1)
    d.mdi("T0 M6", "G49")
    d.manual()


def probing(d):
    """A probe by MDI: contact, no contact, a probe that is in contact already."""
    d.mdi("G90 G0 Z20", "F300")
    d.do("MDI G38.2", d.op.type, "G38.2 Z0")
    d.until("probes", lambda: d.op.stat.probing)
    d.op.wait(0.5)
    d.pin("motion.probe-input", "1", None)
    d.idle()
    at = d.op.position(2)
    d.true("stopped at the contact", 0 < at < 20 and d.op.stat.probe_tripped)
    d.do("MDI into the contact", d.op.type, "G38.2 Z0")
    d.idle()
    d.true("told", any("probe" in m.lower() for m in d.op.messages()))
    d.true("not moved", abs(d.op.position(2) - at) < 0.5)
    d.pin("motion.probe-input", "0", None)
    d.mdi("G10 L20 P1 Z0")
    d.do("MDI without contact", d.op.type, "G38.2 Z-1")
    d.idle()
    d.true("told", any("G38.2" in m or "contact" in m for m in d.op.messages()))
    d.mdi("G10 L2 P1 Z0", "G0 Z50")
    d.manual()


def stops(d):
    """M0, M1 with and without, block delete, by the screen and by halui."""
    d.open("stops.ngc", "G21 G90 F2000\nG1 X5\nM0\nG1 X10\nM1\n/G1 Y7\nG1 X0\nM2\n")
    for m1 in (1, 0):
        d.do("M1", hal.set_p, f"halui.program.optional-stop.{'on' if m1 else 'off'}", "1")
        d.do("M1 let go", hal.set_p, f"halui.program.optional-stop.{'on' if m1 else 'off'}", "0")
        d.true("M1 as halui has it", d.app.vars.optional_stop.get() == m1)
        d.keys("r")
        d.until("M0", lambda: d.op.stat.paused)
        d.true(f"waits at M0: {d.app.vars.running_line.get()}", d.app.vars.running_line.get() in (2, 3))
        d.keys("s")
        if m1:
            d.until("M1", lambda: d.op.stat.paused and d.op.stat.motion_line >= 4)
            d.do("resume by the button", d.op.click, ".toolbar.program_pause")
        d.idle()
    moves = d.app.preview.program.n_moves
    d.do("block delete", d.op.click, ".toolbar.program_blockdelete", rest=1.0)
    d.true("the preview follows", d.app.preview.program.n_moves != moves)
    d.keys("r")
    d.until("M0", lambda: d.op.stat.paused)
    d.pin("halui.program.resume")
    d.idle()
    d.do("block delete", d.op.click, ".toolbar.program_blockdelete", rest=1.0)


def systems(d):
    """Another coordinate system between two runs."""
    d.open("corner.ngc", "G21 G90 F3000\nG1 X5 Y5\nG1 X0 Y0\nM2\n")
    for system, place in (("G55", 20), ("G59.1", -15), ("G54", 0)):
        d.mdi(system, f"G10 L2 P0 X{place} Y0 R{30 if place else 0}")
        d.manual()
        d.run()
        d.true(f"ran in {system}", abs(d.op.position(0) - place) < 1e-3)
    d.mdi("G92 X3", "G92.1")
    d.manual()
    d.do("zero of P2", d.op.root.tk.call, "clear_offset", "2", rest=1.0)
    d.do("zero of P7", d.op.root.tk.call, "clear_offset", "7", rest=1.0)


def panel(d):
    """A panel with hold, overrides and jogs beside the keys of the screen."""
    d.open("hold.ngc", "G21 G90 F600\nG1 X20\nG1 X0\nM2\n")
    d.keys("r")
    d.in_line(2)
    d.pin("halui.program.pause")
    d.true("paused", d.op.stat.paused)
    d.keys("5")
    d.pin("halui.feed-override.scale", "0.1", None)
    d.pin("halui.feed-override.increase")
    d.true("60 % on screen and machine", d.app.vars.feedrate.get() == 60)
    d.keys("s")
    d.until("moves", d.moving)
    d.pin("motion.feed-inhibit", "1", None)
    d.true("held", not d.moving())
    d.pin("motion.feed-inhibit", "0", None)
    d.keys("0", "Escape")
    d.do("max velocity", hal.set_p, "halui.max-velocity.scale", "0.5")
    d.pin("halui.max-velocity.decrease")
    d.keys("apostrophe", rest=1.5)
    d.do("to the right end", d.app.slider, "maxvel", 1.0, rest=1.5)
    d.keys("F3")
    d.do("a jog by halui", hal.set_p, "halui.axis.jog-speed", "600")
    d.pin("halui.axis.y.plus")
    d.op.wait(0.5)
    d.keys("Up", "F7", "F8", "F7", "F8", "F9", "F12", "F11", "F9")


def others(d):
    """Other clients: lines from a remote shell, modes, programs, stops, while keys are pressed."""
    d.do("remote MDI", d.op.root.tk.call, "remote", "send_mdi_command", "G0 X3", rest=1.0)
    d.do("a mode", d.other.mode, linuxcnc.MODE_MANUAL)
    d.do("coolant", d.other.flood, linuxcnc.FLOOD_ON)
    d.do("spindle", d.other.spindle, linuxcnc.SPINDLE_FORWARD, 300.0)
    d.do("override", d.other.feedrate, 0.4)
    d.do("spindle's override", d.other.spindleoverride, 0.7)
    d.keys("F9", "F8", "0")
    d.open("mine.ngc", "G21 G90 F900\nG1 X10\nG1 X0\nM2\n")
    with open(os.path.join(HERE, "theirs.ngc"), "w") as f:
        f.write("G21 G90 F900\nG1 Y10\nG1 Y0\nM2\n")
    d.do("opens another", d.other.program_open, os.path.join(HERE, "theirs.ngc"), rest=1.0)
    d.do("a mode", d.other.mode, linuxcnc.MODE_AUTO)
    d.do("runs it", d.other.auto, linuxcnc.AUTO_RUN, 0)
    d.until("moves", d.moving)
    d.keys("r", "o", "Home", "t")
    d.do("stops it", d.other.abort, rest=1.0)
    d.keys("s", "r", "Escape")
    d.do("another client powers off", d.other.state, linuxcnc.STATE_OFF)
    d.keys("Left", "r", "F2")
    d.do("teleop off", d.other.teleop_enable, 0)
    d.do("unhomed by another", d.other.unhome, 1)
    d.keys("r", "ctrl+Home", rest=1.0)
    d.true("homed", d.app.all_homed())


def bad_day(d):
    """Emergency stops at bad moments, a limit switch, homing again."""
    d.open("part.ngc", "G21 G90 F600\nM3 S400 M8\nG1 X20\nG1 X0\nM5 M9\nM2\n")
    d.keys("r")
    d.in_line(3)
    d.keys("F1")
    s = d.op.stat
    d.true("all stands", not s.flood and s.spindle[0]["direction"] == 0 and s.current_vel == 0)
    d.keys("r", "F9", "F1", "F2")
    s = d.op.stat
    d.true("nothing began by itself", not s.flood and s.spindle[0]["direction"] == 0 and s.current_vel == 0)
    d.keys("ctrl+Home", rest=1.0)
    d.pin("joint.1.pos-lim-sw-in", "1", None)
    d.true("off by the switch", d.op.stat.task_state != linuxcnc.STATE_ON)
    d.keys("F2", "l", "F2")
    d.keys("l", "Down", rest=0.6)
    d.pin("joint.1.pos-lim-sw-in", "0", None)
    if d.op.stat.task_state != linuxcnc.STATE_ON:
        d.keys("F2")
    d.keys("ctrl+Home", rest=1.0)
    d.mdi("G1 F300 X15")
    d.do("MDI", d.op.type, "G1 X0")
    d.until("moves", d.moving)
    d.keys("F2")
    d.true("off, rests", not d.moving())
    d.keys("F2", "F3", "ctrl+Home", rest=1.0)
    d.mdi("G0 X0 Y0")
    d.manual()


DAYS = (setting_up, tool_table, aborted, broken_tool, probing, stops, systems, panel, others, bad_day)


def script(op):
    sys.stdout = open("transcript", "w", buffering=1)
    order = list(DAYS)
    if "SEED" in os.environ:
        random.Random(int(os.environ["SEED"])).shuffle(order)
    if "ONLY" in os.environ:
        order = [day for day in DAYS if day.__name__ in os.environ["ONLY"].split()]
    op.power_on()
    op.home()
    for day in order:
        d = Day(op, day.__name__)
        op.app.notifications.clear()
        d.answer(0)
        try:
            day(d)
        except AssertionError as error:
            d.faults.append(str(error))
        print(f"{day.__name__}: {d.steps} steps, {len(d.faults)} differences", *d.faults, sep="\n    ")
        op.app.command.abort()
        op.app.command.wait_complete()
        op.idle()
        op.key("F3")
        op.wait(0.3)


lib.run(script)
