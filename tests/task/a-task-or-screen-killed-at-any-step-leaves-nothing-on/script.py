# SPDX-License-Identifier: GPL-2.0-or-later
"""script.py STEP FOLDER VICTIM: kills task or the screen, which is this program, STEP times 0.35 s after the program's
start; FOLDER/seen says what became of the outputs."""
import os
import signal
import sys
import time

import hal
import session
from mill import *

PINS = ("spindle.0.on", "motion.motion-enabled", "joint.0.amp-enable-out", "motion.digital-out-00")
SIGNALS = ("flood", "mist", "estop-loop", "tool-change")
step, folder = int(sys.argv[1]), Path(sys.argv[2])
told = []
clock.wait_until(lambda: told.extend(messages()) or told, 0.2)
interrupted = [t for t in told if "was cut off" in t or "interrupted" in t]
me = hal.component("observer")
me.ready()
on(home=False)
started = [p for p in PINS[:1] if hal.get_value(p)] + [x for x in ("flood", "mist", "tool-change") if hal.get_value(x)]
busy_program()
c.auto(AUTO_RUN, 0)
sleep(0.35 * step + 0.003)
poll()
if s.interp_state == INTERP_IDLE:
    (folder / "last").touch()
    print("the program was at its end;", len(told), "message at the start" if interrupted else told)
    sys.exit()
line = s.current_line
while not Path("mill.var.journal").exists():    # it is written in wall time
    time.sleep(0.01)
if os.fork():
    if sys.argv[3] == "screen":
        os.kill(os.getpid(), signal.SIGKILL)
    session.kill(sys.argv[3])
    clock.leave()
    signal.pause()
signal.signal(signal.SIGTERM, signal.SIG_IGN)    # a child looks on
os.setsid()
clock.join("onlooker", 900)


def high():
    return {p for p in PINS if hal.get_value(p)} | {x for x in SIGNALS if hal.get_value(x)}


def axes():
    return [hal.get_value(f"joint.{j}.motor-pos-cmd") for j in range(3)]


left = high()
rose, at, before = set(), axes(), None
try:
    while True:
        # until the launcher sees the screen's death the program goes on
        if sys.argv[3] != "screen" or "motion.motion-enabled" not in left:
            rose |= high() - left
        left, before, at = high(), at, axes()
        if sys.argv[3] == "screen" and "motion.motion-enabled" in left:
            time.sleep(0.005)       # the launcher sees it in wall time
        clock.sleep(0.001)
except RuntimeError:        # the pins are gone
    pass
(folder / "seen.new").write_text(f"line {line}: rose {sorted(rose)}, on at the end {sorted(left)}, motion "
                                 f"{'goes on' if at != before else 'stands'}; "
                                 f"at the start {started} {len(interrupted)} told\n")
os.rename(folder / "seen.new", folder / "seen")
os._exit(0)
