# SPDX-License-Identifier: GPL-2.0-or-later
"""The window of the oscilloscope."""

import sys
import tkinter as tk
from array import array
from pathlib import Path
from tkinter import filedialog, messagebox, ttk

import kerf_scope as rt

from .. import tkstyle
from ..language import _, N_
from . import acquire, configfile, csvlog, dialogs, panels, settings as st
from .display import Display
from .picker import SourcePicker

POLL_MS = 50
LINK_MS = 1000
SIZE, MINIMUM = (1000, 660), (760, 520)
STATES = {rt.IDLE: "", rt.INIT: N_("WAITING FOR THREAD"), rt.PRE_TRIG: N_("PRE-TRIG"),
          rt.TRIG_WAIT: N_("WAITING FOR TRIGGER"), rt.POST_TRIG: N_("TRIGGERED"), rt.DONE: N_("DONE"), rt.RESET: "",
          rt.ROLL: N_("ROLL")}
CONFIG_TYPES = ((_("Configurations"), "*.halscope"), (_("All files"), "*"))
LOG_TYPES = ((_("Log files"), "*.csv"), (_("All files"), "*"))


class Screen:
    """acq: acquire.Acquisition or Offline. The panels and the display call what is public here."""

    def __init__(self, root, settings, acq, style):
        self.root, self.settings, self.acq, self.style = root, settings, acq, style
        self.record, self.log = None, None          # what is shown; the file that it came from
        self.picker = self.dialog = None
        self.missing = set()                        # channels whose source has gone
        root.title("HAL Oscilloscope")
        tkstyle.centre(root, style.px(SIZE[0]), style.px(SIZE[1]), (style.px(MINIMUM[0]), style.px(MINIMUM[1])))
        self._menus()
        body = ttk.Frame(root, padding=style.px(6))
        body.pack(fill="both", expand=True)
        self.display = Display(body, self, style)
        self.horizontal = panels.Horizontal(body, self, style)
        right = ttk.Frame(body)
        self.run_mode, self.trigger, self.vertical = (kind(right, self, style)
                                                      for kind in (panels.RunMode, panels.Trigger, panels.Vertical))
        self.channels = panels.Channels(body, self, style)
        self.channels.name.bind("<Button-1>",
                                lambda _e: self.settings.selected and self.ask_source(self.settings.selected))
        self.horizontal.grid(row=0, column=0, columnspan=2, sticky="ew")
        self.display.grid(row=1, column=0, sticky="nsew", pady=style.px(6))
        right.grid(row=1, column=1, sticky="ns", padx=(style.px(6), 0))
        for group in (self.run_mode, self.trigger, self.vertical):
            group.pack(fill="both", expand=group is not self.run_mode, pady=(style.px(4), 0))
        self.channels.grid(row=2, column=0, columnspan=2, sticky="ew")
        body.rowconfigure(1, weight=1)
        body.columnconfigure(0, weight=1)
        root.protocol("WM_DELETE_WINDOW", self.quit)
        root.bind("<Control-q>", lambda _e: self.quit())
        self.period = acq.period(settings.mult)
        self.changed()
        root.after(POLL_MS, self._poll)
        root.after(LINK_MS, self._watch_link)

    def _menus(self):
        bar = tk.Menu(self.root)
        files, help_ = tk.Menu(bar, tearoff=False), tk.Menu(bar, tearoff=False)
        for label, act in ((_("Open Configuration..."), self.open_configuration),
                           (_("Save Configuration..."), self.save_configuration), (None, None),
                           (_("Open Log File"), self.open_log), (_("Save Log File"), self.save_log), (None, None),
                           (_("Quit"), self.quit)):
            if label:
                files.add_command(label=label, command=act, accelerator="Ctrl-Q" if act == self.quit else "")
            else:
                files.add_separator()
        help_.add_command(label=_("About Halscope"), command=lambda: messagebox.showinfo(
            _("About Halscope"), _("HAL Oscilloscope\n\nShows pins, signals and parameters of a running HAL over time."), parent=self.root))
        bar.add_cascade(label=_("File"), menu=files)
        bar.add_cascade(label=_("Help"), menu=help_)
        self.root.configure(menu=bar)

    # ---- What the display and the panels ask

    def frame(self):
        """Of the record shown, or of the next one: ns between samples, samples, number of the trigger's sample."""
        if self.record is not None:
            return self.record.period, self.record.length, self.record.trigger
        length = self.acq.length(self.settings)
        return self.period, length, min(int(self.settings.trigger.pos * length), length - 1)

    def shown(self):
        return self.settings.shown()

    def state_text(self):
        if self.log:
            return _("LOG %s") % self.log
        if self.settings.run_mode != st.STOP and not self.period:
            return _("IN NO THREAD")
        text = STATES[self.acq.progress()[0]] if self.settings.run_mode != st.STOP else ""
        return _(text) if text else ""

    def progress(self):
        return self.acq.progress()

    def selected_channel(self):
        return self.settings.channel(self.settings.selected) if self.settings.selected else None

    def changed(self):
        """Something of the settings changed that needs no new record."""
        for panel in (self.horizontal, self.run_mode, self.trigger, self.vertical, self.channels):
            panel.show()
        self.display.later()

    def retrigger(self):
        self.acq.retrigger(self.settings)
        self.changed()

    def toggle_edge(self):
        self.settings.trigger.rising = not self.settings.trigger.rising
        self.retrigger()

    def force(self):
        self.acq.force()

    def select(self, number):
        self.settings.selected = number
        self.changed()

    # ---- Acquisition

    def set_run_mode(self, mode):
        """Stop, Normal, Single or Roll; says what is missing and stays stopped."""
        s = self.settings
        s.run_mode = st.STOP
        self.acq.stop()
        if mode != st.STOP and not s.enabled():
            messagebox.showerror(_("No channels selected"), _("You need to choose at least one channel."),
                                 parent=self.root)
        elif mode != st.STOP and self._may_overwrite():
            s.run_mode = mode
            try:
                self.acq.start(s)
            except acquire.ScopeError as e:
                s.run_mode = st.STOP
                messagebox.showerror("halscope", str(e), parent=self.root)
        self.changed()

    def _may_overwrite(self):
        """Asks before the record of a log file is lost."""
        if self.log is None:
            return True
        if not messagebox.askyesno("halscope", _("Overwrite loaded log file data?"), parent=self.root):
            return False
        self.log = self.record = None
        self.settings.forget_log()
        return True

    def restart(self):
        """Sources or rate changed: what is being recorded is no use."""
        if self.settings.run_mode != st.STOP:
            self.set_run_mode(self.settings.run_mode if self.settings.enabled() else st.STOP)
        else:
            self.changed()

    def _poll(self):
        try:
            self._fetch()
        finally:
            self.root.after(POLL_MS, self._poll)

    def _fetch(self):
        mode = self.settings.run_mode
        if mode == st.STOP:
            return
        record, missing = self.acq.poll(), self.missing
        self.missing = set(self.acq.missing)
        if self.missing != missing:
            self.channels.show()
        self.horizontal.progress()
        if record is None:
            self._show_state()
            return
        first, self.record = self.record is None, record
        if mode == st.SINGLE:
            self.settings.run_mode = st.STOP
            self.acq.stop()
            self.changed()
        elif mode == st.NORMAL:
            self.acq.start(self.settings)
        if first:
            self.changed()
        self.display.later()

    def _show_state(self):
        text = self.state_text()
        if self.display.find_withtag("state"):
            self.display.itemconfigure("state", text=text)
        elif text:
            self.display.later()

    def _watch_link(self):
        """The function may be taken out of its thread at any time."""
        try:
            period = self.acq.period(self.settings.mult)
            if period != self.period:
                self.period = period
                self.changed()
        finally:
            self.root.after(LINK_MS, self._watch_link)

    # ---- Sources

    def channel_button(self, number):
        """The selected channel goes off, another one is selected; one without source gets one."""
        channel = self.settings.channel(number)
        if channel.enabled and self.settings.selected == number:
            channel.enabled = False
            self.settings.selected = 0
            if self.settings.trigger.source == number:
                self.settings.trigger.source = 0
            self.restart()
        elif channel.enabled:
            self.select(number)
        elif channel.kind in st.KINDS and acquire.source_type(channel.kind, channel.name):
            self.set_source(number, channel.kind, channel.name)
        else:
            self.ask_source(number)

    def ask_source(self, number):
        self.picker = SourcePicker(self.root, number, self.settings.channel(number),
                                   lambda kind, name: self.set_source(number, kind, name))

    def set_source(self, number, kind, name):
        found = acquire.source_type(kind, name)
        if not found:
            messagebox.showerror("halscope", _("There is no %s any more.") % name, parent=self.root)
            return
        channel = self.settings.channel(number)
        if (channel.kind, channel.name) != (kind, name):
            channel.voff, channel.ac = 0.0, False
        channel.kind, channel.name, channel.type, channel.enabled = kind, name, found, True
        low, high = channel.limits()
        channel.vscale = min(max(channel.vscale, low), high)
        self.settings.selected = number
        if self.record is not None and self.log is None:
            self.record.values.pop(number, None)
        self.restart()

    def ask_trigger_source(self):
        """A menu of the channels that can trigger."""
        menu = tk.Menu(self.root, tearoff=False)
        menu.add_command(label=_("none"), command=lambda: self.set_trigger_source(0))
        for n in self.settings.enabled():
            menu.add_command(label=f"{n}: {self.settings.channel(n).name}",
                             command=lambda n=n: self.set_trigger_source(n))
        button = self.trigger.source
        menu.tk_popup(button.winfo_rootx(), button.winfo_rooty() + button.winfo_height())

    def set_trigger_source(self, number):
        self.settings.trigger.source = number
        self.retrigger()

    def ask_offset(self):
        channel = self.selected_channel()
        if channel:
            def done(value, ac):
                channel.voff, channel.ac = value, ac
                self.retrigger()
            self.dialog = dialogs.OffsetDialog(self.root, self.settings.selected, channel, done)

    # ---- Rate

    def ask_rate(self, first=False):
        self.dialog = dialogs.RateDialog(self.root, self.settings, self.acq.samples, first, self.set_rate, self.quit)

    def set_rate(self, thread, mult, samples):
        s = self.settings
        try:
            self.acq.link(thread)
        except acquire.ScopeError as e:
            messagebox.showerror("halscope", str(e), parent=self.root)
            return
        s.thread, s.mult = thread, mult
        self.period = self.acq.period(mult)
        if samples != self.acq.samples:
            s.samples = samples
            messagebox.showinfo(_("Sample Count Changed - Restart Required"),
                                _("The number of samples is saved with the configuration.\n"
                                  "It is used when the scope is loaded again:\n"
                                "close halscope, halcmd unloadrt scope_rt, start halscope."), parent=self.root)
        if self.log is None:
            self.record = None
        self.restart()

    # ---- Files

    def _complain(self, what, error):
        messagebox.showerror("halscope", f"{what}: {getattr(error, 'strerror', None) or error}", parent=self.root)

    def open_configuration(self):
        path = filedialog.askopenfilename(parent=self.root, title=_("Open Configuration"), filetypes=CONFIG_TYPES)
        if path:
            self.load_configuration(path)

    def load_configuration(self, path):
        fresh = st.Settings()
        try:
            report(path, configfile.load(path, fresh, acquire.source_type))
        except OSError as e:
            self._complain(path, e)
            return
        self.acq.stop()
        mode, fresh.run_mode = fresh.run_mode, st.STOP
        self.settings, self.record, self.log = fresh, None, None
        if fresh.thread:
            try:
                self.acq.link(fresh.thread)
            except acquire.ScopeError as e:
                self._complain(fresh.thread, e)
        self.period = self.acq.period(fresh.mult)
        if mode != st.STOP and fresh.enabled():
            self.set_run_mode(mode)
        self.changed()

    def save_configuration(self):
        path = filedialog.asksaveasfilename(parent=self.root, title=_("Save Configuration"), filetypes=CONFIG_TYPES,
                                            defaultextension=".halscope")
        if path:
            try:
                configfile.save(path, self.settings)
            except OSError as e:
                self._complain(path, e)

    def open_log(self):
        path = filedialog.askopenfilename(parent=self.root, title=_("Open Log File"), filetypes=LOG_TYPES)
        if path:
            self.load_log(path)

    def load_log(self, path):
        try:
            log = csvlog.load(path)
        except (OSError, csvlog.LogError) as e:
            self._complain(path, e)
            return
        self.set_run_mode(st.STOP)
        s = self.settings
        s.channels, s.selected, s.trigger.source = [st.Channel() for _ in range(st.CHANNELS)], 0, 0
        for n, (name, position, scale) in enumerate(zip(log.names, log.positions, log.scales), 1):
            c = s.channel(n)
            c.kind, c.name, c.type, c.enabled = st.CSV, f"[CSV] {name}", st.FLOAT, True
            for kind in st.KINDS:
                found = acquire.source_type(kind, name)
                if found:
                    c.kind, c.name, c.type = kind, name, found
                    break
            low, high = c.limits()
            c.vscale = min(max(scale or 0, low), high)
            c.vpos = min(max(position if position is not None else 0.5, 0.0), 1.0)
        values = dict(enumerate((array("d", v) for v in log.values), 1))
        length = max(1, len(log.values[0]))
        self.record = acquire.Record(log.period, min(int(s.trigger.pos * length), length - 1), length, values)
        self.log = Path(path).name
        self.changed()

    def save_log(self):
        if self.record is None or not self.record.count:
            messagebox.showerror("halscope", _("There is no record to save."), parent=self.root)
            return
        path = filedialog.asksaveasfilename(parent=self.root, title=_("Save Log File"), filetypes=LOG_TYPES,
                                            defaultextension=".csv")
        if path:
            try:
                self.write_log(path)
            except OSError as e:
                self._complain(path, e)

    def write_log(self, path):
        numbers = [n for n in self.shown() if n in self.record.values]
        csvlog.save(path, self.record.period, [self.settings.channel(n) for n in numbers],
                    [self.record.values[n] for n in numbers])

    def quit(self):
        self.root.destroy()


def report(path, warnings):
    """Tells on standard error what a configuration had that could not be used."""
    for text in warnings:
        print(f"halscope: {text}", file=sys.stderr)
    if warnings:
        print(f"halscope: config file '{path}' caused {len(warnings)} warnings", file=sys.stderr)
