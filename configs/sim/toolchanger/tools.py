#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The tools of this machine live in tools.json, with the time that each has spent in the spindle.

[EMCIO]DB_PROGRAM starts this program; tooldb talks to the controller.
"""
import json
import sys
import time

from kerf import files
from tooldb import tooldb_callbacks, tooldb_loop, tooldb_tools

FILE = "tools.json"
START = {"1": {"line": "T1 P1 Z45.0 D10.0 ;10 mm end mill", "seconds": 0},
         "2": {"line": "T2 P2 Z50.5 D6.0 ;6 mm end mill", "seconds": 0},
         "3": {"line": "T3 P3 Z62.0 D5.0 ;5 mm drill", "seconds": 0}}


def read():
    """All tools; the first time those of START."""
    for name in (FILE, FILE + ".bak"):
        try:
            with open(name) as f:
                return json.load(f)
        except FileNotFoundError:
            pass
        except ValueError as error:
            print(f"tools.py: {name} is damaged: {error}", file=sys.stderr)
    return START


def write():
    """Replaces the file whole, so that a crash leaves the old one, which stays as tools.json.bak."""
    files.replace(FILE, json.dumps(tools, indent=1))


def get(number):
    """The line of one tool, as in a tool table."""
    return tools[str(number)]["line"]


def put(number, line):
    """A tool that the controller changed (G10 L1, touch-off)."""
    tools[str(number)]["line"] = line
    write()


def load(number, _line):
    """A tool goes into the spindle."""
    loaded[number] = time.monotonic()


def unload(number, _line):
    """A tool leaves the spindle: its time is added up."""
    since = loaded.pop(number, None)
    if since is not None and str(number) in tools:
        tools[str(number)]["seconds"] += round(time.monotonic() - since, 1)
        write()


tools = read()
loaded = {}
tooldb_tools([int(n) for n in tools])
tooldb_callbacks(get, put, load, unload)
tooldb_loop()
