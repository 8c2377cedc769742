# SPDX-License-Identifier: GPL-2.0-or-later
"""Forward or inverse kinematics of each module give the points that were measured of another controller."""
import os
import subprocess
import tempfile

TOLERANCE = 1e-8
machines = []
with open("points", encoding="ascii") as f:
    for line in f:
        words = line.split()
        if words[0] in ("joints", "pose"):
            given, result = line.split("=")
            machines[-1][1].append((words[0], given.split()[1:], [float(x) for x in result.split()]))
        elif words[0] != "#":
            machines.append((words, []))

bad, compared = [], 0
for (module, *settings), points in machines:
    load = [w for w in settings if w.startswith(("coordinates=", "kinstype="))]
    typ = [w for w in settings if w.startswith("type=")]
    lines = [" ".join(["loadrt", module, *load])]
    lines += ["setp " + w.replace("=", " ") for w in settings if w not in load + typ]
    for by, given, _ in points:
        ranges = ",".join(f"{v}:{v}" for v in given)
        lines += [f"loadrt kinscheck points=1 show=1 by={by} ranges={ranges} {' '.join(typ)}", "unloadrt kinscheck"]
    with tempfile.NamedTemporaryFile("w", suffix=".hal") as f:
        f.write("\n".join(lines) + "\n")
        f.flush()
        done = subprocess.run(["halrun", "-f", f.name], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                              env=os.environ)
    shown = [line.split() for line in (done.stdout + done.stderr).splitlines() if line.startswith("joints")]
    if done.returncode or len(shown) != len(points):
        bad.append(f"{module}: {done.stdout}{done.stderr}")
    for (by, given, wanted), words in zip(points, shown):
        values = words[11:20] if by == "joints" else words[1:10]
        compared += 1
        if not max(abs(float(v) - w) for v, w in zip(values, wanted)) < TOLERANCE:
            bad.append(f"{module}: {by} {given} gives {values} instead of {wanted}")
print("\n".join(bad) if bad else f"{len(machines)} modules, {compared} points")
