# SPDX-License-Identifier: GPL-2.0-or-later
# Presses everything of other people's panels in a seeded order while their input pins get any value: no traceback, and
# what they put out stays a number. Below halrun.
import math
import os
import sys
import tkinter
from pathlib import Path

sys.path[:0] = [os.path.abspath("../../lib"), os.path.abspath("../../../lib/python")]
import hal
import vcpparse
from hal import query
from tk_monkey import Monkey

ACTIONS = 50
VALUES = {hal.HAL_BIT: (0, 1), hal.HAL_S32: (-2**31, 0, 2**31 - 1), hal.HAL_U32: (0, 1, 2**32 - 1),
          hal.HAL_FLOAT: (0.0, 3.7, -1e9, 1e300, math.inf, -math.inf, math.nan)}
os.chdir("../panels-as-people-write-them-load/panels")
sys.stderr = open(os.devnull, "w")      # image numbers that there are not
trouble, done = [], 0
for number, path in enumerate(sorted(Path(".").glob("*.xml"))):
    root = tkinter.Tk()
    component = hal.component(f"m{number}")
    vcpparse.create_vcp(root, component, str(path))
    component.ready()
    root.update()
    own = {n: p for n, p in query.pins().items() if n.startswith(f"m{number}.")}
    inputs = sorted(n for n, p in own.items() if p["dir"] == hal.HAL_IN)
    monkey = Monkey(root, number)

    def turn():
        if inputs:
            name = monkey.random.choice(inputs)
            hal.set_p(name, monkey.random.choice(VALUES[own[name]["type"]]))
        for widget in (root, *monkey.widgets(root)):
            try:
                getattr(widget, "follow", lambda: None)()
            except Exception as error:
                monkey.trouble.append(f"{widget}: {error!r}")
    monkey.tick = turn
    trouble += [f"{path}: {what}" for what in monkey.run(ACTIONS)]
    done += len(monkey.done)
    trouble += [f"{path}: {n} = {hal.get_p(n)}"
                for n, p in own.items() if p["dir"] == hal.HAL_OUT and not math.isfinite(hal.get_p(n))]
    root.destroy()
    component.exit()
print("actions:", done, *trouble[:5], sep="\n")
