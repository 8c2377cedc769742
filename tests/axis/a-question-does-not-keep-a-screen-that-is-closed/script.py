#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
import os
import types

import operator_lib


def script(op):
    own = op.app.settings
    with open("transcript", "w") as out:
        for axes, lathe in (("XYZ", False), ("XYZA", False), ("XZC", False), ("XZ", True),
                            ("XYUV", False), ("X", True)):
            op.app.settings = types.SimpleNamespace(axes=axes, lathe=lathe)
            print(axes, "lathe" if lathe else "mill", os.path.basename(op.app.demo()) or "nothing", file=out)
    op.app.settings = own


operator_lib.run(script)
