# SPDX-License-Identifier: GPL-2.0-or-later
# A wrapped axis stands beyond 360 degrees: the preview is read all the same, and turns as the machine does.
from axis.program import Loader
from axis.settings import read
from mill import *

on()
settings = read(linuxcnc.ini("xyza.ini"))
settings.ini_path = str(Path("xyza.ini").resolve())
loader = Loader(settings)
for start in (725.5, -1085.25):
    for turn in [start / 4] * 4:
        mdi(f"G91 G1 A{turn} F5000")
    mdi("G90")
    program("G21 G91 G94 F600\nG1 X5 A10\nG1 Y5 A-30\nM2\n", "turn.ngc")
    mode(MODE_MANUAL)
    c.task_plan_synch()
    c.wait_complete()
    at = poll().position[3]
    preview, (drawn,) = loader.read(str(Path("turn.ngc").resolve()), s, False,
                                    [(-1, 0.0, "XYZ!A", [0.0] * 9, "XYZA")], 60.0).result()
    mode(MODE_AUTO)
    c.auto(AUTO_RUN, 0)
    need(lambda s: s.interp_state == INTERP_IDLE and s.inpos and s.queue == 0, "end of the program")
    print(round(at, 3), preview.error, preview.failed, preview.n_moves, "vertices", len(drawn.vertices) > 10, "turned",
          round(poll().position[3] - at, 3), messages())
    mdi("G90 G0 A0 X0 Y0")
loader.close()
