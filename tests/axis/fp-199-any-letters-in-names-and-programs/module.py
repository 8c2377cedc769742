# SPDX-License-Identifier: GPL-2.0-or-later
import os

import gcode


class Canon:
    def __getattr__(self, name):
        if name.startswith("__") or name in ("parameter_file", "use_move_batches", "move_batch"):
            raise AttributeError(name)
        return lambda *arguments: print(name, ascii(arguments)) if name in ("comment", "message") else None

    get_external_length_units = get_external_angular_units = lambda self: 1.0
    get_axis_mask = lambda self: 7
    get_tool = lambda self, n: (-1, *(0.0,) * 12, 0)
    get_block_delete = lambda self: 0


for name in os.fsdecode(b"lat\xe4.ngc"), "bad.ngc":
    result, line = gcode.parse(name, Canon(), "", "")
    print(ascii(name), result, line, ascii(gcode.strerror(result)))
    loaded = gcode.load(name)
    print(ascii(loaded.messages), ascii(loaded.error), ascii(loaded.fault and loaded.fault["report"]))
