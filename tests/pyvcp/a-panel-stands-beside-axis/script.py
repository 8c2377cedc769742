#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
import hal
import linuxcnc
import operator_lib


def script(o):
    said = []
    panel = o.app.panel

    def find(kind, w=None):
        for child in (w or panel).winfo_children():
            if type(child).__name__ == kind:
                return child
            if found := find(kind, child):
                return found
        return None
    o.until(lambda: panel is not None and panel.winfo_ismapped(), "the panel")
    button, led, spin = (find(kind) for kind in ("Button", "Led", "Spinbox"))
    said.append(f"component {hal.component_is_ready('pyvcp')}, spinbox {hal.get_p('pyvcp.spinbox.0')}")
    o.key("F1")
    o.until(lambda: o.app.stat.task_state == linuxcnc.STATE_ESTOP_RESET, "estop reset")
    button.event_generate("<Enter>")
    button.event_generate("<ButtonPress-1>", x=5, y=5)
    said.append(f"pressed {hal.get_p('pyvcp.on')}")
    o.until(lambda: o.app.stat.task_state == linuxcnc.STATE_ON, "machine on by the panel")
    button.event_generate("<ButtonRelease-1>", x=5, y=5)
    o.until(lambda: not hal.get_p("pyvcp.on"), "button released")
    o.until(lambda: led.itemcget("lamp", "fill") == "green", "the lamp")
    o.key("e", state=4)
    o.until(lambda: not panel.winfo_ismapped(), "hidden by Ctrl-E")
    o.key("e", state=4)
    o.until(lambda: panel.winfo_ismapped(), "shown again")
    said.append("switched on, lamp green, hidden and shown")
    with open("transcript", "w") as file:
        file.write("\n".join(said + o.trouble) + "\n")


operator_lib.run(script)
