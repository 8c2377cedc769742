# SPDX-License-Identifier: GPL-2.0-or-later
"""Buttons and texts: button, checkbutton, radiobutton, label, multilabel."""

import tkinter as tk

import hal
from kerf import tkstyle

from .base import Follower, brightness, known_options

MAX_LEGENDS, ICON_PX = 6, 24
WHEEL = 4, 5, 6, 7          # of X11: no buttons that a hand presses


def give_mark(button, kind, options):
    """A mark that grows with the screen: Tk's own has the same few pixels everywhere. kind: radio or check."""
    style = tkstyle.style_of(button)
    if style.scale > 1 and not {"indicatoron", "image", "selectimage"} & options.keys():
        from axis.icons import Icons
        icons = button.icons = Icons(button, style.px(ICON_PX), brightness(button, button["background"]) < 0.5)
        button.configure(indicatoron=0, image=icons.get(f"{kind}_off"), selectimage=icons.get(f"{kind}_on"),
                         compound="left", padx=style.px(4), borderwidth=0, relief="flat", offrelief="flat",
                         overrelief="flat", selectcolor=button["background"])


class Disabling:
    """A widget that a pin NAME.disable greys out, if disable_pin."""

    def make_disable(self, panel, name, wanted):
        self.disable = Follower(panel.new(name + ".disable", hal.HAL_BIT, hal.HAL_IN)) if wanted else None

    def follow_disable(self):
        if self.disable is not None and (off := self.disable.changed()) is not None:
            self.configure(state="disabled" if off else "normal")


class Button(tk.Button, Disabling):
    """TRUE while a mouse button is down on it."""

    def __init__(self, master, panel, halpin=None, disable_pin=False, **options):
        super().__init__(master, **options)
        name = panel.default(halpin, "button")
        self.pin = panel.new(name, hal.HAL_BIT, hal.HAL_OUT)
        self.make_disable(panel, name, disable_pin)
        self.bind("<ButtonPress>", lambda e: e.num in WHEEL or self.press(True), "+")
        self.bind("<ButtonRelease>", lambda _: self.press(False), "+")
        self.bind("<KeyPress-space>", lambda _: self.press(True), "+")
        self.bind("<KeyRelease-space>", lambda _: self.press(False), "+")
        # a press does not outlive the widget or its focus
        self.bind("<Unmap>", lambda _: self.press(False), "+")

    def press(self, down):
        self.pin.set(down and str(self["state"]) != "disabled")

    def follow(self):
        self.follow_disable()
        if self.disable is not None and self.disable.seen:
            self.pin.set(False)


class Checkbutton(tk.Checkbutton):
    """A rising changepin toggles it."""

    def __init__(self, master, panel, halpin=None, initval=0, **options):
        self.state = tk.BooleanVar(master, value=float(initval) >= 0.5)
        super().__init__(master, variable=self.state, **options)
        number = panel.count("checkbutton")
        name = halpin or f"checkbutton.{number}"
        self.pin = panel.new(name, hal.HAL_BIT, hal.HAL_OUT)
        self.change = panel.new(name + ".changepin", hal.HAL_BIT, hal.HAL_IN)
        self.asked = False
        self.pin.set(self.state.get())
        give_mark(self, "check", options)

    def follow(self):
        asked = self.change.get()
        if asked and not self.asked:
            self.state.set(not self.state.get())
            self.change.set(False)
        self.asked = asked
        self.pin.set(self.state.get())


class Radiobutton(tk.Frame):
    """One pin for each choice; one of them is TRUE."""

    def __init__(self, master, panel, halpin=None, choices=(), initval=0, orient=None, **options):
        super().__init__(master, bd=2, relief="groove")
        if not choices:
            raise ValueError("choices = [...] is needed")
        name = panel.default(halpin, "radiobutton")
        self.choice = tk.IntVar(self, value=int(initval))
        self.pins = [panel.new(f"{name}.{choice}", hal.HAL_BIT, hal.HAL_OUT) for choice in choices]
        self.buttons = [tk.Radiobutton(self, text=str(choice), variable=self.choice, value=n, anchor="w")
                        for n, choice in enumerate(choices)]
        known, self.unknown = known_options(options, set(self.buttons[0].keys()) - {"text", "variable", "value"})
        for button in self.buttons:
            button.configure(**known)
            give_mark(button, "radio", known)
            button.pack(side="left" if orient else "top", fill="x")
        self.follow()

    def follow(self):
        for n, pin in enumerate(self.pins):
            pin.set(n == self.choice.get())


class Label(tk.Label, Disabling):
    def __init__(self, master, panel, halpin=None, disable_pin=False, **options):
        super().__init__(master, **options)
        self.make_disable(panel, panel.default(halpin, "label") if disable_pin else "", disable_pin)

    def follow(self):
        self.follow_disable()


class Multilabel(tk.Label, Disabling):
    """Shows the legend whose pin went TRUE; the other pins are set FALSE."""

    def __init__(self, master, panel, halpin=None, legends=(), initval=0, disable_pin=False, **options):
        super().__init__(master, **options)
        if not legends:
            raise ValueError("legends = [...] is needed")
        legends = self.legends = legends[:MAX_LEGENDS]
        name = panel.default(halpin, "multilabel")
        self.pins = [panel.new(f"{name}.legend{n}", hal.HAL_BIT, hal.HAL_IN) for n in range(len(legends))]
        self.make_disable(panel, name, disable_pin)
        self.show(min(max(int(initval), 0), len(legends) - 1))

    def show(self, number):
        self.now = number
        self.configure(text=self.legends[number])
        for n, pin in enumerate(self.pins):
            pin.set(n == number)

    def follow(self):
        self.follow_disable()
        for n, pin in enumerate(self.pins):
            if pin.get() and n != self.now:
                self.show(n)
                return
