#!/usr/bin/python3
import os
import subprocess
import sys
import time

from kerf import clock
import operator_lib as lib


def halcmd(*words):
    return clock.run(["halcmd", *words], stdout=subprocess.PIPE, text=True).stdout.strip()


def container(widget):
    """The X window below a widget that another program has its window in."""
    for child in widget.winfo_children():
        if "container" in child.keys() and str(child["container"]) == "1":
            return child.winfo_id()
        if found := container(child):
            return found
    return 0


def script(op):
    sys.stdout = open("transcript", "w", buffering=1)
    app, tcl = op.app, op.root.tk
    end = time.monotonic() + 60          # the panel of the other program comes in real time
    while op.root.state() != "normal" and time.monotonic() < end:
        op.wait(0.02)
        time.sleep(0.02)
    op.root.geometry("1000x700")
    op.wait(0.3)
    print("messages:", [m.splitlines()[0].split("/")[0] for m in op.messages()])
    print("pages:", *map(str, tcl.splitlist(tcl.call(".pane.top.right", "pages"))),
          "|", *[tcl.call(".pane.top.right", "itemcget", p, "-text")
                 for p in tcl.splitlist(tcl.call(".pane.top.right", "pages"))])
    print("menu has the panel:",
          any("PyVCP" in str(tcl.call(".menu.view", "entrycget", i, "-label"))
              for i in range(int(tcl.call(".menu.view", "index", "end")) + 1)
                                     if str(tcl.call(".menu.view", "type", i)) != "separator"))
    if app.panel is None:
        print("no panel; the screen works:", op.enabled(".toolbar.machine_power") or True)
        return
    grid = dict(zip(*[iter(map(str, tcl.splitlist(tcl.call("grid", "info", ".pyvcp"))))] * 2))
    print("panel: column", grid["-column"], "row", grid["-row"], "shown:", bool(app.panel.winfo_viewable()))
    for line in halcmd("-s", "show", "pin", "pyvcp").splitlines() + halcmd("-s", "show", "pin", "my_lamp").splitlines():
        print(" ".join(line.split()[1:3]), line.split()[4])
    op.key("e", state=4)
    op.root.update()
    print("Ctrl-E: shown:", bool(app.panel.winfo_viewable()), end=" ")
    op.key("e", state=4)
    op.root.update()
    print("again:", bool(app.panel.winfo_viewable()))
    xid = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(app.settings.ini_path))), "xid")
    end = time.monotonic() + 60          # a process of the outside world: real time
    while not (os.path.exists(xid) and os.path.getsize(xid) > 1) and time.monotonic() < end:
        time.sleep(0.02)
    print("the guest got the window's id:",
          int(open(xid).read()) == container(op.root.nametowidget(tcl.call(".pane.top.right", "getframe", "user_1"))))
    print("forwards events to:", int(os.environ["AXIS_FORWARD_EVENTS_TO"]) == op.root.winfo_id())
    with open(os.path.join(os.path.dirname(xid), "words")) as f:
        words = f.read().split(None, 4)
    grid = dict(zip(*[iter(map(str, tcl.splitlist(tcl.call("grid", "info", ".gladevcp"))))] * 2))
    print("GladeVCP: column", grid["-column"], "row", grid["-row"], *words[:4],
          int(words[4].split()[0]) == container(op.root.nametowidget(".gladevcp")), words[4].split(None, 1)[1].strip(),
          "| linked by", halcmd("-s", "show", "pin", "side.level").split()[-1])
    op.key("F4")
    op.key("F4")
    print("F4 twice:", tcl.call(".pane.top.right", "raise"))


lib.run(script)
