# SPDX-License-Identifier: GPL-2.0-or-later
import os
from pathlib import Path
from types import SimpleNamespace

import fit_check
from kerf.haltools import strip_chart
from kerf.tktools import debuglevel, emccalib, halconfig, linuxcnctop, monitor_xhc_hb04, tklinuxcnc
from kerf.tktools.calibration import Calibration
from kerf.tktools.machine import Machine
from mill import *

on()
Path("part.ngc").write_text("G21 G90 F2000\n" + "".join(f"G1 X{20 * (n % 2)} Y{n}\n" for n in range(20)) + "M2\n")
LONG = "a limit switch is closed and the program /home/somebody/linuxcnc/nc_files/a-part-with-a-long-name.ngc was stopped at line 123456"


def screen(root):
    """tklinuxcnc with all its windows."""
    machine = Machine("mill.ini")
    window = tklinuxcnc.Window(root, machine)
    window.popups.offsets()
    window.popups.set_coordinates()
    window.popups.tool_offset()
    window.popups.backplot()
    window.popups.message(LONG, True)
    window.popups.message("M0", False)
    window.help()
    return SimpleNamespace()


def pendant(root):
    window = monitor_xhc_hb04.Window(root,
                                     SimpleNamespace(step=lambda: monitor_xhc_hb04._("Lost connection to pendant")
                                                     + "\n\n" + monitor_xhc_hb04._("Reconnect not supported for require_pendant==1"), ended=False))
    window.tick()


def strips(root):
    threads = [("base", 25000), ("servo", 1000000)]
    rows = {name: [(n, n % 7 / 10, 0.7) for n in range(20)] for name, _ in threads}
    trace = SimpleNamespace(threads=threads, rows=rows, start=0, count=0, sample=lambda: None, reset=lambda: None)
    strip_chart.Plot(root, trace, SimpleNamespace(relative=True, points=0, time=1000),
                     "a processor (4), kernel 6.12").show()


def save(root):
    window = halconfig.Window(root)
    window.exit()
    return window


PROGRAMS = {"tklinuxcnc": screen, "emccalib": lambda root: emccalib.Window(root, Calibration("mill.ini")),
            "pendant": pendant, "latency-plot": strips, "linuxcnctop": lambda root: linuxcnctop.Window(root, s),
            "debuglevel": lambda root: debuglevel.Window(root, s, c), "halconfig": save}
fit_check.run(PROGRAMS, os.environ["FIT_LOOKS"].split())
