"""windows.py: texts that have no room, and unreadable colours, of all small windows.

windows.py untranslated: their texts that come from no catalogue.
"""
import re
import sys
import tkinter.font
from pathlib import Path
from types import SimpleNamespace

sys.path.insert(0, "../../../src/hal/user_comps")
if "untranslated" in sys.argv:
    from kerf import language
    language.catalogue = lambda: SimpleNamespace(gettext=lambda text: "\u00ab" + text.strip() + "\u00bb")
import hal
import linuxcnc
from PIL import Image
import sim_pin
import simulate_probe
from kerf import launch_windows, pickconfig, relief, tkstyle
from kerf.halscope import acquire, dialogs, screen, settings as scope_settings
from kerf.haltools import latency_panel, latency_view
from kerf.tktools import debuglevel, emccalib, hal_manualtoolchange, halmeter, halshow, image_to_gcode, linuxcnctop, mdro, ngcgui, teach_in, tooledit
from kerf.tktools.calibration import Calibration
from kerf.tktools.tooltable import Table
from kerf.language import _
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


def scope(root):
    settings = scope_settings.Settings()
    channel = settings.channel(1)
    channel.kind, channel.name, channel.type, channel.enabled = "pin", "siggen.0.sine", scope_settings.FLOAT, True
    settings.selected = settings.trigger.source = 1
    style = tkstyle.apply(root)
    screen.Screen(root, settings, acquire.Offline(), style)
    dialogs.RateDialog(root, settings, 32000, True, None, None)
    dialogs.OffsetDialog(root, 1, channel, None)


def latency(root):
    platform = SimpleNamespace(realtime="POSIX", is_realtime=False, virtual_clock=True, governors=["powersave"], isolated="", doubts=lambda: [])
    pins = dict.fromkeys(("sl", "sj", "st", "bl", "bj", "bt", "reset"), 0)
    latency_panel.Window(root, pins, latency_panel.Worst("bs"), {"s": "servo", "b": "base"}, {"s": 1000000, "b": 25000}, platform)


def form(root):
    page = ngcgui.Page(root, tkstyle.apply(root), ngcgui.options(["-S", "pocket.ngc"]))
    page.frame.pack(fill="both", expand=True)
    page.create()


def probe(root):
    simulate_probe.Window(root, simulate_probe.Probe(sim_pin.Item("freebit")))


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
    "halscope": scope, "latency-test": latency, "ngcgui": form, "simulate_probe": probe,
    "errors": lambda root: launch_windows.Errors(root, "«milltask (process 1234) died unexpectedly; stopping everything»", "t.hal", "machine.ini"),
    "image-to-gcode": lambda root: image_to_gcode.Window(root, Image.new("L", (40, 30)), "a.png", relief.Settings()),
    "mdro": lambda root: mdro.Window(root, mdro.Readout(list("XYZ"), lambda i: 1.25, "inch"), component, 20),
}


def luminance(root, colour):
    r, g, b = (c / 65535 for c in root.winfo_rgb(colour))
    return sum(w * (c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4) for w, c in ((0.2126, r), (0.7152, g), (0.0722, b)))


def contrast(root, a, b):
    a, b = sorted((luminance(root, a), luminance(root, b)))
    return (b + 0.05) / (a + 0.05)


def texts(widget):
    """Whatever the widgets, menus and pages below this one say."""
    for child in widget.winfo_children():
        kind = child.winfo_class()
        if kind == "Menu":
            yield from (child.entrycget(n, "label") for n in range((child.index("end") or 0) + 1) if child.type(n) not in ("separator", "tearoff"))
        elif kind == "TNotebook":
            yield from (child.tab(page, "text") for page in child.tabs())
        elif kind == "Canvas":
            yield from (child.itemcget(item, "text") for item in child.find_all() if child.type(item) == "text")
        elif kind == "Toplevel":
            yield child.title()
        elif "text" in child.keys():
            yield str(child.cget("text"))
        yield from texts(child)


def untranslated(root):
    """Texts with words that did not pass through a catalogue, as a set."""
    found = {" ".join(re.sub("\u00ab.*\u00bb", "", text, flags=re.S).split()) for text in [root.title(), *texts(root)]}
    return {text for text in found if re.search("[a-zA-Z]{2}", text)}


for name, make in PROGRAMS.items():
    root = tkstyle.open_display(name, "Test")
    root.report_callback_exception = lambda *what: print("TRACEBACK", what)
    window = make(root)
    for page in window.book.tabs() if hasattr(window, "book") else [None]:
        if page:
            window.book.select(page)
        root.update()
        root.update()
        for text in [] if "untranslated" in sys.argv else clipped(root):
            print(f"{name}: {text}")
    if "untranslated" in sys.argv:
        print(f"{name}:", "; ".join(sorted(untranslated(root))))
    root.destroy()
if "untranslated" in sys.argv:
    sys.exit()
root = tkstyle.open_display("letters", "Test")
style = tkstyle.apply(root)
print(_("Cancel") + ":", "letters", -tkinter.font.nametofont("TkDefaultFont", root).cget("size"))
for back, inks in (("face", ("ink", "bad", "good", "faint")), ("field", ("ink", "pin", "signal", "param", "chart"))):
    for ink in inks:
        if contrast(root, style.colours[ink], style.colours[back]) < (3 if ink == "chart" else 4.5):
            print(f"{ink} on {back}: contrast {contrast(root, style.colours[ink], style.colours[back]):.1f}")
