# SPDX-License-Identifier: GPL-2.0-or-later
import os
import signal
import subprocess
import time
from pathlib import Path

from mill import *

on()
Path("part.ngc").write_text("G21 G90 G64 P0.01 F3000\n" + "".join(f"G1 X{10 * (n % 2)} Y{n % 7}\n" for n in range(300))
                            + "M2\n")
Path("w.halshow").write_text("pin+joint.0.motor-pos-cmd pin+motion.feed-hold sig+no-such\n")
c.mode(MODE_AUTO)
c.wait_complete()
c.program_open("part.ngc")
c.wait_complete()
c.auto(AUTO_RUN, 0)
need(lambda s: s.interp_state != INTERP_IDLE, "start")
env = {k: v for k, v in os.environ.items() if k != "KERF_CLOCK_SLOT"}
PROGRAMS = {"halshow --noprefs w.halshow": "Halshow", "halmeter pin joint.0.motor-pos-cmd": "Hal Meter",
            "linuxcnctop -ini mill.ini": "LinuxCNC Status", "debuglevel -ini mill.ini": "LinuxCNC Debug Level",
            "tooledit mill.tbl": "tooledit", "tklinuxcnc -ini mill.ini": "TkLinuxCNC"}


def seen(title, patience=120):
    """Wall time: windows are programs beside the machine. Its own time goes on a little
    meanwhile, they may wait for it."""
    end = time.monotonic() + patience
    while subprocess.run(["xdotool", "search", "--onlyvisible", "--name", title], stdout=subprocess.DEVNULL,
                         stderr=subprocess.DEVNULL).returncode:
        if time.monotonic() > end:
            return False
        sleep(0.002)
        time.sleep(0.05)
    return True


def open_windows():
    """One of each; the machine goes on meanwhile."""
    started = [subprocess.Popen(words.split(), env=env, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                stderr=subprocess.DEVNULL) for words in PROGRAMS]
    for title in PROGRAMS.values():
        if not seen(title):
            print("no window:", title)
    return started


for _ in range(2):
    windows = open_windows()
    line = poll().motion_line
    sleep(0.5)
    print("goes on:", poll().motion_line > line, s.interp_state != INTERP_IDLE)
    for process in windows:
        process.send_signal(signal.SIGKILL)
        process.wait()
    line = poll().motion_line
    sleep(1.0)
    print("killed; goes on:", poll().motion_line > line, s.interp_state != INTERP_IDLE, s.task_state == STATE_ON)
need(lambda s: s.interp_state == INTERP_IDLE and s.inpos, "end", 600)
print([round(v, 3) for v in poll().actual_position[:2]], messages())
