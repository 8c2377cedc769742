#!/usr/bin/python3
# Loads each panel in a component of its own and lists its pins; below halrun.
import os
import sys
import tkinter as tk
from pathlib import Path

sys.path.insert(0, os.path.abspath("../../../lib/python"))
import hal
import vcpparse
from hal import query

os.chdir("panels")
root = tk.Tk()
KIND = {hal.HAL_BIT: "bit", hal.HAL_FLOAT: "float", hal.HAL_S32: "s32", hal.HAL_U32: "u32"}
components = []
for path in sorted(Path(".").glob("*.xml")):
    name = f"p{path.stem[:2]}"
    component = hal.component(name)
    components.append(component)
    frame = tk.Frame(root)
    frame.pack()
    try:
        vcpparse.filename = str(path)
        vcpparse.create_vcp(frame, component)
        component.ready()
        for _ in range(2):
            root.update()
    except SystemExit as e:
        print(path, "refused:", e)
        frame.destroy()
        continue
    own = {n: p for n, p in query.pins().items() if n.startswith(f"{name}.")}
    if path.stem.startswith("12"):
        own |= {n: p for n, p in query.pins().items() if n.startswith(("left.", "right."))}
    print(f"{path.stem}:", *sorted(f"{n.removeprefix(name + '.')} {KIND[p['type']]} "
                                   f"{'in' if p['dir'] == hal.HAL_IN else 'out'}"
                                   + (f" {hal.get_p(n):g}" if p["dir"] != hal.HAL_IN and hal.get_p(n) else "")
                                   for n, p in own.items()), sep="\n    ")
    frame.destroy()
root.destroy()
for component in components:
    component.exit()
