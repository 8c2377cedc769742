#!/usr/bin/python3
import sys

import linuxcnc
import operator_lib as lib


def script(op):
    sys.stdout = open("transcript", "w", buffering=1)
    app = op.app
    print("marked:", app.vars.highlight_line.get(), [m for m in op.messages() if "which is marked" in m])
    op.power_on()
    op.home()
    op.key("F3")

    def here():
        op.wait(1)
        return (op.stat.interp_state == linuxcnc.INTERP_IDLE, op.stat.spindle[0]["enabled"],
                [op.position(i) for i in range(3)])
    before = here()
    op.answer(2)                 # Cancel
    op.root.tk.call("task_run_line")
    print("shown and cancelled: nothing moved or started:", here() == before)
    op.answer(0)                 # Restore and run
    op.root.tk.call("task_run_line")
    op.until(lambda: op.stat.interp_state != linuxcnc.INTERP_IDLE, "the restored start")
    op.until(lambda: op.stat.motion_line == 4 and op.position(1) > 1, "the line")
    print("goes on at line 4, spindle:", op.stat.spindle[0]["speed"], "cut off is forgotten:", op.stat.cut_off_line)
    op.idle()
    print("ended:", [op.position(i) for i in range(3)])


lib.run(script)
