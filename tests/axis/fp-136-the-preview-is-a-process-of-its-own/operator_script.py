#!/usr/bin/python3
import os
import signal
import sys
import time

import linuxcnc
import operator_lib as lib
from axis import opening


def gone(pid):
    """Whether a process has ended; its parent may not have looked yet."""
    try:
        with open(f"/proc/{pid}/stat") as f:
            return f.read().rsplit(")", 1)[1].split()[0] == "Z"
    except FileNotFoundError:
        return True


def script(op):
    sys.stdout = open("transcript", "w", buffering=1)
    app, here = op.app, os.path.dirname(os.getcwd())
    read, done, impatient = app.loader.read, [], []
    op.power_on()
    op.home()

    def open_while(name, disturb=None):
        """Opens a program; disturb(process number) is called when it begins to be read for the picture."""
        op.key("F3")
        app.notifications.clear()
        done.clear()

        def disturbed(*args):
            reading = read(*args)
            done.append("path" if args[3] else "limits")
            if args[3] and disturb:
                disturb(reading.child.pid)
            if not args[3] and impatient:
                op.root.after(50, impatient.pop())
            return reading
        app.loader.read = disturbed
        app.open_file_guts(os.path.join(here, name))
        op.wait(0.1)

    def show(what):
        p = app.preview
        print(f"{what}: drawn: {len(p.drawings)}, whole: {not p.program.aborted}, told: {op.messages()}, usable: "
              f"{not app.loading and op.stat.task_state == linuxcnc.STATE_ON}")

    def run():
        """r is pressed; what the operator is asked, how far the machine went."""
        done.clear()
        op.key("r")
        op.wait(0.2)
        started = op.stat.interp_state != linuxcnc.INTERP_IDLE
        op.key("Escape")
        op.idle()
        print("  run: readings:", done, "started:", started)

    app.follow_offsets = lambda: None
    escape = lambda: op.root.event_generate("<KeyPress-Escape>")
    op.answer(2)
    open_while("part.ngc")
    print("a process of its own:", app.loader.reading.child.pid != os.getpid(), "ended:",
          app.loader.reading.child.returncode)
    show("as usual")
    run()

    rounds = [200]

    def late():
        """As an update cycle on a machine that is too slow for it: the next one is due before this one is done."""
        rounds[0] -= 1
        if rounds[0]:
            op.root.after(1, late)
            time.sleep(0.01)
    app.loader.read = lambda *args: (late(), read(*args))[1]
    app.open_file_guts(os.path.join(here, "part.ngc"))
    print("opened while update cycles are late:", rounds[0] > 0, op.messages())
    op.until(lambda: rounds[0] == 0, "the end of the cycles")
    open_while("pins.ngc")
    print("reads the machine's pins:", [round(25.4 * x) for x in app.preview.program.extents[1]], op.messages())

    def stops(pid):
        os.kill(pid, signal.SIGSTOP)
        op.root.after(100, escape)
    open_while("part.ngc", stops)
    show("hangs, Escape")
    run()
    open_while("part.ngc", lambda pid: os.kill(pid, signal.SIGSEGV))
    show("crashes")
    run()
    for name, end in (("hangs", escape), ("crashes", None)):
        if end:
            op.root.after(600, end)
        open_while(f"fork-{name}.ngc")
        show(f"a remap in Python that forks and {name}")
        with open(os.path.join(here, "forked")) as f:
            print("  what it started is gone:", gone(int(f.read())), "by itself:",
                  os.path.exists(os.path.join(here, "forked-ended")))
    app.loader.megabytes = 10
    open_while("beyond.ngc")
    show("too much memory")
    run()
    app.loader.megabytes = 400

    open_while("beyond.ngc", lambda pid: (os.kill(pid, signal.SIGSTOP),
                                          op.root.after(50, lambda: (escape(), os.kill(pid, signal.SIGCONT)))))
    show("cancelled")
    run()
    real, app.settings.real = (app.settings.real,
                               lambda names, default=0.0: 0.3 if names[1] == "PREVIEW_TIMEOUT"
                               else real(names, default=default))
    open_while("endless.ngc")
    show("its time is over")
    impatient.append(escape)
    run()
    longest, opening.LONGEST_PREVIEW_S = opening.LONGEST_PREVIEW_S, 0.3
    run()
    run()
    opening.LONGEST_PREVIEW_S = longest
    app.settings.real = (lambda names, default=0.0: 1e-5 if names[1] == "GRAPHICAL_MAX_FILE_SIZE"
                         else real(names, default=default))
    open_while("beyond.ngc")
    show("only a box")
    run()
    app.settings.real = real

    def edited(pid):
        with open(os.path.join(here, "part.ngc")) as f:
            text = f.read()
        with open(os.path.join(here, "part.ngc"), "w") as f:
            f.write(text.replace("X5", "X70"))
    open_while("part.ngc", edited)
    op.wait(0.5)
    app.refresh_preview()
    print("FP-130: edited while it is read: text", app.line_text(3), "preview to X",
          round(25.4 * app.preview.program.extents[1][0], 3),
          "told:", [m.split(" on disk")[0] for m in op.messages()])
    op.key("r", state=4)
    print("FP-130: reloaded: text", app.line_text(3), "preview to X",
          round(25.4 * app.preview.program.extents[1][0], 3))
    open_while("part.ngc")
    op.key("F5")
    op.type("G10 L2 P1 X-3000")
    op.idle()
    op.key("F3")
    print("offsets that the preview does not know:", app.preview.program.extents_tool[0][0] == 0)
    run()


lib.run(script)
