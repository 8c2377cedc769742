# SPDX-License-Identifier: GPL-2.0-or-later
"""The groups of controls around the picture. Each has show(), which follows the settings."""

import tkinter as tk
from tkinter import ttk

from ..language import _
from . import geometry as geo, settings as st
from .display import COLOURS, TRIGGER


class _Group(ttk.Labelframe):
    def __init__(self, master, title, owner, style):
        super().__init__(master, text=title, padding=style.px(5))
        self.owner, self.style, self._showing = owner, style, False

    def slider(self, low, high, act, **options):
        """A slider that calls act(value) only when the user moves it."""
        return ttk.Scale(self, from_=low, to=high, command=lambda v: None if self._showing else act(float(v)),
                         **options)

    def show(self):
        self._showing = True
        self.follow()
        self._showing = False


class Horizontal(_Group):
    def __init__(self, master, owner, style):
        super().__init__(master, _("Horizontal"), owner, style)
        ttk.Label(self, text=_("Zoom")).grid(row=0, column=0, sticky="w")
        self.zoom = self.slider(1, st.MAX_ZOOM, self._set_zoom)
        self.zoom.grid(row=0, column=1, sticky="ew", padx=6)
        ttk.Label(self, text=_("Pos")).grid(row=1, column=0, sticky="w")
        self.pos = self.slider(0, 1, self._set_pos)
        self.pos.grid(row=1, column=1, sticky="ew", padx=6)
        self.per_div = ttk.Label(self, width=16, anchor="center")
        self.per_div.grid(row=0, column=2)
        self.rate = ttk.Button(self, command=owner.ask_rate)
        self.rate.grid(row=0, column=3, rowspan=2, padx=(6, 0))
        self.bar = tk.Canvas(self, height=style.px(14), highlightthickness=0, width=style.px(150))
        self.bar.grid(row=1, column=2, sticky="ew")
        self.columnconfigure(1, weight=1)
        self.bar.bind("<Configure>", lambda _e: self.progress())

    def _set_zoom(self, value):
        self.owner.settings.zoom = round(value)
        self.owner.changed()

    def _set_pos(self, value):
        self.owner.settings.pos = value
        self.owner.changed()

    def follow(self):
        s = self.owner.settings
        self.zoom.set(s.zoom)
        self.pos.set(s.pos)
        period, length, _trigger = self.owner.frame()
        self.per_div.configure(text=_("%s per div") % geo.engineering(self.owner.display.horizontal().per_div, 's')
                               if period else "----")
        self.rate.configure(text=_("%s samples\nat %s")
                            % (length, geo.engineering(1e9 / period, 'Hz') if period else '----'))
        self.progress()

    def progress(self):
        """How full the buffer is, which part of it is shown, where the trigger is."""
        width, height, c = self.bar.winfo_width(), self.bar.winfo_height(), self.style.colours
        self.bar.delete("all")
        self.bar.create_rectangle(0, 0, width - 1, height - 1, outline=c["line"], fill=c["field"])
        share = self.owner.progress()[1]
        self.bar.create_rectangle(1, 1, 1 + share * (width - 2), height - 1, width=0, fill=c["select"], tags="filled")
        h, (_period, length, trigger) = self.owner.display.horizontal(), self.owner.frame()
        left, right = ((h.start + k * h.step * self.owner.display.size[0]) / max(1, length) * width for k in (0, 1))
        self.bar.create_rectangle(max(0, left), 0, min(width - 1, right), height - 1, outline=c["ink"])
        x = trigger / max(1, length) * width
        self.bar.create_line(x, 0, x, height, fill=TRIGGER, width=2, tags="mark")


class RunMode(_Group):
    def __init__(self, master, owner, style):
        super().__init__(master, _("Run Mode"), owner, style)
        self.mode = tk.IntVar(value=st.STOP)
        self.buttons = []
        for n, word in enumerate((_("Stop"), _("Normal"), _("Single"), _("Roll"))):
            b = ttk.Radiobutton(self, text=word, value=n, variable=self.mode, command=lambda n=n: owner.set_run_mode(n))
            b.grid(row=n // 2, column=n % 2, sticky="w")
            self.buttons.append(b)
        self.columnconfigure((0, 1), weight=1)

    def follow(self):
        self.mode.set(self.owner.settings.run_mode)


class Trigger(_Group):
    def __init__(self, master, owner, style):
        super().__init__(master, _("Trigger"), owner, style)
        for column, (word, name) in enumerate(((_("Level"), "level"), (_("Pos"), "pos"))):
            ttk.Label(self, text=word).grid(row=0, column=column, padx=style.px(3))
            scale = self.slider(0, 1, lambda v, name=name: self._set(name, v), orient="vertical", length=style.px(110))
            scale.grid(row=1, column=column, rowspan=5, sticky="ns", padx=style.px(5))
            setattr(self, name, scale)
        self.source = ttk.Button(self, text=_("Source"), command=owner.ask_trigger_source)
        self.mode = ttk.Button(self, command=self._toggle_mode)
        self.edge = ttk.Button(self, command=owner.toggle_edge)
        self.force = ttk.Button(self, text=_("Force"), command=owner.force)
        for row, b in enumerate((self.source, self.mode, self.edge, self.force), 1):
            b.grid(row=row, column=2, sticky="ew", padx=(6, 0), pady=1)
        self.text = ttk.Label(self, anchor="w", width=26)
        self.text.grid(row=6, columnspan=3, sticky="ew", pady=(4, 0))
        self.columnconfigure(2, weight=1)
        self.rowconfigure(5, weight=1)

    def _set(self, name, value):
        setattr(self.owner.settings.trigger, name, geo.snap(value))
        if name == "pos":
            self.owner.restart()
        self.owner.retrigger()

    def _toggle_mode(self):
        self.owner.settings.trigger.auto = not self.owner.settings.trigger.auto
        self.owner.retrigger()

    def follow(self):
        s = self.owner.settings
        t = s.trigger
        self.level.set(t.level)
        self.pos.set(t.pos)
        self.source.configure(text=_("Source: %s") % t.source if t.source else _("Source: none"))
        self.mode.configure(text=_("Auto") if t.auto else _("Normal"))
        self.edge.configure(text=_("Rising") if t.rising else _("Falling"))
        self.text.configure(text=_("Level %.6g") % st.trigger_level(s.channel(t.source), t.level) if t.source
                            else _("No trigger source"))


class Vertical(_Group):
    def __init__(self, master, owner, style):
        super().__init__(master, _("Vertical"), owner, style)
        ttk.Label(self, text=_("Gain")).grid(row=0, column=0, padx=style.px(3))
        ttk.Label(self, text=_("Pos")).grid(row=0, column=1, padx=style.px(3))
        self.gain = self.slider(0, 1, self._set_gain, orient="vertical", length=style.px(110))
        self.gain.grid(row=1, column=0, rowspan=4, sticky="ns", padx=style.px(5))
        self.pos = self.slider(0, 1, self._set_pos, orient="vertical", length=style.px(110))
        self.pos.grid(row=1, column=1, rowspan=4, sticky="ns", padx=style.px(5))
        self.scale = ttk.Label(self, anchor="center", width=14)
        self.scale.grid(row=1, column=2, sticky="ew", padx=(6, 0))
        self.offset = ttk.Button(self, command=owner.ask_offset)
        self.offset.grid(row=2, column=2, sticky="ew", padx=(6, 0))
        self.ac = tk.BooleanVar()
        self.coupled = ttk.Checkbutton(self, text=_("AC Coupled"), variable=self.ac, command=self._set_ac)
        self.coupled.grid(row=3, column=2, sticky="w", padx=(6, 0))
        self.columnconfigure(2, weight=1)
        self.rowconfigure(4, weight=1)

    def _set_gain(self, value):
        channel = self.owner.selected_channel()
        if channel:
            channel.vscale = round(value)
            self.owner.changed()

    def _set_pos(self, value):
        channel = self.owner.selected_channel()
        if channel:
            channel.vpos = geo.snap(value)
            self.owner.changed()

    def _set_ac(self):
        channel = self.owner.selected_channel()
        if channel:
            channel.ac = self.ac.get()
            self.owner.changed()

    def follow(self):
        channel = self.owner.selected_channel()
        for w in (self.gain, self.pos, self.offset, self.coupled):
            w.state(["!disabled" if channel else "disabled"])
        if not channel:
            self.scale.configure(text="----")
            self.offset.configure(text=_("Offset"))
            self.ac.set(False)
            return
        low, high = channel.limits()
        self.gain.configure(from_=low, to=high)
        self.gain.set(channel.vscale)
        self.pos.set(channel.vpos)
        self.scale.configure(text=_("%g / div") % st.scale(channel.vscale))
        self.offset.configure(text=_("Offset %.6g") % channel.voff)
        self.ac.set(channel.ac)


class Channels(ttk.Frame):
    """Buttons 1 to 16; the selected one has a border, enabled ones their colour."""

    def __init__(self, master, owner, style):
        super().__init__(master, padding=(0, style.px(4)))
        self.owner, self.style = owner, style
        ttk.Label(self, text=_("Selected Channel")).pack(side="left")
        self.name = ttk.Label(self, width=34, anchor="w", cursor="hand2", font="TkFixedFont")
        self.name.pack(side="left", padx=style.px(8), fill="x", expand=True)
        self.buttons = []
        for n in range(1, st.CHANNELS + 1):
            b = tk.Button(self, text=str(n), width=2, padx=style.px(2), pady=style.roomy(2, 6), borderwidth=0,
                          highlightthickness=style.px(2), command=lambda n=n: owner.channel_button(n))
            b.pack(side="left", padx=1)
            self.buttons.append(b)

    def show(self):
        s, c = self.owner.settings, self.style.colours
        for n, b in enumerate(self.buttons, 1):
            on = s.channel(n).enabled
            colour = COLOURS[n - 1] if on else c["face"]
            b.configure(background=colour, activebackground=colour, foreground="#101010" if on else c["faint"],
                        highlightbackground=c["ink"] if n == s.selected else c["line"], highlightcolor=c["ink"])
        channel = self.owner.selected_channel()
        gone = s.selected in self.owner.missing
        self.name.configure(text=_("%s: not in HAL") % channel.name if gone else channel.name if channel else "----",
                            style="Bad.TLabel" if gone else "TLabel")
