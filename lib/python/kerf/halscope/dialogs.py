# SPDX-License-Identifier: GPL-2.0-or-later
"""Dialogs of the oscilloscope: thread and rate, offset."""

import tkinter as tk
from tkinter import messagebox, ttk

from ..language import _
from ..numbertext import plain, with_point
from . import acquire, settings as st
from .geometry import engineering

NOT_LINKED = _("Realtime function not linked")
RATE = _("Select Sample Rate")


class RateDialog(tk.Toplevel):
    """Which thread samples, how often, how many samples. done(thread, mult, samples) on OK; quit_() on Quit."""

    def __init__(self, master, settings, samples, first, done, quit_):
        super().__init__(master)
        self.title(NOT_LINKED if first else RATE)
        self.transient(master)
        self._done, self._quit, self._first = done, quit_, first
        self._threads = acquire.threads()
        body = ttk.Frame(self, padding=10)
        body.pack(fill="both", expand=True)
        text = (_("The realtime sampling function is in no thread. Choose the thread, the rate\n"
                  "and the number of samples, then OK.")
                if first else _("Choose the thread, the rate and the number of samples."))
        ttk.Label(body, text=text).grid(columnspan=3, sticky="w", pady=(0, 8))
        ttk.Label(body, text=_("Thread:")).grid(row=1, column=0, sticky="nw")
        self.list = tk.Listbox(body, height=max(3, min(6, len(self._threads))), width=40, exportselection=False,
                               activestyle="none")
        for name, period in self._threads:
            self.list.insert("end", f"{name}  ({engineering(period * 1e-9, 's')})")
        self.list.grid(row=1, column=1, columnspan=2, sticky="ew")
        self.list.bind("<<ListboxSelect>>", lambda _e: self._show())
        self.mult, self.samples = tk.StringVar(value=str(settings.mult)), tk.StringVar(value=str(samples))
        self.period_text, self.rate_text = tk.StringVar(), tk.StringVar()
        rows = ((_("Sample Period:"), self.period_text, None), (_("Sample Rate:"), self.rate_text, None),
                (_("Multiplier:"), self.mult, (1, st.MAX_MULT, 1)),
                (_("Samples:"), self.samples, (st.MIN_SAMPLES, st.MAX_SAMPLES, 1000)))
        for row, (title, variable, limits) in enumerate(rows, 2):
            ttk.Label(body, text=title).grid(row=row, column=0, sticky="w", pady=2, padx=(0, 6))
            if limits:
                w = ttk.Spinbox(body, textvariable=variable, from_=limits[0], to=limits[1],
                                increment=limits[2], width=12)
                variable.trace_add("write", lambda *_: self._show())
            else:
                w = ttk.Label(body, textvariable=variable, font="TkFixedFont")
            w.grid(row=row, column=1, sticky="w", pady=2)
        frame = ttk.Labelframe(body, text=_("Record length"), padding=6)
        frame.grid(row=6, columnspan=3, sticky="ew", pady=(8, 0))
        self.lengths = []
        for n in (1, 2, 4, 8, 16):
            label = ttk.Label(frame, font="TkFixedFont")
            label.grid(sticky="w")
            self.lengths.append((n, label))
        buttons = ttk.Frame(self, padding=10)
        buttons.pack(fill="x")
        ttk.Button(buttons, text="OK", command=self.accept).pack(side="right")
        ttk.Button(buttons, text=_("Quit") if first else _("Cancel"), command=self.refuse).pack(side="right", padx=6)
        self.protocol("WM_DELETE_WINDOW", self.refuse)
        self.bind("<Return>", lambda _e: self.accept())
        self.bind("<Escape>", lambda _e: self.refuse())
        names = [name for name, _ in self._threads]
        wanted = settings.thread if settings.thread in names else names[-1] if names else None
        if wanted:
            self.list.selection_set(names.index(wanted))
        self._show()

    def _values(self):
        """(thread, its period, mult, samples); None for what is not a usable number."""
        marked = self.list.curselection()
        name, period = self._threads[marked[0]] if marked else (None, 0)
        mult = int(self.mult.get()) if self.mult.get().isdigit() and 1 <= int(self.mult.get()) <= st.MAX_MULT else None
        samples = st.clamp_samples(int(self.samples.get())) if self.samples.get().isdigit() else None
        if mult and period * mult > 1e9:
            mult = None
        return name, period, mult, samples

    def _show(self):
        name, period, mult, samples = self._values()
        seconds = period * mult * 1e-9 if name and mult else 0
        self.period_text.set(engineering(seconds, "s") if seconds else "----")
        self.rate_text.set(engineering(1 / seconds, "Hz") if seconds else "----")
        for n, label in self.lengths:
            each = (samples or 0) // n
            label.configure(text=_("channels: %2d, samples each: %8d") % (n, each)
                            + (f", {engineering(each * seconds, 's')}" if seconds else ""))

    def accept(self):
        name, _period, mult, samples = self._values()
        if not name:
            messagebox.showerror(self.title(),
                                 _("Choose a thread.") if self._threads else _("There are no realtime threads."),
                                 parent=self)
        elif not mult:
            messagebox.showerror(self.title(),
                                 _("The multiplier must be 1 to %s, the sample period at most 1 s.") % st.MAX_MULT,
                                 parent=self)
        elif not samples:
            messagebox.showerror(self.title(), _("Samples must be %s to %s.") % (st.MIN_SAMPLES, st.MAX_SAMPLES),
                                 parent=self)
        else:
            self.destroy()
            self._done(name, mult, samples)

    def refuse(self):
        self.destroy()
        if self._first:
            self._quit()


class OffsetDialog(tk.Toplevel):
    """Value at the baseline, and AC coupling. done(offset, ac)."""

    def __init__(self, master, number, channel, done):
        super().__init__(master)
        self.title(_("Channel %s Offset") % number)
        self.transient(master)
        self._done = done
        self.offset, self.ac = tk.StringVar(value=f"{channel.voff:g}"), tk.BooleanVar(value=channel.ac)
        body = ttk.Frame(self, padding=10)
        body.pack(fill="both", expand=True)
        ttk.Label(body, text=_("Vertical offset of %s:") % channel.name).grid(columnspan=2, sticky="w")
        entry = ttk.Entry(body, textvariable=self.offset)
        entry.grid(columnspan=2, sticky="ew", pady=6)
        ttk.Checkbutton(body, text=_("AC Coupled"), variable=self.ac).grid(columnspan=2, sticky="w")
        buttons = ttk.Frame(self, padding=10)
        buttons.pack(fill="x")
        ttk.Button(buttons, text="OK", command=self.accept).pack(side="right")
        ttk.Button(buttons, text=_("Cancel"), command=self.destroy).pack(side="right", padx=6)
        self.bind("<Return>", lambda _e: self.accept())
        self.bind("<Escape>", lambda _e: self.destroy())
        entry.focus_set()
        entry.selection_range(0, "end")

    def accept(self):
        try:
            value = float(with_point(plain(self.offset.get())))
            if value != value or value in (float("inf"), float("-inf")):
                raise ValueError
        except ValueError:
            messagebox.showerror(self.title(), _("'%s' is not a number.") % self.offset.get(), parent=self)
            return
        self.destroy()
        self._done(value, self.ac.get())
