# SPDX-License-Identifier: GPL-2.0-or-later
"""rs274 --check: each sort of error and suspicious line, once, at its place; no alarm where there is no
reason; --json says the same to programs."""
import json

from harness import *

INI = """[TRAJ]
LINEAR_UNITS=mm
COORDINATES=XYZ
[AXIS_X]
MIN_LIMIT=-10
MAX_LIMIT=50
[AXIS_Y]
MIN_LIMIT=-10
MAX_LIMIT=50
[AXIS_Z]
MIN_LIMIT=-20
MAX_LIMIT=10
"""


def findings(text, files=None, ini=INI):
    run = rs274(text, "--check", "--json", files=files, ini=ini)
    found = json.loads(run.out)
    check(run.status == (1 if any(f["severity"] == "error" for f in found) else 0), f"status {run.status}: {found}")
    plain = rs274(text, "--check", files=files, ini=ini)
    check(plain.status == run.status, plain.out)
    for f in found:
        check(f"{f['severity']}: {f['message']}" in plain.out and (not f["fix"] or f["fix"] in plain.out), plain.out)
    return found


def brief(text, **more):
    return [(f["severity"][0], f["line"], f["message"]) for f in findings(text, **more)]


H = "G21 G17 G90 F100\n"
cases = {
    # several errors of one file, with the place of each
    H + "G1 X1 X2\nG1 X5\nG1 Y[1/0]\nG99.9\nG1 X6\nM2\n": [
        ("e", 2, "Multiple x words on one line"), ("e", 4, "Attempt to divide by zero"),
        ("e", 5, "Unknown g code used")],
    # code that is never reached, and errors in it
    H + "G0 X1\nM2\nG1 X2\nG1 XY\n": [
        ("w", 4, "never executed: the program ends in line 3"),
        ("e", 5, "Unknown word where unary operation could be")],
    H + "o1 if [0]\nG1 Q\no1 endif\nM2\n": [("e", 3, "No characters found in reading real value")],
    # a feed that was never set: once, not for every line
    "G21 G90\nG0 X1\nG1 X2\nG1 X3\nX4\nG2 X5 I0.5\nM2\n": [("e", 3, "Cannot do g1 with zero feed rate")],
    "G21\nG2 X5 I2.5\nF100\nG1 X0\nM2\n": [("e", 2, "Cannot make arc with zero feed rate")],
    "G21\nG81 Z-1 R1\nM2\n": [("e", 2, "Cannot feed with zero feed rate")],
    "G21\nG38.2 Z-1\nM2\n": [("e", 2, "Cannot probe with zero feed rate")],
    "G21 G93\nG1 X1 F2\nG94 F100\nG1 X2\nM2\n": [],
    # an arc that is off, within the tolerance of the interpreter
    H + "G0 X0 Y0\nG2 X10 Y0 I5.004\nM2\n": [("w", 3,
                                              "arc start and end radius differ by 0.0080 mm (5.0040 and 4.9960)")],
    H + "G0 X0 Y0\nG2 X10 Y0 I5.0004\nM2\n": [],
    H + "G0 X0 Y0\nG2 X10 Y0 I5.1\nM2\n": [("e", 3,
                                            "Radius to end of arc differs from radius to start: "
                                            "start=(X0.0000,Y0.0000) center=(X5.1000,"
                                           "Y0.0000) end=(X10.0000,Y0.0000) r1=5.1000 r2=4.9000 abs_err=0.2 "
                                           "rel_err=3.9216%")],
    # a rapid under compensation, but not a retract
    H + "G41.1 D2\nG1 X10 Y0\nG0 X20\nY10\nG40\nG0 X30\nM2\n": [("w", 4, "G0 while cutter compensation is on"),
                                                                ("w", 5, "G0 while cutter compensation is on")],
    H + "G41.1 D2\nG1 X10 Y0\nX20\nG0 Z5\nG40 G0 X30\nM2\n": [],
    # tools
    H + "T99 M6\nM2\n": [("e", 2, "Requested tool 99 not found in the tool table")],
    H + "T1 M6\nG43 H77\nM2\n": [("e", 3, "Requested tool 77 not found in the tool table")],
    # units
    "G21 F100\nG1 X1\nG20\nG1 X1\nG21\nM2\n": [("w", 3, "the program uses both G20 and G21")],
    "G20\nG21 F100\nG1 X1\nM2\n": [],
    H + "G1 X#<_hal[a.pin]>\nM2\n": [],  # a pin of the machine, which is not there yet
    "G1 X1 F100\nM2\n": [("w", 1, "a feed move before any G20 or G21")],
    # limits, with offsets, rotation, arcs
    H + "G0 X51\nG0 X50\nG10 L2 P1 X10\nG0 X41\nG0 Z-21\nM2\n": [
        ("w", 2, "X moves to 51.0000, above its limit 50.0000 (machine units)"),
        ("w", 5, "X moves to 51.0000, above its limit 50.0000 (machine units)"),
        ("w", 6, "Z moves to -21.0000, below its limit -20.0000 (machine units)")],
    H + "G0 X40 Y0\nG3 X40 Y40 J20\nM2\n": [("w", 3, "X moves to 60.0000, above its limit 50.0000 (machine units)")],
    H + "G10 L2 P1 R90\nG0 X20\nG0 X0 Y20\nM2\n": [("w", 4,
                                                    "X moves to -20.0000, below its limit -10.0000 (machine units)")],
    H + "G43.1 Z15\nG0 Z0\nM2\n": [("w", 3, "Z moves to 15.0000, above its limit 10.0000 (machine units)")],
    "G20 F10\nG0 X2\nM2\n": [("w", 2, "X moves to 50.8000, above its limit 50.0000 (machine units)")],
    # files of subs need no end, programs do
    "o<part> sub\nG0 X1\no<part> endsub\nM2\n": [],
    "o<part> sub\nG0 X1\no<part> endsub\n": [],
    H + "G0 X1\n": [("e", 2, "File ended with no percent sign (%) or program end (M2)")],
    H + "o1 while [1]\no1 endwhile\nM2\n": [("w", 2, "the program has not ended after many lines: an endless loop?")],
}
for text, want in cases.items():
    got = brief(text)
    if "endless" in str(want):
        got = [(s, 2, m) for s, _, m in got]
    check(sorted(got) == sorted(want), f"{text!r}\n  got  {got}\n  want {want}")

f = findings(H + "o<part> call [3]\nM2\n", files={"part.ngc": "o<part> sub\nG1 X#1\nG1 Y#<nope>\no<part> endsub\n"})
check(len(f) == 1 and f[0]["file"].endswith("part.ngc") and f[0]["line"] == 3 and f[0]["column"] == 5
      and f[0]["text"] == "G1 Y#<nope>"
      and f[0]["fix"].startswith("give it a value"), f)
f = findings(H + "G0 X1 (Größe µm)\nG1 Xü (Öl)\nM2\n")
check(len(f) == 1 and f[0]["text"] == "G1 Xü (Öl)", f)
done()
