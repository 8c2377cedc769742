# SPDX-License-Identifier: GPL-2.0-or-later
"""Asks the operator to change tools: HAL component hal_manualtoolchange.

Pins: number (s32 in), change, change_button (bit in), changed (bit out). A request is
confirmed with the window's button or with change_button. Without a display only the
pins exist: a push button on change_button then confirms.
"""

import os
import tkinter as tk
from tkinter import ttk

import hal

from .. import clock, tkstyle
from ..language import _, N_

POLL_S = 0.1
ANSWER_S = 0.0005       # between two looks whether the controller has seen the answer
WITHDRAW_S = 10.0
CLOCK_PRIORITY = 500
TITLE = N_("Tool change")
NAME = "hal_manualtoolchange"
ICON = "::tk::icons::information"


def make_component():
    component = hal.component(NAME)
    component.newpin("number", hal.HAL_S32, hal.HAL_IN)
    component.newpin("change", hal.HAL_BIT, hal.HAL_IN)
    component.newpin("change_button", hal.HAL_BIT, hal.HAL_IN)
    component.newpin("changed", hal.HAL_BIT, hal.HAL_OUT)
    component.ready()
    return component


class Exchange:
    """The handshake, without any window. step() is called every POLL_S seconds."""

    def __init__(self, component, sleep=clock.sleep):
        self.pins, self.sleep = component, sleep
        self.asking, self.number = False, None      # of the request that is shown

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
            if not self.asking or self.other_tool():
                self.asking, self.number = True, pins["number"]
                return "ask"
        return None

    def other_tool(self):
        """Another tool is wanted than the one that is shown."""
        return self.asking and self.pins["number"] != self.number

    def confirm(self):
        """The operator says that the tool is in place.

        The answer is taken back as soon as the controller has seen it: the next request may
        follow within milliseconds, and must not find it.
        """
        pins = self.pins
        self.asking = False
        if pins["change"]:
            pins["changed"] = True
            for _ in range(round(POLL_S / ANSWER_S)):
                self.sleep(ANSWER_S)
                if not pins["change"]:
                    pins["changed"] = False
                    break
        return "close"


def request_text(number):
    """What the operator reads. Tool data come from the status channel."""
    if number == 0:
        return _("Remove the tool and click continue when ready")
    try:
        import linuxcnc
        stat = linuxcnc.stat()
        stat.poll()
        tool = stat.toolinfo(number)
        units = linuxcnc.ini(os.environ["INI_FILE_NAME"]).find("TRAJ", "LINEAR_UNITS") or ""
        return _("Insert tool and click continue when ready.\n\nTool number: %d\nDiameter: %.4f%s\nComment: %s") % (
            number, tool["diameter"], units, tool["comment"])
    except Exception as e:      # the request must be shown, whatever is wrong with the data
        return _("Insert tool %d and click continue when ready\n\nError: %s") % (number, e)


class Window:
    """The small main window hides by itself; a request opens the dialog."""

    def __init__(self, root, exchange):
        self.root, self.exchange, self.shown_s = root, exchange, 0.0
        self.kept = self.dialog = None      # the dialog; the same while it is shown
        style = self.style = tkstyle.apply(root)
        root.title(_("AXIS Manual Toolchanger"))
        root.geometry("-60-60")
        ttk.Label(root, text=_("This window watches for tool changes.\nIt hides by itself."),
                  padding=style.px(20)).pack()
        root.protocol("WM_DELETE_WINDOW", root.withdraw)

    def tick(self):
        action = self.exchange.step()
        if action == "ask":
            self.ask()
        elif action == "close":
            self.close()
        self.shown_s += POLL_S
        if self.shown_s >= WITHDRAW_S and self.root.state() == "normal":
            self.root.withdraw()

    def make_dialog(self):
        """Made once: each window that comes and goes leaves memory in Tk, and tools are changed for months."""
        px = self.style.px
        dialog = tk.Toplevel(self.root, class_="Dialog")
        dialog.withdraw()
        dialog.title(_(TITLE))
        dialog.attributes("-topmost", True)
        box = ttk.Frame(dialog, padding=px(20))
        box.pack(fill="both", expand=True)
        try:
            ttk.Label(box, image=ICON).grid(row=0, column=0, sticky="n", padx=(0, px(16)))
        except tk.TclError:         # a Tk without icons
            pass
        self.text = ttk.Label(box, justify="left", wraplength=px(480))
        self.text.grid(row=0, column=1, sticky="w")
        self.button = ttk.Button(box, text=_("Continue"), command=self.confirm)
        self.button.grid(row=1, column=0, columnspan=2, pady=(px(20), 0), ipadx=px(12), ipady=px(8))
        dialog.bind("<Return>", lambda event: self.confirm())
        dialog.bind("<KP_Enter>", lambda event: self.confirm())
        dialog.protocol("WM_DELETE_WINDOW", lambda: None)
        return dialog

    def ask(self):
        self.close()
        self.kept = self.kept or self.make_dialog()
        dialog = self.dialog = self.kept
        self.text["text"] = request_text(self.exchange.pins["number"])
        self.button.focus_set()
        dialog.update_idletasks()
        width, height = dialog.winfo_reqwidth(), dialog.winfo_reqheight()
        dialog.geometry(f"+{(dialog.winfo_screenwidth() - width) // 2}+{(dialog.winfo_screenheight() - height) // 2}")
        dialog.deiconify()
        dialog.lift()

    def close(self):
        if self.dialog:
            self.dialog.withdraw()
            self.dialog = None

    def confirm(self):
        if self.exchange.other_tool():
            return          # the next step shows it
        self.exchange.confirm()
        self.close()

    def run(self):
        """Until the program is ended; in virtual time at its pace."""
        if clock.is_virtual():
            while True:
                self.tick()
                self.root.update()
                clock.sleep(POLL_S)

        def again():
            self.tick()
            self.root.after(int(POLL_S * 1000), again)
        again()
        self.root.mainloop()


def main(_arguments):
    exchange = Exchange(make_component())
    clock.join(NAME, CLOCK_PRIORITY)
    try:
        if os.environ.get("DISPLAY"):
            Window(tkstyle.open_display(NAME, "AxisToolChanger"), exchange).run()
            return 0
        while True:
            exchange.step()
            clock.sleep(POLL_S)
    except (KeyboardInterrupt, tk.TclError) as end:
        if isinstance(end, tk.TclError) and "application has been destroyed" not in str(end):
            raise
    return 0
