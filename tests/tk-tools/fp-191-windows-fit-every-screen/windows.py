"""windows.py LOOK...: texts that have no room, and unreadable colours, of all small windows
(tests/tk-tools/lib/fit_check.py).

windows.py untranslated: their texts that come from no catalogue.
"""
import array
import math
import sys
from types import SimpleNamespace

sys.path.insert(0, "../../../src/hal/user_comps")
from kerf import language
if "untranslated" in sys.argv:
    language.catalogue = lambda: SimpleNamespace(gettext=lambda text: "\u00ab" + text.strip() + "\u00bb")
import hal
import linuxcnc
from PIL import Image
import moveoff_gui
import pmx485_test
import sim_pin
import simulate_probe
from kerf import launch_windows, pickconfig, relief, tkstyle
from kerf.halscope import acquire, dialogs, screen, settings as scope_settings
from kerf.haltools import latency_panel, latency_view
from kerf.tktools import debuglevel, emccalib, hal_manualtoolchange, halmeter, halshow, image_to_gcode, linuxcnctop, mdro, ngcgui, teach_in, tooledit
from kerf.tktools.calibration import Calibration
from kerf.tktools.tooltable import Table
from kerf.tree import Tree
import fit_check


class Status:
    """What the controller would say."""
    debug, ini_filename, axis_mask, kinematics_type = 0, "", 7, linuxcnc.KINEMATICS_IDENTITY
    joints, spindles = 3, 1
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
    sim_pin.Window(root, "Pins",
                   [(sim_pin.Item("freebit"), "hold", True), (sim_pin.Item("count"), "toggle", True),
                    (sim_pin.Item("siggen.0.frequency"), "toggle", False)])


def show(root):
    window = halshow.Window(root, halshow.Preferences(None))
    window.add_words(["sig+freebit", "pin+siggen.0.frequency", "pin+and2.0.out"])
    return window


def histogram(root):
    platform = SimpleNamespace(realtime="PREEMPT_RT", is_realtime=True, virtual_clock=False, governors=["performance"],
                               isolated="2-3")
    bars = [latency_view.Bars([1, 5, 90, 4, 2], -20, 20, "us",
                              "servo min: -5.000 us max: 7.000 us sdev: 0.500 us   off chart: - 0  + 0")] * 2
    window = latency_view.Histograms(root, "latency-histogram", ["a processor (4), kernel 6.12"], "a note",
                                     ["base thread (25000 ns)", "servo thread (1000000 ns)"],
                                     lambda bins: bars, lambda: None, True, 200, platform)
    window.show()


def scope(root):
    settings = scope_settings.Settings()
    channel = settings.channel(1)
    channel.kind, channel.name, channel.type, channel.enabled = "pin", "siggen.0.sine", scope_settings.FLOAT, True
    settings.selected = settings.trigger.source = 1
    style = tkstyle.apply(root)
    window = screen.Screen(root, settings, acquire.Offline(), style)
    # A record with figures below its state: neither lies over the other.
    window.record = acquire.Record(1000000, 500, 1000,
                                   {1: array.array("d", (1e5 * math.sin(n / 30) for n in range(1000)))})
    window.state_text = lambda: screen._("WAITING FOR TRIGGER")
    window.changed()
    dialogs.RateDialog(root, settings, 32000, True, None, None)
    dialogs.OffsetDialog(root, 1, channel, None)


def latency(root):
    platform = SimpleNamespace(realtime="POSIX", is_realtime=False, virtual_clock=True, governors=["powersave"],
                               isolated="", doubts=lambda: [])
    pins = dict.fromkeys(("sl", "sj", "st", "bl", "bj", "bt", "reset"), 0)
    latency_panel.Window(root, pins, latency_panel.Worst("bs"), {"s": "servo", "b": "base"},
                         {"s": 1000000, "b": 25000}, platform)


def form(root):
    page = ngcgui.Page(root, tkstyle.apply(root), ngcgui.options(["-S", "pocket.ngc"]))
    page.frame.pack(fill="both", expand=True)
    page.create()


def probe(root):
    simulate_probe.Window(root, simulate_probe.Probe(sim_pin.Item("freebit")))


def moved_off(root):
    offsets = SimpleNamespace(display_only=False, enabled=lambda: True, may_enable=lambda: True,
                              current=lambda axis: 1.5, wanted=lambda axis: 1.5, usage=lambda: 95,
                              paused=lambda: True, applied=lambda: True, motion_on=lambda: True,
                              status=lambda: (moveoff_gui._(moveoff_gui.LIMIT), moveoff_gui.COLORS[moveoff_gui.LIMIT]))
    window = moveoff_gui.Window(root, offsets, moveoff_gui.parse([]))
    window.popup(5, lambda: None)


def cutter(root):
    window = pmx485_test.Window(root, "/dev/ttyUSB0")
    window.cutter = SimpleNamespace(answers=lambda: True, value=lambda register: 2.0, arc_s=lambda: 3723,
                                    look=lambda: None, close=lambda: None)
    window.show()
    window.say(pmx485_test._("The cutter is controlled from here."))


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
    "halscope": scope, "latency-test": latency, "ngcgui": form, "simulate_probe": probe, "moveoff_gui": moved_off,
    "errors": lambda root: launch_windows.Errors(root,
                                                 "«milltask (process 1234) died unexpectedly; stopping everything»",
                                                 "t.hal", "machine.ini"),
    "image-to-gcode": lambda root: image_to_gcode.Window(root, Image.new("L", (40, 30)), "a.png", relief.Settings()),
    "mdro": lambda root: mdro.Window(root, mdro.Readout(list("XYZ"), lambda i: 1.25, "inch"), component, 20),
    "pmx485-test": cutter,
}
if "untranslated" in sys.argv:
    fit_check.show_untranslated(PROGRAMS)
else:
    fit_check.run(PROGRAMS, sys.argv[1:])
