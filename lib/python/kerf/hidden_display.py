# SPDX-License-Identifier: GPL-2.0-or-later
"""A display that nobody sees, for panels whose pins a machine without a screen needs."""

import os
import shutil
import subprocess

from .process import end_with_parent


def need_display():
    """True when DISPLAY is set, or could be set to a server started for this process (Xvfb); it ends with us."""
    if os.environ.get("DISPLAY"):
        return True
    if not shutil.which("Xvfb"):
        return False
    reading, writing = os.pipe()
    subprocess.Popen(["Xvfb", "-displayfd", str(writing), "-screen", "0", "1024x768x24", "-nolisten", "tcp",
                      "-noreset"], pass_fds=[writing],
                     stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                     preexec_fn=end_with_parent)
    os.close(writing)
    with os.fdopen(reading) as pipe:
        number = pipe.readline().strip()
    if number:
        os.environ["DISPLAY"] = f":{number}"
    return bool(number)
