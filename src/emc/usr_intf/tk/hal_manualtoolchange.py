#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Asks the operator to change tools: HAL component hal_manualtoolchange.

Pins: number (s32 in), change, change_button (bit in), changed (bit out). A request is
confirmed with the window's button or with change_button. Without a display only the
pins exist: a push button on change_button then confirms.
"""

import os
import sys
from pathlib import Path

here = Path(__file__).resolve().parent
if (here.parent / "lib/python/kerf").is_dir():
    sys.path.insert(0, str(here.parent / "lib/python"))

import hal

POLL_S = 0.1
WITHDRAW_MS = 10_000
TITLE = "Tool change"


def make_component():
    component = hal.component("hal_manualtoolchange")
    component.newpin("number", hal.HAL_S32, hal.HAL_IN)
    component.newpin("change", hal.HAL_BIT, hal.HAL_IN)
    component.newpin("change_button", hal.HAL_BIT, hal.HAL_IN)
    component.newpin("changed", hal.HAL_BIT, hal.HAL_OUT)
    component.ready()
    return component


class Exchange:
    """The handshake, without any window. step() is called every POLL_S seconds."""

    def __init__(self, component):
        self.pins = component
        self.asking = False

    def step(self):
        """Returns "ask" when a dialog should open, "close" when it should go, else None."""
        pins = self.pins
        if not pins["change"]:
            pins["changed"] = False
            if self.asking:
                self.asking = False
                return "close"
        elif not pins["changed"]:
            if pins["change_button"]:
                return self.confirm()
            if not self.asking:
                self.asking = True
                return "ask"
        return None

    def confirm(self):
        """The operator says that the tool is in place."""
        self.asking = False
        if self.pins["change"]:
            self.pins["changed"] = True
        return "close"


def request_text(number):
    """What the operator reads. Tool data come from the status channel."""
    if number == 0:
        return "Remove the tool and click continue when ready"
    try:
        import linuxcnc
        stat = linuxcnc.stat()
        stat.poll()
        tool = next(t for t in stat.tool_table if t.id == number)
        units = linuxcnc.ini(os.environ["INI_FILE_NAME"]).find("TRAJ", "LINEAR_UNITS")
        comment = getattr(tool, "comment", "")
        return ("Insert tool and click continue when ready.\n\n"
                f"Tool number: {number}\nDiameter: {tool.diameter:.4f}{units}\nComment: {comment}")
    except Exception as e:      # the request must be shown, whatever is wrong with the data
        return f"Insert tool {number} and click continue when ready\n\nError: {e}"


def run_without_display(exchange):
    from kerf import clock
    clock.join("hal_manualtoolchange", 500)
    while True:
        exchange.step()
        clock.sleep(POLL_S)


def run_with_display(exchange):
    import tkinter
    from tkinter import ttk
    root = tkinter.Tk(className="AXISManualToolchanger")
    root.title("AXIS Manual Toolchanger")
    root.geometry("-60-60")
    ttk.Label(root, text="This window watches for tool changes.\nIt hides by itself.", padding=20).pack()
    root.protocol("WM_DELETE_WINDOW", root.withdraw)
    root.after(WITHDRAW_MS, root.withdraw)
    dialog = None

    def close():
        nonlocal dialog
        if dialog:
            dialog.destroy()
            dialog = None

    def confirm(*_):
        exchange.confirm()
        close()

    def ask():
        nonlocal dialog
        close()
        dialog = tkinter.Toplevel(root)
        dialog.title(TITLE)
        dialog.attributes("-topmost", True)
        ttk.Label(dialog, text=request_text(exchange.pins["number"]), padding=20, justify="left").pack()
        button = ttk.Button(dialog, text="Continue", command=confirm)
        button.pack(padx=20, pady=(0, 20), ipadx=12, ipady=6)
        button.focus_set()
        dialog.bind("<Return>", confirm)
        dialog.protocol("WM_DELETE_WINDOW", lambda: None)

    def tick():
        action = exchange.step()
        if action == "ask":
            ask()
        elif action == "close":
            close()
        root.after(int(POLL_S * 1000), tick)
    tick()
    root.mainloop()


def main():
    exchange = Exchange(make_component())
    try:
        if os.environ.get("DISPLAY"):
            run_with_display(exchange)
        else:
            run_without_display(exchange)
    except KeyboardInterrupt:
        pass
    return 0


if __name__ == "__main__":
    sys.exit(main())
