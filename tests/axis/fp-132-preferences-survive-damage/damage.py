#!/usr/bin/python3
# FP-132: every cut and many damages of the preferences and of the MDI history: the screen starts with what is left,
# the old file is kept.
import random
import tempfile
from pathlib import Path

from axis.mdi import MdiHistory
from axis.prefs import Preferences
from kerf import files

folder = Path(tempfile.mkdtemp())
path = folder / "prefs"
good = Preferences(path)
good.putpref("show_tool", False)
good.add_recent("/nc/part.ngc")
good.putpref("grid_size", 0.5, float)
whole = path.read_bytes()
rng = random.Random(132)
damages = [whole[:n] for n in range(0, len(whole), 3)] + [b"", b"\0" * 300, b"\xff\xfe\x00x", b"[DEFAULT\n",
                                                          b"show_tool = maybe\n", b"[DEFAULT]\nshow_tool = maybe\nrecentfiles = [1,\n"]
for _ in range(60):
    bad = bytearray(whole)
    for _ in range(rng.randrange(1, 9)):
        bad[rng.randrange(len(bad))] = rng.randrange(256)
    damages.append(bytes(bad))
told, wrong = 0, []
for content in damages:
    for old in folder.iterdir():
        old.unlink()
    path.write_bytes(content)
    p = Preferences(path)
    values = p.getpref("show_tool", True), p.getpref("grid_size", 0.0, float), p.recent()
    if (not isinstance(values[0], bool) or not isinstance(values[1], float)
            or any(not isinstance(f, str) for f in values[2])):
        wrong.append((content, values))
    if p.damaged:
        told += 1
        if p.damaged.read_bytes() != content:
            wrong.append((content, "not kept"))
    p.putpref("show_tool", True)
    if Preferences(path).getpref("show_tool", False) is not True or Preferences(path).damaged:
        wrong.append((content, "not whole again"))
print("damages:", len(damages), "told:", told > 30, "wrong:", wrong[:2])

# a write that is cut off leaves the old file
replace = files.replace
files.replace = lambda *names: (_ for _ in ()).throw(OSError(28, "No space left on device"))
before = path.read_bytes()
Preferences(path).putpref("show_tool", False)
MdiHistory(folder / "history").add("G0 X1")
files.replace = replace
print("cut off: old file whole:", path.read_bytes() == before)
(folder / "history").write_bytes(b"G0 X1\n\xff\xfe\x00garbage\n" + b"G1 X2\n" * 3)
print("history:", MdiHistory(folder / "history").lines[::3])
