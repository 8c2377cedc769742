#!/usr/bin/python3
import os
import sys
from pathlib import Path

import operator_lib as lib

sys.path.insert(0, str(Path(lib.__file__).resolve().parents[3] / "src/emc/usr_intf/bench"))
from axis_load_bench import family_mb
from preview_bench import write, write_crossing

LIMIT_MB = 250


def script(op):
    out = open("transcript", "w")
    seen, doing = {}, "the first"

    def look():
        """What the screen and the processes that it started have in memory, shared pages counted once."""
        reading = op.app.loader.reading
        kind = f"{doing}, " + ("with the process that reads" if reading and reading.child.poll() is None else "alone")
        seen[kind] = max(seen.get(kind, 0.0), family_mb(os.getpid()) * 1024 * 1024 / 1e6)
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
    doing = "the same again"
    op.app.open_file_guts("million.ngc")
    op.wait(2)
    write_crossing("crossing.ngc", 1000000)
    doing = "another of lines that cross"
    op.app.open_file_guts("crossing.ngc")
    op.wait(4)
    for kind, most in seen.items():
        print("below 250 MB,", kind, True if 0 < most < LIMIT_MB else most, file=out)
    print("at most", seen, file=sys.stderr)


lib.run(script)
