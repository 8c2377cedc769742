# SPDX-License-Identifier: GPL-2.0-or-later
"""HAL for tests of programs that live in real time: commands, and waits for what comes (never for a time)."""
import subprocess
import time

LIMIT_S = 20


def halcmd(*words):
    return subprocess.run(["halcmd", "-s", *words], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                          text=True).stdout.strip()


def until(condition, what=""):
    """Prints `what`, if anything, once the condition holds."""
    end = time.monotonic() + LIMIT_S
    while not condition():
        if time.monotonic() > end:
            return print("never:", what or "what was waited for")
        time.sleep(0.005)
    if what:
        print(what)


def pins(pattern):
    """Name, type and direction of each pin, a line each."""
    found = [line.split() for line in halcmd("show", "pin", pattern).splitlines()]
    return "\n".join(sorted(" ".join((words[4], words[1], words[2])) for words in found))
