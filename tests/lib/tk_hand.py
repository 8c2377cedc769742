# SPDX-License-Identifier: GPL-2.0-or-later
"""A hand for tests of Tk windows: pointer and keyboard of the X server (xdotool), in the program's own process.

    hand = Hand(root)
    hand.click(button)
    hand.type("12.5"); hand.key("Return")
    with hand.answers("yes"): hand.click(quit)      # a message box that comes up

Tk's errors are printed as TRACEBACK lines: no test expects one.
"""

import contextlib
import subprocess
import sys
import traceback


class Hand:
    def __init__(self, root):
        self.root = root
        root.report_callback_exception = lambda *what: print("TRACEBACK", "".join(traceback.format_exception(*what)))
        root.update()
        root.focus_force()
        self.settle()

    def _x(self, *words):
        subprocess.run(["xdotool", *map(str, words)], check=True, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                       stderr=sys.stderr)
        self.settle()

    def settle(self):
        """Everything that the server has told is done."""
        if self._alive():
            self.root.update()
        if self._alive():
            self.root.update_idletasks()
            self.root.update()

    def _alive(self):
        try:
            return bool(self.root.winfo_exists())
        except Exception:           # the application has been destroyed
            return False

    def place(self, widget, x=None, y=None):
        """On the screen: the middle of a widget, or a point of it."""
        self.root.update()
        return (widget.winfo_rootx() + (widget.winfo_width() // 2 if x is None else x),
                widget.winfo_rooty() + (widget.winfo_height() // 2 if y is None else y))

    def click(self, widget, button=1, x=None, y=None, times=1):
        at = self.place(widget, x, y)
        self._x("mousemove", *at)
        self._x("click", "--repeat", times, "--delay", 20, button)

    def press(self, widget, button=1, x=None, y=None):
        self._x("mousemove", *self.place(widget, x, y))
        self._x("mousedown", button)

    def release(self, button=1):
        self._x("mouseup", button)

    def drag(self, widget, start, end, button=1):
        a, b = self.place(widget, *start), self.place(widget, *end)
        self._x("mousemove", *a)
        self._x("mousedown", button)
        self._x("mousemove", (a[0] + b[0]) // 2, (a[1] + b[1]) // 2)
        self._x("mousemove", *b)
        self._x("mouseup", button)

    def row(self, tree, item, button=1, column="#0", times=1):
        """Clicks an item of a Treeview."""
        tree.see(item)
        self.root.update()
        x, y, width, height = tree.bbox(item, column) if column != "#0" else tree.bbox(item)
        self.click(tree, button, x + min(width - 4, 60), y + height // 2, times)

    def pick(self, menu, label):
        """An entry of a posted menu."""
        self.root.update()
        index = menu.index(label)
        below = menu.yposition(index + 1) if index < menu.index("end") else menu.winfo_height() - 2
        self.click(menu, x=menu.winfo_width() // 2, y=(menu.yposition(index) + below) // 2)

    def key(self, *names):
        self._x("key", *names)

    def type(self, text):
        self._x("type", "--delay", 1, "--", text)

    def cleared(self, entry, text):
        """Clicks an entry and puts this text in."""
        self.click(entry)
        self.key("ctrl+a")
        self.key("ctrl+slash")      # Tk's own "select all"
        self.key("BackSpace")
        self.type(text)

    @contextlib.contextmanager
    def answers(self, *buttons, parent=""):
        """Message boxes that come up are printed and answered with these buttons, one after the other."""
        waiting = list(buttons)
        box = f"{parent}.__tk__messagebox"

        def look():
            if not self._alive():
                return
            call = self.root.tk.call
            if int(call("winfo", "exists", box)) and int(call("winfo", "ismapped", box)):
                print("box:", " ".join(str(call(f"{box}.msg", "cget", "-text")).split()), f"[{waiting[0]}]")
                call(f"{box}.{waiting.pop(0)}", "invoke")
            if waiting:
                self.root.after(20, look)
        self.root.after(20, look)
        yield
        for button in waiting:
            print(f"no box for {button}")

