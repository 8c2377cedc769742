#!/usr/bin/env python3
"""A userspace component with lamps, linked to halui."""
import subprocess
import time
import hal

h = hal.component("panel")
h.newpin("off", hal.HAL_BIT, hal.HAL_OUT)
h.newpin("lamp", hal.HAL_BIT, hal.HAL_IN)
h.ready()
for net in ("p-off panel.off halui.machine.off", "p-lamp halui.machine.is-on panel.lamp"):
    subprocess.run(["halcmd", "net"] + net.split(), check=True)
print("lamp", h["lamp"])
h["off"] = True
for _ in range(1000):
    if not h["lamp"]:
        break
    time.sleep(0.01)
print("lamp", h["lamp"])
h.exit()
