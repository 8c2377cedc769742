# SPDX-License-Identifier: GPL-2.0-or-later
"""Options, menus, interactive lines, -n modes, files, exit statuses."""
import os
import subprocess
import tempfile
from harness import *


def run(arguments, stdin="", program=None):
    with tempfile.TemporaryDirectory() as d:
        if program is not None:
            open(d + "/t.ngc", "w").write(program)
        open(d + "/tool.tbl", "w").write("T1 P1 Z1\n")
        r = subprocess.run(["rs274", *arguments], cwd=d, input=stdin, capture_output=True, text=True, timeout=30,
                           env=dict(os.environ, HOME=d, TMPDIR=d))
        return (Run(r.stdout, r.stderr, r.returncode), sorted(os.listdir(d)),
                {f: open(d + "/" + f).read() for f in os.listdir(d) if os.path.isfile(d + "/" + f)})


base = ["-t", "tool.tbl", "-v", "v.var", "-g"]
r, files, _ = run(base + ["t.ngc"], program="G0 X1\nM2\n")
check(r.status == 0 and files == ["t.ngc", "tool.tbl", "v.var"], files)
r, _, texts = run(base + ["t.ngc", "out.txt"], program="G0 X1\nM2\n")
check(r.out == "" and "STRAIGHT_TRAVERSE(1.0000" in texts["out.txt"], texts)
r, _, _ = run(base, stdin="G0 X1\nG1 X2\nG0 X[#5420+3]\nM2\nquit\n")
check("READ" not in r.out, f"no prompt in a pipe: {r.out}")
check([v[0] for _, v in r.moves()] == [1, 4] and "Cannot do g1 with zero feed rate\nG1 X2" in r.err and r.status == 0,
      r.out + r.err)
check(r.out.count("ON_RESET") == 1, "one reset at the end")
r, _, _ = run(base + ["-n", "0", "t.ngc"], program="G1 X1\nG0 X2\nG0 X3 X4\nG0 X5\nM2\n")
check([v[0] for _, v in r.moves()] == [2, 5] and r.status == 0, r.out)
r, _, _ = run(base + ["-n", "1", "t.ngc"], stdin="G0 Y7\nquit\ny\n", program="G1 X1\nG0 X2\nM2\n")
check([v[:2] for _, v in r.moves()] == [[0, 7], [2, 7]] and "starting MDI" in r.err
      and "continue program? y/n =>" in r.err, r.out + r.err)
r, _, _ = run(base + ["-n", "1", "t.ngc"], stdin="quit\nn\n", program="G1 X1\nG0 X2\nM2\n")
check(r.status == 1 and not r.moves(), r.out)
for options, want in (([], [1, 2]), (["-b"], [2])):
    r, _, _ = run(base + options + ["t.ngc"], program="/G0 X1\nG0 X2\nM2\n")
    check([v[0] for _, v in r.moves()] == want, "block delete")
r, _, _ = run(base + ["-s", "t.ngc"], program="G1 X1\nM2\n")
check(len(r.err.strip().split("\n")) > 4 and "convert_straight" in r.err, "stack of the stages")
r, _, _ = run(base + ["-T", "t.ngc"], program="(print,#<_task>)\nM2\n")
check(r.printed == ["1.000000"], r.printed)
r, _, _ = run(base + ["nothere.ngc"])
check(r.status == 1 and "Unable to open file <nothere.ngc>" in r.err and "ON_RESET" not in r.out, r.err)
r, _, _ = run(["-x"])
check(r.status == 1 and "Usage: rs274" in r.err, r.err)
r, _, _ = run(base + ["a", "b", "c", "d"])
check(r.status == 1 and "Usage" in r.err, r.err)
r, _, _ = run(base + ["-i", "nothere.ini", "t.ngc"], program="M2\n")
check(r.status == 1 and "could not open supplied INI file nothere.ini" in r.err, r.err)
r, _, _ = run(["-v", "v.var", "t.ngc"], stdin="4\n5\n2\n1\n3\ntool.tbl\n1\n", program="/G0 X1\nG43 H1\nG1 X1\nM2\n")
check("4 = turn block delete switch OFF" in r.err and "2 = do not print stack on error" in r.err
      and "name of tool file => " in r.err, r.err)
check("3 = " not in r.err.split("do not print stack")[1].split("enter choice")[0],
      "a choice of error handling beside options")
check(not r.moves() and "USE_TOOL_LENGTH_OFFSET(0.0000 0.0000 25.4000" in r.out, r.out)
r, _, _ = run(base + ["-p", "nothere.so", "t.ngc"], program="G0 X1\nM2\n")
check("could not open interpreter" in r.err and len(r.moves()) == 1, r.err)
r, _, _ = run(base + ["t.ngc"], program=" N0020 G0 X3\nN 7 G0 X1\nN123456789 G0 X2\n/n5G0X4\nM2\n")
check([l[6:13] for l in r.lines if "TRAVERSE" in l] == ["N0020  ", "N      ", "N123456", "N5     "], r.out)
r, _, _ = run(base + ["t.ngc"], program="G0 X" + "1" * 300 + "\nM2\n")
check(r.error == "Command too long", r.err)
r, _, _ = run(base + ["t.ngc"], program="(" + "x" * 250 + ")\nM2\n")
check(r.status == 0 and "x" * 250 in r.out, r.err)
r, _, _ = run(base + ["t.ngc"], program="")
check(r.error == "File ended with no percent sign (%)" and r.status == 1, r.err)
done()
