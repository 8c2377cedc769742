import sys
import tkinter.font
from pathlib import Path
from types import SimpleNamespace

sys.path.insert(0, "../../../src/hal/user_comps")
import hal
import linuxcnc
import sim_pin
from kerf import pickconfig, tkstyle
from kerf.haltools import latency_view
from kerf.tktools import debuglevel, emccalib, hal_manualtoolchange, halmeter, halshow, linuxcnctop, mdro, teach_in, tooledit
from kerf.tktools.calibration import Calibration
from kerf.tktools.tooltable import Table
from kerf.tree import Tree
from tk_hand import clipped


class Status:
    """What the controller would say."""
    debug, ini_filename, axis_mask, kinematics_type, joints = 0, "", 7, linuxcnc.KINEMATICS_IDENTITY, 3
    position = (1.0,) * 9
    file = "/home/somebody/linuxcnc/nc_files/part.ngc"

    def poll(self):
        pass


def change(root):
    pins = {"number": 3, "change": True, "change_button": False, "changed": False}
    window = hal_manualtoolchange.Window(root, hal_manualtoolchange.Exchange(pins))
    window.tick()


def meter(root):
    window = halmeter.Window(root, False, "pin", "siggen.0.sine", None)
    window.select()


def pins(root):
    sim_pin.Window(root, "Pins", [(sim_pin.Item("freebit"), "hold", True), (sim_pin.Item("count"), "toggle", True), (sim_pin.Item("siggen.0.frequency"), "toggle", False)])


def show(root):
    window = halshow.Window(root, halshow.Preferences(None))
    window.add_words(["sig+freebit", "pin+siggen.0.frequency", "pin+and2.0.out"])
    return window


def histogram(root):
    platform = SimpleNamespace(realtime="PREEMPT_RT", is_realtime=True, virtual_clock=False, governors=["performance"], isolated="2-3")
    bars = [latency_view.Bars([1, 5, 90, 4, 2], -20, 20, "us", "servo min: -5.000 us max: 7.000 us sdev: 0.500 us   off chart: - 0  + 0")] * 2
    window = latency_view.Histograms(root, "latency-histogram", ["a processor (4), kernel 6.12"], "a note", ["base thread (25000 ns)", "servo thread (1000000 ns)"],
                                     lambda bins: bars, lambda: None, True, 200, platform)
    window.show()


component = hal.component("mdro")
for i in range(3):
    component.newpin(f"index-enable.{i}", hal.HAL_BIT, hal.HAL_IO)
component.ready()
PROGRAMS = {
    "halshow": show, "halmeter": meter, "hal_manualtoolchange": change, "sim_pin": pins, "latency-histogram": histogram,
    "emccalib": lambda root: emccalib.Window(root, Calibration("machine.ini")),
    "tooledit": lambda root: tooledit.Window(root, Table("tool.tbl"), ["Z", "D"], "rc"),
    "pickconfig": lambda root: pickconfig.Picker(root, Tree.find()),
    "linuxcnctop": lambda root: linuxcnctop.Window(root, Status()),
    "debuglevel": lambda root: debuglevel.Window(root, Status(), None),
    "teach-in": lambda root: teach_in.Window(root, Status(), sys.stdout),
    "mdro": lambda root: mdro.Window(root, mdro.Readout(list("XYZ"), lambda i: 1.25, "inch"), component, 20),
}


def luminance(root, colour):
    r, g, b = (c / 65535 for c in root.winfo_rgb(colour))
    return sum(w * (c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4) for w, c in ((0.2126, r), (0.7152, g), (0.0722, b)))


def contrast(root, a, b):
    a, b = sorted((luminance(root, a), luminance(root, b)))
    return (b + 0.05) / (a + 0.05)


for name, make in PROGRAMS.items():
    root = tkstyle.open_display(name, "Test")
    root.report_callback_exception = lambda *what: print("TRACEBACK", what)
    window = make(root)
    for page in window.book.tabs() if hasattr(window, "book") else [None]:
        if page:
            window.book.select(page)
        root.update()
        root.update()
        for text in clipped(root):
            print(f"{name}: {text}")
    root.destroy()
root = tkstyle.open_display("letters", "Test")
style = tkstyle.apply(root)
print("letters", -tkinter.font.nametofont("TkDefaultFont", root).cget("size"))
for back, inks in (("face", ("ink", "bad", "good", "faint")), ("field", ("ink", "pin", "signal", "param", "chart"))):
    for ink in inks:
        if contrast(root, style.colours[ink], style.colours[back]) < (3 if ink == "chart" else 4.5):
            print(f"{ink} on {back}: contrast {contrast(root, style.colours[ink], style.colours[back]):.1f}")
