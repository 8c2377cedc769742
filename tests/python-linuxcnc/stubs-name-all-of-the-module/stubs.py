# SPDX-License-Identifier: GPL-2.0-or-later
# linuxcnc.pyi is valid Python and names exactly what the module has.
import ast
from pathlib import Path

import linuxcnc

tree = ast.parse(Path(linuxcnc.__file__).with_suffix(".pyi").read_text())


def names(body):
    found = {}
    for node in body:
        if isinstance(node, (ast.ClassDef, ast.FunctionDef)):
            found[node.name] = node
        elif isinstance(node, ast.AnnAssign):
            found[node.target.id] = node
    return found


def public(thing):
    return {n for n in dir(thing) if not n.startswith("_")}


helpers = {"Joint", "Axis", "Spindle", "Message"}
top = names(tree.body)
print("module: missing", sorted(public(linuxcnc) - top.keys()), "more", sorted(top.keys() - public(linuxcnc) - helpers))
for name in ("stat", "command", "error_channel", "message_log", "ini", "positionlogger"):
    inside = {n for n in names(top[name].body) if n != "__init__"}
    have = public(getattr(linuxcnc, name))
    print(f"{name}: missing", sorted(have - inside), "more", sorted(inside - have), "some" if len(have) > 0 else "none")
s = linuxcnc.stat()
for name, sample in (("Joint", s.joint[0]), ("Axis", s.axis[0]), ("Spindle", s.spindle[0])):
    inside = names(top[name].body).keys()
    print(f"{name}:", sorted(sample.keys() ^ inside))
constants = [n for n, node in top.items() if isinstance(node, ast.AnnAssign) and node.value is not None]
print("constants that differ:", [n for n in constants if getattr(linuxcnc, n) != ast.literal_eval(top[n].value)],
      len(constants) > 70)
# Scalar attributes have the annotated type.
wrong = []
for name, node in names(top["stat"].body).items():
    if isinstance(node, ast.FunctionDef) and isinstance(node.returns, ast.Name) and node.decorator_list:
        if type(getattr(s, name)).__name__ != node.returns.id and node.returns.id != "Pose":
            wrong.append((name, node.returns.id))
print("types that differ:", wrong)
