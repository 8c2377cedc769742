# SPDX-License-Identifier: GPL-2.0-or-later
"""What the realtime script knows: is this machine fit for realtime, does the host run?

Every function runs the script (environment variable REALTIME, else the one of this
installation) and waits for it. An exit status other than 0 and 1 is a RuntimeError; only then
what the script wrote to standard error, its advice, is passed on.
"""

import os
import subprocess
import sys
from pathlib import Path


def _script():
    here = Path(__file__).resolve().parent
    places = [here.parent.parent / "scripts/realtime",            # TOP/lib/python
              here.parent.parent / "linuxcnc/realtime",           # PREFIX/lib/python3/dist-packages
              Path("/usr/lib/linuxcnc/realtime")]
    for place in places:
        if place.is_file():
            return str(place)
    return os.environ.get("REALTIME", "realtime")


def _run(command):
    args = [_script(), command]
    done = subprocess.run(args, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          text=True)
    if done.returncode not in (0, 1):
        sys.stderr.write(done.stderr)
        raise RuntimeError(f'cmd "{" ".join(args)}" failed with status {done.returncode}')
    return done.returncode == 0, done.stdout.rstrip()


def verify() -> bool:
    """True when threads of the host would be scheduled in real time."""
    return _run("verify")[0]


def verify_info() -> "tuple[bool, str]":
    """verify() and the name of the realtime type, "No realtime" when there is none."""
    return _run("verify")


def status() -> bool:
    """True when the realtime host of this instance runs (in real time or not)."""
    return _run("status")[0]
