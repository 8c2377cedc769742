#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
import sys

import operator_lib as lib


def script(op):
    sys.stdout = open("transcript", "w", buffering=1)
    app = op.app
    print(ascii(app.loaded_file.rpartition("/")[2]), ascii(op.root.title().partition(" - ")[0]))
    print(ascii(app.widgets.text.get("1.0", "3.0")))
    print("drawn:", app.preview.program.n_moves, app.preview.program.messages)
    op.power_on()
    op.home()
    op.key("r")
    op.idle()
    print("ran to", op.position(0), ascii(op.messages()))
    app.refresh_preview()
    print("drawn again:", app.preview.program.n_moves)


lib.run(script)
