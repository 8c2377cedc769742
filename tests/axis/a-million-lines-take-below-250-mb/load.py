#!/usr/bin/python3
import os
import sys
from pathlib import Path

import operator_lib as lib

sys.path.insert(0, str(Path(lib.__file__).resolve().parents[3] / "src/emc/usr_intf/bench"))
from axis_load_bench import family_mb
from preview_bench import write

LIMIT_MB = 250


def script(op):
    out = open("transcript", "w")
    seen = {"alone": 0.0, "with the process that reads": 0.0}

    def look():
        """What the screen and the processes that it started have in memory, shared pages counted once."""
        reading = op.app.loader.reading
        kind = "with the process that reads" if reading and reading.child.poll() is None else "alone"
        seen[kind] = max(seen[kind], family_mb(os.getpid()) * 1024 * 1024 / 1e6)
        op.root.after(10, look)
    look()
    write("million.ngc", 1000000)
    print("drawn with:", op.app.preview.picture.kind, file=out)
    op.app.open_file_guts("million.ngc")
    op.wait(2)
    op.app.set_highlight_line(900000)
    op.wait(1)
    print("vertices:", len(memoryview(op.app.preview.drawings[0].kinds)), "thinned:",
          op.app.preview.program.thinned, file=out)
    print("below 250 MB:", {kind: True if 0 < most < LIMIT_MB else most for kind, most in seen.items()}, file=out)
    print("at most", seen, file=sys.stderr)


lib.run(script)
