#!/usr/bin/python3
import resource
import sys
from pathlib import Path

import operator_lib as lib

sys.path.insert(0, str(Path(lib.__file__).resolve().parents[3] / "src/emc/usr_intf/bench"))
from preview_bench import write

LIMIT_MB = 250


def peak_mb():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024 / 1e6


def script(op):
    out = open("transcript", "w")
    write("million.ngc", 1000000)
    print("drawn with:", op.app.preview.picture.kind, file=out)
    op.app.open_file_guts("million.ngc")
    op.wait(2)
    op.app.set_highlight_line(900000)
    op.wait(1)
    print("vertices:", len(memoryview(op.app.preview.drawings[0].kinds)), "thinned:", op.app.preview.program.thinned, file=out)
    most = peak_mb()
    print("below 250 MB at any time:", True if most < LIMIT_MB else most, file=out)
    print(f"at most {most:.0f} MB", file=sys.stderr)


lib.run(script)
