# SPDX-License-Identifier: GPL-2.0-or-later
# The pins of halui, with type and direction, for several INI files.
from pathlib import Path

from mill import *

LETTERS = "xyzabcuvw"


def expected(coordinates, joints, spindles, home_all, mdi):
    """As the manual's tables say: {name: (type, direction)}."""
    pins = {}

    def add(kind, way, *names):
        for name in names:
            pins["halui." + name] = (kind, way)

    out_bit = lambda *names: add("bit", "OUT", *names)
    in_bit = lambda *names: add("bit", "IN", *names)
    add("float", "OUT", "machine.units-per-mm", "max-velocity.value", "feed-override.value", "rapid-override.value",
        "tool.diameter")
    out_bit("machine.is-on", "estop.is-activated", "mode.is-manual", "mode.is-auto", "mode.is-mdi", "mode.is-teleop",
            "mode.is-joint", "mist.is-on", "flood.is-on", "program.is-idle", "program.is-running", "program.is-paused",
            "program.optional-stop.is-on", "program.block-delete.is-on")
    in_bit("machine.on", "machine.off", "estop.activate", "estop.reset", "mode.manual", "mode.auto", "mode.mdi",
           "mode.teleop", "mode.joint", "mist.on", "mist.off",
           "flood.on", "flood.off", "program.run", "program.pause", "program.resume", "program.step", "program.stop",
           "abort", "program.optional-stop.on", "program.optional-stop.off", "program.block-delete.on",
           "program.block-delete.off")
    add("u32", "OUT", "tool.number", "joint.selected", "axis.selected")
    for l in LETTERS:
        add("float", "OUT", f"tool.length_offset.{l}")
    overrides = ["feed-override", "rapid-override"] + [f"spindle.{n}.override" for n in range(spindles)]
    for name in overrides + ["max-velocity"]:
        add("s32", "IN", f"{name}.counts")
        add("float", "IN", f"{name}.scale")
        add("float", "OUT", f"{name}.value")
        in_bit(f"{name}.count-enable", f"{name}.direct-value", f"{name}.increase", f"{name}.decrease")
    for name in overrides:
        in_bit(f"{name}.reset")
    for n in range(spindles):
        out_bit(*(f"spindle.{n}.{p}" for p in ("is-on", "runs-forward", "runs-backward", "brake-is-on")))
        in_bit(*(f"spindle.{n}.{p}"
                 for p in ("start", "forward", "reverse", "stop", "increase", "decrease", "brake-on", "brake-off")))
    lamps = ("is-homed", "on-soft-min-limit", "on-soft-max-limit", "on-hard-min-limit", "on-hard-max-limit",
             "override-limits", "has-fault")
    for n in [*range(joints), "selected"]:
        out_bit(*(f"joint.{n}.{p}" for p in lamps))
        in_bit(*(f"joint.{n}.{p}" for p in ("home", "unhome", "plus", "minus", "increment-plus", "increment-minus")))
        add("float", "IN", f"joint.{n}.increment")
        if n != "selected":
            out_bit(f"joint.{n}.is-selected")
            in_bit(f"joint.{n}.select")
            add("float", "IN", f"joint.{n}.analog")
    for l in [*LETTERS, "selected"]:
        in_bit(*(f"axis.{l}.{p}" for p in ("plus", "minus", "increment-plus", "increment-minus")))
        add("float", "IN", f"axis.{l}.increment")
        if l != "selected":
            in_bit(f"axis.{l}.select")
            add("float", "IN", f"axis.{l}.analog")
    for l in coordinates:
        out_bit(f"axis.{l}.is-selected")
        add("float", "OUT", *(f"axis.{l}.{p}" for p in ("pos-commanded", "pos-feedback", "pos-relative")))
    add("float", "IN", "joint.jog-speed", "axis.jog-speed", "joint.jog-deadband", "axis.jog-deadband")
    if home_all:
        in_bit("home-all")
    if mdi:
        out_bit("halui-mdi-is-running")
        in_bit(*(f"mdi-command-{n:02d}" for n in range(min(mdi, 64))))
    return pins


def actual():
    found = {}
    for line in halcmd("show", "pin", "halui.*").splitlines():
        _, kind, way, _, name = line.split()[:5]
        found[name] = (kind, way)
    return found


for coordinates, joints, spindles, home_all, mdi in (("xyz", 3, 1, True, 0), ("xz", 2, 1, False, 3),
                                                     ("xyzabcuvw", 9, 3, True, 70), ("xyyz", 4, 1, True, 1),
                                                     (None, None, None, False, 0)):
    ini = "[EMC]\nMACHINE = x\n[DISPLAY]\n[HALUI]\n" + "".join(f"MDI_COMMAND = G0 X{n}\n" for n in range(mdi))
    if joints is not None:
        ini += f"[TRAJ]\nCOORDINATES = {' '.join(coordinates).upper()}\nSPINDLES = {spindles}\n[KINS]\nJOINTS = {joints}\n"
    if home_all:
        ini += "[JOINT_0]\nHOME_SEQUENCE = 0\n"
    Path("other.ini").write_text(ini)
    # no pipe: halui would keep it open
    clock.run(["halcmd", "loadusr", "-Wn", "halui", "halui", "-ini", "other.ini"], stderr=subprocess.DEVNULL)
    want, have = expected(sorted(set(coordinates or LETTERS)), joints or 3, spindles or 1, home_all, mdi), actual()
    print(coordinates, len(have), "missing", sorted(want.keys() - have.keys()), "more",
          sorted(have.keys() - want.keys()), "different",
          sorted(n for n in want.keys() & have.keys() if want[n] != have[n]))
    print("  presets", {n: getp("halui." + n)
                        for n in ("feed-override.scale", "rapid-override.count-enable", "max-velocity.scale",
                                  "max-velocity.count-enable", "joint.jog-deadband", "axis.jog-deadband",
                                  "spindle.0.override.scale", "axis.selected", "joint.0.is-selected")})
    print("  selected", [n for n in have
                         if n.startswith("halui.axis.") and n.endswith("is-selected") and getp(n) == "TRUE"])
    halcmd("unloadusr", "halui")
    clock.wait_until(lambda: "halui" not in halcmd("list", "comp").split(), 10)
