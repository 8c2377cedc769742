# SPDX-License-Identifier: GPL-2.0-or-later
"""What a window remembers for a report when something in it fails. No widgets here.

A failure of a window's own code ends nothing: the operator is told, motion goes on, and the
report says what was done before. Folder: ~/.PROGRAM_reports, the newest KEPT reports.
"""

import collections
import hashlib
import os
import sys
import time
from pathlib import Path

EVENTS, KEPT = 1000, 20


class Recorder:
    """note() is cheap; write() makes a file of it."""

    def __init__(self, program, ini_path, version):
        self.program, self.ini_path, self.version = program, ini_path, version
        self.events = collections.deque(maxlen=EVENTS)
        self.folder = Path.home() / f".{program}_reports"

    def note(self, *what):
        self.events.append((time.time(), what))

    def config_hash(self):
        try:
            return hashlib.sha256(Path(self.ini_path).read_bytes()).hexdigest()
        except OSError as e:
            return str(e)

    def write(self, trace):
        """Path of the report, or None where none can be written."""
        lines = [f"{self.program} {self.version}", time.strftime("%Y-%m-%d %H:%M:%S"), f"configuration {self.ini_path}", f"sha256 {self.config_hash()}", "",
                 trace.rstrip(), "", f"the last {len(self.events)} events:"]
        lines += [f"{time.strftime('%H:%M:%S', time.localtime(at))}.{int(at % 1 * 1000):03d} {' '.join(map(str, what))}" for at, what in self.events]
        path = self.folder / time.strftime("report-%Y%m%d-%H%M%S.txt")
        try:
            self.folder.mkdir(exist_ok=True)
            with open(path, "w") as f:
                f.write("\n".join(lines) + "\n")
            for old in sorted(self.folder.glob("report-*.txt"))[:-KEPT]:
                os.unlink(old)
        except OSError as e:
            print(f"{self.program}: no report is written: {e}", file=sys.stderr)
            return None
        return path
