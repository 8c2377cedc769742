# SPDX-License-Identifier: GPL-2.0-or-later
# A sub called by MDI runs in slices: an endless one, with or without motion, is ended by an
# abort, a long one is not read ahead without bound and runs to its end. So does a program.
from pathlib import Path

from mill import *

Path("moving.ngc").write_text("o<moving> sub\nG91\no1 while [1]\nG1 X1 F3000\nX-1\no1 endwhile\no<moving> endsub\n")
Path("silent.ngc").write_text("o<silent> sub\no1 while [1]\n#1=[#1+1]\no1 endwhile\no<silent> endsub\n")
Path("long.ngc").write_text("o<long> sub\nG91\no1 repeat [4000]\nG1 X.001 F3000\no1 endrepeat\nG90\n"
                            "o<long> endsub [7]\n")
on()
for name in ("moving", "silent"):
    mdi("G90 G0 X0 Y0")
    c.mdi(f"o<{name}> call")
    need(lambda s: s.call_level == 1, f"call of {name}")
    sleep(1)
    print(name, "runs:", s.call_level, s.interp_state != INTERP_IDLE)
    c.abort()
    idle()
    print("idle, messages:", messages())
    mdi("G90 G0 X5")
    print("then", xyz())
mdi("G90 G0 X0")
print("result", mdi("o<long> call"), "at", xyz())
mdi("(debug,returned #<_value> level #<_call_level>)")
print(messages())
for body in "o1 while [1]\n#1=[#1+1]\no1 endwhile\n", "o1 while [1]\no<moving> call\no1 endwhile\n", "M99\n":
    program(body + "M2\n")
    c.auto(AUTO_RUN, 0)
    need(lambda s: s.interp_state != INTERP_IDLE, "start of the program")
    sleep(1)
    print("program runs:", poll().interp_state != INTERP_IDLE)
    c.abort()
    idle()
    print("idle, messages:", messages(), run("G90 G0 X3\nM2\n"), xyz())
