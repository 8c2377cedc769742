# SPDX-License-Identifier: GPL-2.0-or-later
"""The program halscope."""

import getopt
import sys

from ..language import _

AUTOSAVE = "autosave.halscope"
USAGE = """Usage: halscope [-h] [-i infile] [-o outfile] [num_samples]
  -h             this text
  -i infile      configuration to begin with (autosave.halscope)
  -o outfile     where the configuration goes at the end (autosave.halscope)
  num_samples    values in the buffer, shared by all channels: 1000 to 1000000 (32000)"""


def arguments(words):
    """(infile, outfile, samples or 0); None after telling what is wrong."""
    try:
        options, rest = getopt.gnu_getopt(words, "hi:o:")
    except getopt.GetoptError as e:
        print(f"halscope: {e}\n{USAGE}", file=sys.stderr)
        return None
    chosen = dict(options)
    if len(rest) > 1 or any(not word.isdigit() for word in rest):
        print(f"halscope: bad number of samples '{' '.join(rest)}'\n{USAGE}", file=sys.stderr)
        return None
    return chosen.get("-i", AUTOSAVE), chosen.get("-o", AUTOSAVE), int(rest[0]) if rest else 0


def main(words):
    if "-h" in words or "--help" in words:
        print(USAGE)
        return 0
    chosen = arguments(words)
    if chosen is None:
        return 1
    infile, outfile, samples = chosen
    import hal
    from tkinter import messagebox
    from .. import tkstyle
    from . import acquire, configfile, settings as st
    from .screen import Screen, report
    root = tkstyle.open_display("halscope", "Halscope")
    root.withdraw()
    try:
        component = hal.component("halscope")
    except hal.error as e:
        print(f"halscope: {e}: is another halscope running?", file=sys.stderr)
        tkstyle.apply(root)
        messagebox.showerror("halscope", _("Another halscope is running already."))
        return 1
    component.ready()
    settings = st.Settings()
    try:
        report(infile, configfile.load(infile, settings, acquire.source_type))
    except OSError:
        print(f"halscope: config file '{infile}' could not be opened", file=sys.stderr)
    settings.samples = st.clamp_samples(samples or settings.samples or st.DEFAULT_SAMPLES)
    acq = acquire.Offline()
    if hal.get_realtime_type() == hal.RTType.UNINITIALIZED:
        print("halscope: no realtime is running: only log files can be shown", file=sys.stderr)
    else:
        try:
            acq = acquire.Acquisition(component, settings.samples)
            if settings.thread and not acquire.linked_thread():
                acq.link(settings.thread)
        except acquire.ScopeError as e:
            print(f"halscope: {e}", file=sys.stderr)
            if isinstance(acq, acquire.Offline):
                return 1
    settings.thread = acquire.linked_thread() or settings.thread
    mode, settings.run_mode = settings.run_mode, st.STOP
    screen = Screen(root, settings, acq, tkstyle.apply(root))
    root.deiconify()
    if not isinstance(acq, acquire.Offline):
        if not acquire.linked_thread():
            screen.ask_rate(first=True)
        elif mode != st.STOP and settings.enabled():
            screen.set_run_mode(mode)
    try:
        root.mainloop()
    except KeyboardInterrupt:
        pass
    acq.close()
    try:
        configfile.save(outfile, screen.settings)
    except OSError as e:
        print(f"halscope: '{outfile}': {e.strerror}", file=sys.stderr)
        return 1
    return 0
