# SPDX-License-Identifier: GPL-2.0-or-later
"""Loads a machine's HAL files without starting it, and tells what fails: linuxcnc_check_ini -n."""

import os
import re
import subprocess
import tempfile
from pathlib import Path

from .runner import copy_folder
from .tree import Tree

LOAD_S = 120          # of wall time, for everything to load


def load_hal(path):
    """Texts of the errors of all HAL files of an INI file; empty when they load.

    The files run in a copy of the folder, in an instance of its own and in virtual time, so that a
    running machine is not touched. Threads are not started: no function of a driver is called.
    """
    path = Path(path).resolve()
    with tempfile.TemporaryDirectory(prefix="check-ini-") as scratch:
        folder = copy_folder(path.parent, scratch)
        env = Tree.find().environment() | {"KERF_INSTANCE": f"check{os.getpid()}", "KERF_CLOCK": "virtual"}
        env.pop("KERF_CLOCK_SLOT", None)
        try:
            done = subprocess.run(["linuxcnc", "-r", "-k", "-n", str(folder / path.name)], env=env, timeout=LOAD_S,
                                  stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                  stderr=subprocess.PIPE, text=True)
        except subprocess.TimeoutExpired:
            return [f"the HAL files did not load within {LOAD_S} s"]
    if done.returncode == 0:
        return []
    return errors_of(done.stderr.replace(str(folder), str(path.parent))) or ["the HAL files do not load"]


def errors_of(text):
    """Errors in the output of the programs: each with file and line, where a program said them."""
    errors, first = [], None
    for line in text.splitlines():
        tcl = re.match(r'\s+\(file "(.+)" line (\d+)\)', line)
        if re.match(r"\S+:\d+: ", line):
            errors.append(line)
            first = None
        elif tcl and tcl[1].endswith("haltcl"):
            first = None                        # the end of a trace of Tcl
        elif tcl and first:                     # its innermost file; the message stood before
            errors.append(f"{tcl[1]}:{tcl[2]}: {first}")
            first = ""
        elif first is None and line and line[0] not in ' "' and not line.startswith("Note: "):
            first = line
        if re.match(r"CANNOT |INI file |.*cannot load", line):
            errors.append(line)
    return errors or ([first] if first else [])
