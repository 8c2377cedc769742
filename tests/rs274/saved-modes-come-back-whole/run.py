# SPDX-License-Identifier: GPL-2.0-or-later
"""FP-106: M70...M72 and M73 restore every modal group that they cover, feed mode and F among them, after any
change in between."""
import random
from harness import *

groups = [["G17", "G18", "G19"], ["G20", "G21"], ["G90", "G91"], ["G90.1", "G91.1"], ["G94", "G95", "G93"],
          ["G98", "G99"], ["G54", "G55", "G59.3"], ["G61", "G61.1", "G64 P0.1 Q0.05"], ["G7", "G8"], ["M3", "M4", "M5"],
          ["M7", "M9"], ["M48", "M49"], ["G43.1 Z1", "G49"]]
SHOW = "(print,#<_plane> #<_metric> #<_absolute> #<_ijk_absolute_mode> #<_inverse_time> #<_units_per_minute> #<_units_per_rev>)\n" \
       "(print,#<_retract_old_z> #<_coord_system> #<_lathe_diameter_mode> #<_spindle_on> #<_spindle_cw> #<_mist> #<_feed_override> #<_speed_override> " \
       "#<_tool_offset>)\n"
for seed in range(120):
    r = random.Random(seed)
    def some(count):
        text = "".join(r.choice(g) + "\n" for g in r.sample(groups, count))
        return text + f"F{r.randint(1, 900)}\nS{r.randint(1, 900)}\n"
    start = some(len(groups))
    if r.random() < .5:
        program = f"{start}{SHOW}(print,#<_feed> #<_rpm>)\nM70\n{some(7)}M72\n{SHOW}(print,#<_feed> #<_rpm>)\nM2\n"
    else:
        program = f"o1 sub\nM73\n{some(7)}o1 endsub\n{start}{SHOW}(print,#<_feed> #<_rpm>)\no1 call\n{SHOW}(print,#<_feed> #<_rpm>)\nM2\n"
    run = rs274(program)
    check(run.status == 0, f"seed {seed}: {run.error}")
    a1, a2, feed, b1, b2, feed_after = run.printed
    a, b = a1 + " " + a2, b1 + " " + b2
    check(a.split()[:-1] == b.split()[:-1], f"FP-106 seed {seed}:\n{a}\n{b}\n{program}")
    inverse = a.split()[4].startswith("1")
    check(inverse or feed == feed_after, f"FP-106 seed {seed}: F and S {feed}, then {feed_after}\n{program}")
done()
