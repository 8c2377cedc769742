"""windows.py LOOK...: panels as people write them, a machine's picture, the histogram of a pin, the dialog of
channels, the picture of the start (tests/tk-tools/lib/fit_check.py)."""
import os
import sys
import tkinter
from pathlib import Path
from types import SimpleNamespace

import hal
import vcpparse
from axis.icons import Icons
from kerf import launch_windows, tkstyle
from kerf.haltools import latency_view
from kerf.halscope import picker
from kerf.tkscroll import Scrolled
from vismach import Capture, CylinderZ, Hud
from vismach.view import View
import fit_check

PICTURE, PICTURE_PX = Path("start.png").absolute(), 300
PANELS = Path(os.environ["TEST_DIR"]) / "../../pyvcp/panels-as-people-write-them-load/panels"


def panel(path):
    def make(root):
        tkstyle.apply(root)
        component = hal.component(f"p{os.getpid()}-{panel.number}")
        panel.number += 1
        os.chdir(path.parent)
        vcpparse.filename = path.name
        view = Scrolled(root)           # as the program pyvcp does
        view.pack(fill="both", expand=True)
        vcpparse.create_vcp(view.inner, component)
        component.ready()
        root.bind("<Destroy>", lambda event: event.widget is root and component.exit())
    return make


panel.number = 0


def histogram(root):
    bars = [latency_view.Bars([1, 5, 90, 4, 2], -1, 1, "",
                              "samples: 123456 min: -12345.7 max: 12345.7 mean: 0.123457 sdev: 1.5   off "
                              "chart: - 12  + 345")]
    platform = SimpleNamespace(realtime="PREEMPT_RT", is_realtime=True, virtual_clock=False, governors=["performance"],
                               isolated="2-3")
    latency_view.Histograms(root, "hal-histogram", [], "a text", ["joint.0.f-error-with-a-long-name"],
                            lambda bins: bars, lambda: None, False, 200, platform).show()


def start(root):
    style = tkstyle.apply(root)
    image = launch_windows.fitting(root, PICTURE)
    tkinter.Label(root, image=image).pack()
    root.image = image
    most = 0.8 * root.winfo_screenheight()
    print("the picture of the start grows with the letters:",
          abs(image.height() - min(PICTURE_PX * style.scale, most)) < 2)


def machine(root):
    view = View(root, CylinderZ(0, 1, 5, 1), Capture(), Capture(), 10, Hud(), -75, 0)
    view.hud.show("a line of the picture")
    view.redraw()
    print("a machine's picture grows with the letters:",
          view.frame.winfo_reqheight() >= min(600 * tkstyle.screen_scale(root), root.winfo_screenheight() - 60))


def source(root):
    tkstyle.apply(root)
    return SimpleNamespace(book=picker.SourcePicker(root, 3, SimpleNamespace(kind="", name=""), None).book)


# Not everything: one has colours that its author chose.
LEFT_OUT = ("05-numbers",)
PROGRAMS = {p.stem: panel(p)
            for p in (*sorted(PANELS.glob("*.xml")), PANELS / "../../panels-can-be-read-in-both-themes/panel.xml",
                                      PANELS / "../../../../configs/sim/panel/panel.xml") if p.stem not in LEFT_OUT}
PICTURE.write_bytes(Icons(None, PICTURE_PX).png("estop"))
PROGRAMS |= {"hal-histogram": histogram, "source": source, "start": start, "machine": machine}
fit_check.run(PROGRAMS, sys.argv[1:])
