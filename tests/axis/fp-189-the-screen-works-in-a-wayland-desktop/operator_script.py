#!/usr/bin/python3
"""The screen in a Wayland desktop: shown, drawn with OpenGL, jogs end with the key, the focus or a stalled screen, a tab of another program."""
import os
import sys

import linuxcnc
import operator_lib as lib
from kerf import clock


def script(op):
    sys.stdout = open("transcript", "w", buffering=1)
    app, root = op.app, op.root
    print("in a Wayland desktop:", "WAYLAND_DISPLAY" in os.environ, "drawn with:", app.preview.picture.kind)
    op.until(lambda: root.winfo_viewable() and app.preview.winfo_width() > 200, "the window is shown")
    op.power_on()
    op.home()

    def moves():
        op.wait(0.3)
        return any(abs(j["velocity"]) > 0 for j in op.stat.joint[:3])
    op.hold("Right")
    print("key: moves", moves(), end=" ")
    op.let_go("Right")
    op.wait(0.5)
    print("let go: moves", moves())
    op.hold("Right")
    print("key: moves", moves(), end=" ")
    root.event_generate("<FocusOut>")
    op.wait(0.5)
    print("focus lost: moves", moves())
    op.let_go("Right")
    op.hold("Right")
    print("key: moves", moves(), end=" ")
    clock.sleep(2)                   # the screen does not get on
    op.stat.poll()
    print("stalled screen: moves", any(abs(j["velocity"]) > 0 for j in op.stat.joint[:3]))
    op.let_go("Right")
    op.key("F4")
    op.key("F4")                     # preview, DRO, the guest's tab
    op.until(lambda: os.path.exists(os.environ["SEEN"]), "the program in the tab is seen")
    print("another program in a tab: seen")
    op.key("r")
    op.until(lambda: op.stat.interp_state != linuxcnc.INTERP_IDLE, "the start")
    op.idle()
    print("the program ran:", op.position(0))


lib.run(script)
