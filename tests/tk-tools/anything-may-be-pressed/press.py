import os
import sys
from pathlib import Path
from types import SimpleNamespace

import tk_monkey
sys.path.insert(0, str(Path(tk_monkey.__file__).resolve().parents[2] / "src/hal/user_comps"))
import hal
import pmx485_test
import sim_pin
from kerf import tkstyle
from kerf.haltools import latency_view
from kerf.tktools import emccalib, halmeter, halshow, mdro, ngcgui, tooledit
from kerf.tktools.calibration import Calibration
from kerf.tktools.tooltable import Table
from powermax import Powermax

Path("w.halshow").write_text("pin+siggen.0.sine sig+freebit nothing pin+no.such\n")
Path("pocket.ngc").write_text("(info: x)\no<pocket> sub\n#<a> = #1 (=1)\n#<b> = #2\no<pocket> endsub\n")
Path("machine.ini").write_text("[KINS]\nJOINTS = 1\n[HAL]\nHALFILE = t.hal\n[JOINT_0]\nF = 1\nS = 0\n[TUNE]\nA = 1\n")
Path("t.hal").write_text("setp siggen.0.frequency [JOINT_0]F\nsetp mux2.0.sel [JOINT_0]S\n"
                         "setp siggen.0.amplitude [TUNE]A\n")
ngcgui.subprocess = SimpleNamespace(run=lambda *a, **k: SimpleNamespace(returncode=1, stdout="no AXIS"),
                                    Popen=lambda *a, **k: None, DEVNULL=0, PIPE=0, STDOUT=0)
component = hal.component("mdro")
for i in range(3):
    component.newpin(f"axis.{i}", hal.HAL_FLOAT, hal.HAL_IN)
    component.newpin(f"index-enable.{i}", hal.HAL_BIT, hal.HAL_IO)
component.ready()


def table():
    Path("tool.tbl").write_text("".join(f"T{n} P{n} Z{n} D{n} ;tool {n}\n" for n in range(40)) + "T1 Zx\n")
    return Table("tool.tbl")


def histogram(root):
    platform = SimpleNamespace(realtime="PREEMPT_RT", is_realtime=True, virtual_clock=False, governors=["performance"],
                               isolated="2-3")
    return latency_view.Histograms(root, "latency-histogram", ["line"], "note", ["base", "servo"],
                                   lambda bins: [latency_view.Bars([1] * (bins or 5), -1, 1, "us", "text"), None],
                                   lambda: None, True, 200, platform)


def ngc(root):
    page = ngcgui.Page(root, tkstyle.apply(root), ngcgui.options(["-S", "pocket.ngc"]), coordinate=lambda letter: 1.5)
    page.frame.pack(fill="both", expand=True)
    page.bind_keys(root.bind_all)
    return page


# last: it owns the package Hal of this process
PROGRAMS = {
    "halmeter": lambda root: halmeter.Window(root, False, "pin", "siggen.0.sine", None),
    "emccalib": lambda root: emccalib.Window(root, Calibration("machine.ini")),
    "tooledit": lambda root: tooledit.Window(root, table(), ["Z", "D", "Q"], "rc"),
    "ngcgui": ngc, "latency-histogram": histogram,
    "mdro": lambda root: mdro.Window(root, mdro.Readout(list("XYZ"), lambda i: component[f"axis.{i}"], "inch"),
                                     component, 20),
    "sim_pin": lambda root: sim_pin.Window(root, "Pins",
                                           [(sim_pin.Item("freebit"), "hold", True),
                                            (sim_pin.Item("count"), "toggle", True)]),
    "pmx485-test": lambda root: pmx485_test.Window(root, Powermax().path),
    "halshow": lambda root: halshow.Window(root, halshow.Preferences(Path("prefs"))),
}
seed = int(os.environ.get("SEED", "1"))
for name, make in PROGRAMS.items():
    for life in range(1 if name == "halshow" else 2):
        root = tkstyle.open_display(name, "Test")
        window = make(root)
        root.update()
        monkey = tk_monkey.Monkey(root, f"{seed} {name} {life}",
                                  ["w.halshow", "tool.tbl", "pocket.ngc", "machine.ini", "no/such/file"],
                                  leave={"Exit", "Quit", "Glxgears", "Screenshot"})
        if name == "halshow":
            window.ask_name = window.view.ask_value = tk_monkey.simpledialog.askstring
        for text in monkey.run(int(os.environ.get("ACTIONS", 300 if name == "halshow" else 80))):
            print(f"seed {seed} {name} {life}: {text}")
        if monkey.alive():
            root.destroy()
    print(name, "is well")
