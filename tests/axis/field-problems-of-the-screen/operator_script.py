#!/usr/bin/python3
import os
import signal
import sys
import threading

import hal
import linuxcnc
import operator_lib as lib
from axis import dialogs
from axis.program import properties
from kerf import clock


def script(op):
    sys.stdout = open("transcript", "w", buffering=1)
    app, here = op.app, os.path.dirname(sys.argv[-1])
    op.power_on()
    op.home()
    jogging(op)
    programs(op, here)
    loading(op, here)
    others(op, here)
    touching_off(op)
    waiting_lines(op)
    reports(op)


def at_rest(op):
    """True when no joint moves a second later."""
    op.wait(1.0)
    before = op.stat.actual_position
    op.wait(0.3)
    return before == op.stat.actual_position


def jogging(op):
    app, root = op.app, op.root

    def jog(key="Left", state=0):
        op.hold(key, state=state)
        op.wait(0.2)
        return abs(op.stat.joint[0]["velocity"]) > 0
    print("FP-060: moves", jog(), end=" ")
    app.vars.jogincrement.set("1mm")
    app.increment_chosen()
    op.let_go("Left")
    print("increment chosen meanwhile, let go: rests", at_rest(op))
    app.continuous()
    plus = ".pane.top.tabs.fmanual.jogf.jog.jogplus"
    app.activate_ja_widget("x")
    for event in ("<Enter>", "<Button-1>"):
        root.tk.call("event", "generate", plus, event, "-x", 3, "-y", 3)
    op.wait(0.2)
    print("FP-060: a button: moves", abs(op.stat.joint[0]["velocity"]) > 0, end=" ")
    app.vars.jogincrement.set("1mm")
    root.tk.call("event", "generate", plus, "<ButtonRelease-1>", "-x", 3, "-y", 3)
    root.tk.call("event", "generate", plus, "<Leave>")
    print("increment chosen meanwhile, let go: rests", at_rest(op), end=" ")
    at = op.position(0)
    op.wait(0.5)
    print("no step more:", op.position(0) == at)
    app.continuous()
    print("FP-061: moves", jog(state=1), end=" ")
    root.event_generate("<KeyRelease-Shift_L>", state=1)
    print("modifier let go first: rests", at_rest(op), end=" ")
    op.let_go("Left")
    print("moves", jog("KP_Left"), end=" ")
    op.let_go("KP_4")            # the same key has another name with another modifier
    print("release of another name: rests", at_rest(op))
    print("FP-061: moves", jog(), end=" ")
    op.key("F5")
    print("other tab: rests", at_rest(op), end=" ")
    op.let_go("Left")
    op.key("F3")
    print("moves", jog(), end=" ")
    root.event_generate("<FocusOut>")
    print("focus lost: rests", at_rest(op), end=" ")
    op.let_go("Left")
    op.key("F3")
    print("moves", jog(), end=" ")
    app.command.mode(linuxcnc.MODE_MDI)          # another client
    op.wait(0.3)
    print("other mode while a key is held: refused", op.stat.task_mode == linuxcnc.MODE_MANUAL, end=" ")
    op.let_go("Left")
    print("let go: rests", at_rest(op))
    op.key("F3")
    print("FP-061: moves", jog(), end=" ")
    clock.sleep(1.5)             # the screen does not get on
    before = op.stat.actual_position
    clock.sleep(0.3)
    print("stalled screen: rests", before == op.stat.actual_position)
    op.wait(0.1)
    op.let_go("Left")
    print("FP-064: moves", jog(), end=" ")
    speeds, commands = set(), op.stat.echo_serial_number
    for _ in range(30):                          # the desktop repeats a held key as release and press
        root.event_generate("<KeyRelease-Left>")
        root.event_generate("<KeyPress-Left>")
        op.wait(0.03)
        speeds.add(round(op.stat.joint[0]["velocity"], 6))
    print("one speed while the key repeats:", len(speeds) == 1 and speeds != {0.0},
          "commands:", op.stat.echo_serial_number - commands, end=" ")
    speed, start = abs(speeds.pop()), op.stat.actual_position[0]
    op.let_go("Left")
    stopping = speed * speed / 2 / 1000 + speed * 0.03      # by acceleration, and until the command is there
    print("let go: rests", at_rest(op), "within its stopping distance:",
          abs(op.stat.actual_position[0] - start) <= stopping)


def programs(op, here):
    app = op.app
    path = os.path.join(here, "part.ngc")
    with open(path) as f:
        text = f.read()
    print("FP-138: run time with dwell:",
          [value for name, value in properties(app.shown_file, None, app.preview.program, app.settings, True)
           if name == "Run time"])
    with open(path, "w") as f:
        f.write(text.replace("G1 Y20", "G1 Y-80"))
    op.wait(0.5)
    print("FP-130:", [m.split(" ")[1:5] for m in op.messages() if "on disk" in m], end=" ")
    op.key("r")
    op.wait(0.3)
    print("FP-186: not run:", op.stat.interp_state == linuxcnc.INTERP_IDLE, "told:",
          any("open it again" in m for m in op.messages()), "text shown:", app.line_text(5))
    op.key("r", state=4)         # Control-R: reload, a copy that later edits do not touch
    op.wait(0.3)
    with open(path, "w") as f:
        f.write(text.replace("G1 Y20", "G1 Y-90"))
    op.key("r")
    lowest, lines, places = 0.0, set(), set()
    while op.stat.interp_state != linuxcnc.INTERP_IDLE or not lines:
        op.wait(0.1)
        lowest = min(lowest, op.stat.actual_position[1])
        lines.add(app.vars.running_line.get())
        if app.place:
            places.add(app.place)
    print("FP-130: edited after a reload: ran as it was shown:", round(lowest) == -80, "text shown:", app.line_text(5))
    print("FP-139: lines marked within the program:", max(lines) <= 9, "places in the subroutine:", sorted(places))
    with open(path, "w") as f:
        f.write(text)
    op.wait(0.5)
    op.key("r", state=4)         # Control-R: reload
    op.wait(0.3)
    print("FP-139: opened again:", app.loaded_file == path, app.preview.program.error or "no error")
    op.answer(2)
    app.set_highlight_line(5)
    op.key("F3")
    op.root.tk.call("task_run_line")
    op.wait(0.5)
    print("FP-131: cancelled: idle", op.stat.interp_state == linuxcnc.INTERP_IDLE, "nothing pending",
          op.stat.restore_line == 0)
    op.answer(0)
    op.root.tk.call("task_run_line")
    op.until(lambda: op.stat.interp_state != linuxcnc.INTERP_IDLE, "the restored start")
    op.idle()
    print("FP-131: restored and run to the end:", [op.position(i) for i in (0, 1)])
    op.key("F5")
    before = tuple(app.preview.drawings[0].extents[0])
    op.type("G10 L2 P1 X10 Y0 Z0 R90")
    op.idle()
    op.wait(0.2)
    clock_wait(op)
    after = tuple(app.preview.drawings[0].extents[0])
    print("FP-134: rotated by hand: preview follows", [round(25.4 * (b - a), 3) for a, b in zip(before, after)][:2])
    op.type("G92 Y1")
    op.idle()
    clock_wait(op)
    third = tuple(app.preview.drawings[0].extents[0])
    print("FP-134: G92: preview follows", third != after)
    op.type("G92.1")
    op.idle()
    op.type("G10 L2 P1 X0 Y0 Z0 R0")
    op.idle()
    clock_wait(op)
    print("FP-134: back:", tuple(app.preview.drawings[0].extents[0]) == before)
    follow_modes(op, path)


def follow_modes(op, path):
    """What a program finds that sets nothing itself."""
    app, found = op.app, []
    app.open_file_guts(os.path.join(os.path.dirname(path), "plain.ngc"))
    for line in ("G21", "G20", "G18", "G21 G17", "G43.1 Z5", "G49"):
        reading = app.preview.program
        op.type(line)
        op.idle()
        op.wait(0.2)
        clock_wait(op)
        low, high = app.preview.drawings[0].extents
        sizes = [round(25.4 * (b - a), 1) for a, b in zip(low, high)]
        found.append((line, "read anew" if app.preview.program is not reading else "kept", sizes,
                      round(25.4 * low[2], 1)))
    print("FP-134: units, plane, tool length by hand:", *found, sep="\n  ")
    app.open_file_guts(path)


def others(op, here):
    """Other clients open programs: what is shown is what would run."""
    app, client = op.app, linuxcnc.command()
    one, two = os.path.join(here, "part.ngc"), os.path.join(here, "two.ngc")

    def opens(path):
        client.program_open(path)
        client.wait_complete()
    with open(two, "w") as f:
        f.write("G21 G90 F1000\nG1 X3\nG1 X900\nM2\n")
    app.notifications.clear()
    opens(two)
    op.root.tk.call("task_run")                  # before the screen has looked around
    op.wait(0.3)
    print("FP-130: another client's program, R at once: runs", op.stat.interp_state != linuxcnc.INTERP_IDLE, "shown",
          app.line_text(2), op.messages())
    asks = dialogs.ask

    def ask(root, title, *rest, **more):
        print("FP-130:", title, end=" ")
        opens(one)
        op.app.look_around()
        return 1
    dialogs.ask = ask
    op.root.tk.call("task_run")
    op.wait(0.3)
    dialogs.ask = asks
    print("answered after another was opened: runs", op.stat.interp_state != linuxcnc.INTERP_IDLE, "shown",
          os.path.basename(app.shown_file))
    with open(one) as f:
        text = f.read()
    with open(one, "w") as f:
        f.write(text + "(longer)\n")
    opens(one)
    op.root.tk.call("task_run")
    op.wait(0.3)
    print("FP-130: changed and opened by another client: runs", op.stat.interp_state != linuxcnc.INTERP_IDLE, "told:",
          "open it again" in op.messages()[-1])
    app.loading = True
    print("axis-remote while a program is opened:", op.root.tk.call("remote", "open_file_name", two), "|",
          op.root.tk.call("remote", "reload_file"))
    app.loading = False
    with open(one, "w") as f:
        f.write(text)
    app.open_file_guts(one)
    op.key("F3")


def waiting_lines(op):
    box = str(op.app.widgets.mdi_waiting)
    op.key("F5")
    for line in ("G4 P0.5", "M66 P0 L3 Q1", "G0 X5", "G0 X7", "G0 X6"):
        op.type(line)
    op.wait(0.2)
    print("FP-127: waiting:", op.root.tk.splitlist(op.root.tk.call(box, "get", 0, "end")), "shown:",
          op.root.tk.call("winfo", "ismapped", box))
    x, y, _, height = op.root.tk.splitlist(op.root.tk.call(box, "bbox", 1))
    for event in ("<ButtonPress-1>", "<ButtonRelease-1>") * 2:
        op.root.tk.call("event", "generate", box, event, "-x", int(x) + 2, "-y", int(y) + int(height) // 2)
    op.wait(0.2)
    print("FP-127: the second one cancelled:", op.root.tk.splitlist(op.root.tk.call(box, "get", 0, "end")))
    op.idle()
    op.wait(0.2)
    print("FP-127: done:", op.position(0), op.messages(), "shown:", op.root.tk.call("winfo", "ismapped", box))


def clock_wait(op):
    """The offsets have rested long enough for the preview (real time: what a person waits)."""
    op.app.stale_since = op.app.stale_since and op.app.stale_since - 10
    op.app.follow_offsets()
    op.wait(0.1)


def loading(op, here):
    app = op.app
    op.key("F3")
    op.root.after(150, lambda: op.root.event_generate("<KeyPress-Escape>"))
    app.open_file_guts(os.path.join(here, "endless.ngc"))
    print("FP-136: endless program: Escape ends the reading:", app.preview.program.aborted, "shown:",
          app.preview.program.n_moves > 0, "limits not fully checked:",
          any("truncated" in w for w in app.limit_warnings()))
    op.root.after(150, lambda: op.root.event_generate("<KeyPress-F1>"))
    op.root.after(400, lambda: op.root.event_generate("<KeyPress-Escape>"))
    app.open_file_guts(os.path.join(here, "endless.ngc"))
    print("FP-187: emergency stop while loading:", op.stat.task_state == linuxcnc.STATE_ESTOP, end=" ")
    op.wait(0.3)
    op.power_on()
    print("usable after it:", app.vars.task_state_string.get(), "loading over:", not app.loading)
    beside(op, here)
    remote_estop(op, here)
    op.answer(0)
    app.open_file_guts(os.path.join(here, "broken.ngc"))
    op.wait(0.2)
    app.open_file_guts(os.path.join(here, "part.ngc"))
    app.open_file_guts(os.path.join(here, "part.ngc"))
    print("FP-139: opened twice:",
          op.messages()[-1:] if any("open" in m for m in op.messages()[-1:]) else "no complaint")


def remote_estop(op, here):
    """FP-187: halui's emergency stop in each part of the loading: the filter, task, reading."""
    app, at, go = op.app, [], os.environ["GO"]
    begun, done = threading.Event(), threading.Event()
    real = {"filter": app.loader.filtered, "copy": app.loader.kept_text, "reading": app.loader.read}

    def stopped_at(name, function):
        def call(*args, **more):
            if at == [name]:
                begun.set()
                done.wait(20)
            return function(*args, **more)
        return call

    def stop():
        """On the screen's own thread, as an update would find it."""
        if not begun.is_set():
            op.root.after(20, stop)
            return
        at.append(linuxcnc_stat().task_state == linuxcnc.STATE_ON)
        hal.set_p("halui.estop.activate", "1")
        at.append(clock.wait_until(lambda: linuxcnc_stat().task_state == linuxcnc.STATE_ESTOP, 1.0, 0.02))
        done.set()
    def read(*args):
        reading = real["reading"](*args)
        reading.result = stopped_at("reading", reading.result)
        return reading
    app.loader.filtered, app.loader.kept_text, app.loader.read = (stopped_at("filter", real["filter"]),
                                                                  stopped_at("copy", real["copy"]), read)
    open(go, "w").close()
    for name in ("filter", "copy", "reading"):
        at[:] = [name]
        begun.clear()
        done.clear()
        op.root.after(20, stop)
        app.open_file_guts(os.path.join(here, "part.wait"))
        op.wait(0.3)
        estop, hand = app.vars.task_state_string.get(), app.loading
        hal.set_p("halui.estop.activate", "0")
        op.power_on()
        op.hold("Left")
        op.wait(0.2)
        moves = abs(op.stat.joint[0]["velocity"]) > 0
        op.let_go("Left")
        op.wait(0.5)
        print("FP-187: loading,", at[0], "on", at[1], "stopped meanwhile", at[2], "| after it: screen", estop,
              "loading", hand, "then", app.vars.task_state_string.get(), "jogs", moves)
    os.remove(go)
    app.loader.filtered, app.loader.kept_text, app.loader.read = (real[n] for n in ("filter", "copy", "reading"))


def linuxcnc_stat():
    s = linuxcnc.stat()
    s.poll()
    return s


def beside(op, here):
    """What takes long waits here for the screen: it goes on, or nothing would."""
    app = op.app
    os.environ["GO"] = go = os.path.join(here, "go")
    op.root.after(50, lambda: open(go, "w").close())
    app.open_file_guts(os.path.join(here, "part.wait"))
    print("FP-136: the screen goes on: while a silent filter works:", app.code.total, "lines,", end=" ")
    looks, read = [], app.loader.read

    def stopped(*args):
        """The process that reads is stopped until the screen has looked around three times."""
        reading = read(*args)
        os.kill(reading.child.pid, signal.SIGSTOP)

        def go_on():
            looks.append(True)
            if len(looks) == 3:
                os.kill(reading.child.pid, signal.SIGCONT)
            op.root.after(20, go_on)
        op.root.after(20, go_on)
        return reading
    app.loader.read = stopped
    app.open_file_guts(os.path.join(here, "part.ngc"))
    print("while the program is read:", len(looks) >= 3, end=" ")
    del app.loader.read
    os.remove(go)
    op.root.after(300, lambda: op.root.event_generate("<KeyPress-Escape>"))
    app.open_file_guts(os.path.join(here, "part.wait"))
    print("Escape ends a filter:", os.path.basename(app.loaded_file), "loading over:", not app.loading)


def touching_off(op):
    app = op.app
    op.key("F5")
    op.type("G55")
    op.idle()
    op.key("F3")
    asked = []

    def wait(dialog, focus=None):
        asked.append((dialog.system.get() if dialog.system else None,
                      [w.cget("text") for w in dialog.window.winfo_children() if w.winfo_class() == "Label"]))
        dialog.value.set("5")
        dialog.accept()
        dialog.window.destroy()
        return dialog.result
    dialogs.Touchoff.wait = wait
    app.vars.touch_off_system.set("P0")
    app.notifications.clear()
    app.activate_ja_widget("x")
    for pin, value in (("jog-scale", "0.5"), ("jog-enable", "1"), ("jog-counts", "1")):          # its own wheel
        hal.set_p(f"axis.y.{pin}", value)
    op.wait(1.0)
    hal.set_p("axis.y.jog-enable", "0")
    print("FP-183: the axis that its wheel moved is chosen:", app.vars.ja_rbutton.get(), "moved:", op.position(1))
    before = app.stat.g5x_offset
    op.key("End")
    op.wait(0.3)
    s = op.stat
    print("FP-185:", asked[0][0], "|", asked[0][1][1], "| changed:", s.g5x_index,
          [i for i in range(9) if abs(before[i] - s.g5x_offset[i]) > 1e-9])
    print("FP-183:", op.messages()[-1].split(":")[0:2], "shown value",
          [x for x in app.preview.readout_lines if x.strip().startswith("Y:")][0].split()[1])
    op.root.tk.call("undo_touch_off")
    op.wait(0.3)
    print("FP-183: taken back:", all(abs(a - b) < 1e-6 for a, b in zip(before, op.stat.g5x_offset)), "only once:",
          app.undo_lines)
    app.notifications.clear()
    op.root.tk.call("set_axis_offset")                                                  # Shift-Home
    app.vars.touch_off_system.set("P3")
    dialogs.Touchoff.wait = wait
    op.key("End")
    op.wait(0.3)
    print("FP-183: another system:", op.messages()[-1:], end=" ")
    op.root.tk.call("undo_touch_off")
    op.wait(0.3)
    op.key("F5")
    app.notifications.clear()
    op.type("(debug,P3 is #5262)")
    op.until(lambda: any("P3 is" in m for m in op.messages()), "parameter of the other system")
    print("taken back:", op.messages()[-1:])
    op.key("F3")
    app.vars.touch_off_system.set("P0")
    shown = {w.split(":")[0].strip(): float(w.split(":")[1].split()[0])
             for w in app.preview.readout_lines if w.count(":") and w.strip()[:2] in ("X:", "Y:", "Z:")}
    s = op.stat
    agrees = all(abs(shown[c] - (s.actual_position[i] - s.tool_offset[i] - s.g5x_offset[i] - s.g92_offset[i])) < 2e-3
                 for i, c in enumerate("XYZ"))
    print("FP-184: display is machine less offsets:", agrees, "system shown:",
          {x.split()[0] for x in app.preview.readout_lines if x.strip().startswith("G5")})


def reports(op):
    app = op.app
    app.TclCommands.fails = staticmethod(fails)
    app.TclCommands(op.root)
    sys.stderr = open(os.devnull, "w")
    op.root.tk.call("fails")
    op.wait(0.2)
    print("FP-188: told:", "on purpose" in op.messages()[-1], "report named:", "report-" in op.messages()[-1],
          "the screen goes on:", op.stat.task_state == linuxcnc.STATE_ON)
    with open(op.messages()[-1].split("Report: ")[1]) as f:
        report = f.read()
    events = report.split("the last ")[1].splitlines()
    print("FP-188: report: stack", "on purpose" in report and "in fails" in report, "configuration hash",
          len(report.split("sha256 ")[1].split()[0]) == 64,
          "events", 20 < int(events[0].split()[0]) <= 1000 and len(events) > 20, "last:", events[-1].split(" ", 1)[1])


def fails(*args):
    raise RuntimeError("on purpose")


lib.run(script)
