# SPDX-License-Identifier: GPL-2.0-or-later
"""What a screen leaves for the one that comes after it has crashed, and how often another one comes. No widgets here.

A screen that can take up a living session keeps a record: a file that the launcher names in the environment. It
removes the file when it ends as it should; a screen that ended while its record is there has crashed, and the launcher
starts it again. The new one finds the record, and in the environment how the one before ended.
"""

import contextlib
import json
import os
import shutil
import signal
import sys
import tempfile
import time

VARIABLE, CRASH = "KERF_SCREEN_RECORD", "KERF_SCREEN_CRASH"       # path of the record; how the screen before ended
ON_REQUEST = {-signal.SIGINT, -signal.SIGTERM, -signal.SIGHUP, -signal.SIGQUIT}     # of somebody who wants the end
MOST, WITHIN_S = 3, 60.0     # so many crashes within this time are too many
FAULTS = ("SIGSEGV", "SIGBUS", "SIGABRT", "SIGILL", "SIGFPE")     # of a library, a driver of graphics most likely
RETRY_S = 5.0                # while a program runs on without a screen


class Record:
    """The screen's side. `former`: what the one before left, None in a new session."""

    def __init__(self):
        self.path = os.environ.pop(VARIABLE, None)     # not for programs that the screen starts
        self.crash = os.environ.pop(CRASH, None)
        self.former, self.saved = None, None
        if self.path and self.crash is not None:
            try:
                with open(self.path) as f:
                    self.former = json.load(f)
            except (OSError, ValueError):
                self.former = {}

    def by_fault(self):
        """How the one before ended, where that was a fault of a library; else ""."""
        return self.crash if self.crash and any(name in self.crash for name in FAULTS) else ""

    def save(self, **what):
        """From now on a crash is one that the machine outlives."""
        what["pid"] = os.getpid()
        if not self.path or what == self.saved:
            return
        try:
            with tempfile.NamedTemporaryFile("w", dir=os.path.dirname(self.path), prefix=os.path.basename(self.path),
                                             delete=False) as f:
                json.dump(what, f)
            os.replace(f.name, self.path)
            self.saved = what
        except OSError as e:         # the screen goes on; told once
            print(f"the screen could not be started again after a crash: {e}", file=sys.stderr)
            self.path = None

    def remove(self):
        """An end as it should be."""
        if self.path:
            with contextlib.suppress(FileNotFoundError):
                os.unlink(self.path)
            self.path = None


class Restarts:
    """The launcher's side."""

    def __init__(self, path):
        self.path, self.crashes = path, []

    def crashed(self, returncode, pid):
        """Did the process of the display end so that another one shall come? A script that
        runs a screen is no screen."""
        if returncode == 0 or returncode in ON_REQUEST or not os.path.exists(self.path):
            return False
        return bool(self.crashes) or self.left().get("pid") == pid

    def too_many(self):
        """To be called at each crash."""
        now = time.monotonic()
        self.crashes = [at for at in self.crashes if now - at < WITHIN_S] + [now]
        return len(self.crashes) >= MOST

    def left(self):
        """The record of the screen that crashed: "parts", ids of the processes that show something inside it;
        "folder", its temporary files."""
        try:
            with open(self.path) as f:
                return json.load(f)
        except (OSError, ValueError):
            return {}

    def remove(self):
        """With what a crashed screen left."""
        folder = self.left().get("folder")
        if folder:
            shutil.rmtree(folder, ignore_errors=True)
        with contextlib.suppress(OSError):
            os.unlink(self.path)
