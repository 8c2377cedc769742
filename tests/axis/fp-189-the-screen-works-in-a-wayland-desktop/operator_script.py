#!/usr/bin/python3
"""The screen in a Wayland desktop: shown, drawn with OpenGL, jogs end with the key, the focus or a stalled screen, a
tab of another program."""
import os
import subprocess
import sys

import linuxcnc
import operator_lib as lib
from axis import dialogs
from kerf import clock

ASK = dialogs.ask


def depths(window):
    """Bits of a pixel of a window and those in it: with 32 a desktop shows what is behind."""
    told = subprocess.run(["xwininfo", "-id", str(window), "-tree"], stdout=subprocess.PIPE, text=True,
                          check=True).stdout
    inside = [word for line in told.splitlines() for word in line.split()[:1] if word.startswith("0x")]
    found = set()
    for name in [str(window), *inside]:
        text = subprocess.run(["xwininfo", "-id", name], stdout=subprocess.PIPE, text=True, check=True).stdout
        found.add(int(text.split("Depth:")[1].split()[0]))
    return sorted(found)


def colours(preview):
    """True when the picture that was drawn last has more than its ground."""
    from OpenGL import GL
    width, height = preview.winfo_width(), preview.winfo_height()
    preview.invalidate()
    preview.update()
    preview.picture.window.make_current()
    pixels = GL.glReadPixels(0, 0, width, height, GL.GL_RGB, GL.GL_UNSIGNED_BYTE)
    return len({bytes(pixels[i:i + 3]) for i in range(0, len(pixels), 3)}) > 3


def places(op):
    """Questions come up over the screen, wherever the desktop has put it."""
    app, root, seen, modal = op.app, op.root, [], []
    wait = dialogs.Modal.wait
    dialogs.Modal.wait = lambda self, focus=None: modal.append(self) or wait(self, focus)

    def look():
        window = next((w for w in root.winfo_children() if w.winfo_class() == "Dialog"), None)
        if window is None or not window.winfo_viewable():
            root.after(100, look)
            return
        x, y = (a + b // 2 for a, b in ((window.winfo_rootx(), window.winfo_width()),
                                        (window.winfo_rooty(), window.winfo_height())))
        seen.append(root.winfo_rootx() < x < root.winfo_rootx() + root.winfo_width()
                    and root.winfo_rooty() < y < root.winfo_rooty() + root.winfo_height())
        modal[-1].answer(None)
    root.after(400, look)
    dialogs.ask = ASK
    app.confirm_close()
    dialogs.Modal.wait = wait
    op.answer(0)
    print("a question is over the screen:", *seen)


def script(op):
    sys.stdout = open("transcript", "w", buffering=1)
    app, root = op.app, op.root
    print("in a Wayland desktop:", "WAYLAND_DISPLAY" in os.environ, "drawn with:", app.preview.picture.kind)
    op.until(lambda: root.winfo_viewable() and app.preview.winfo_width() > 200, "the window is shown")
    op.power_on()
    op.home()
    print("the preview is opaque:", depths(app.preview.winfo_id()), "and shows colours:", colours(app.preview))

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
    op.wait(0.5)
    op.hold("Right")
    op.wait(0.5)                     # the run-up
    speeds, commands = set(), op.stat.echo_serial_number
    for _ in range(30):              # the desktop repeats a held key as release and press
        root.event_generate("<KeyRelease-Right>")
        root.event_generate("<KeyPress-Right>")
        op.wait(0.03)
        speeds.add(round(op.stat.joint[0]["velocity"], 6))
    print("the key repeats: one speed:", len(speeds - {0.0}) == 1, "commands:", op.stat.echo_serial_number - commands,
          "moves", moves(), end=" ")
    op.let_go("Right")
    op.wait(0.5)
    print("let go: moves", moves())
    op.key("F4")
    op.key("F4")                     # preview, DRO, the guest's tab
    op.until(lambda: os.path.exists(os.environ["SEEN"]), "the program in the tab is seen")
    print("another program in a tab: seen")
    op.key("r")
    op.until(lambda: op.stat.interp_state != linuxcnc.INTERP_IDLE, "the start")
    op.idle()
    print("the program ran:", op.position(0))
    places(op)          # at last: without a seat this desktop gives the focus back to nobody


lib.run(script)
