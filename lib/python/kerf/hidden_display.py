# SPDX-License-Identifier: GPL-2.0-or-later
"""A display that nobody sees, for panels whose pins a machine without a screen needs."""

import ctypes
import os
import shutil
import signal
import subprocess

PR_SET_PDEATHSIG = 1


def need_display():
    """True when DISPLAY is set, or could be set to a server started for this process (Xvfb); it ends with us."""
    if os.environ.get("DISPLAY"):
        return True
    if not shutil.which("Xvfb"):
        return False
    reading, writing = os.pipe()
    libc = ctypes.CDLL(None)
    subprocess.Popen(["Xvfb", "-displayfd", str(writing), "-screen", "0", "1024x768x24", "-nolisten", "tcp", "-noreset"], pass_fds=[writing],
                     stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                     preexec_fn=lambda: libc.prctl(PR_SET_PDEATHSIG, signal.SIGTERM, 0, 0, 0))
    os.close(writing)
    with os.fdopen(reading) as pipe:
        number = pipe.readline().strip()
    if number:
        os.environ["DISPLAY"] = f":{number}"
    return bool(number)
