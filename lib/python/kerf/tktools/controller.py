# SPDX-License-Identifier: GPL-2.0-or-later
"""The controller that a small window belongs to."""

import os
import sys

import linuxcnc


def use_ini(arguments):
    """-ini FILE: its NML file, when it names one."""
    if "-ini" in arguments[:-1]:
        nml = linuxcnc.ini(arguments[arguments.index("-ini") + 1]).find("EMC", "NML_FILE")
        if nml:
            linuxcnc.nmlfile = nml


def status(program, arguments=()):
    """The status channel, read once. Without a controller: says so, exit status 1."""
    try:
        use_ini(list(arguments))
    except linuxcnc.error as error:
        sys.exit(f"{program}: {error}")
    stat = linuxcnc.stat()
    try:
        stat.poll()
    except linuxcnc.error as error:
        sys.exit(f"{program}: {error}: no controller is running")
    return stat


def ini_name(stat):
    """The running machine's INI file, else that of the environment, else None."""
    return stat.ini_filename or os.environ.get("INI_FILE_NAME") or None
