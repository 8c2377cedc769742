# SPDX-License-Identifier: GPL-2.0-or-later
"""What a window remembers for a report when something in it fails. No widgets here.

A failure of a window's own code ends nothing: the operator is told, motion goes on, and the
report says what was done before. Folder: ~/.PROGRAM_reports, the newest KEPT reports.

A crash of the process itself (a library's, or a kill) leaves the file that watch_crashes() keeps:
events, then the stack of each thread. The next start makes a report of it.
"""

import collections
import faulthandler
import fcntl
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
        self.file, self.lines = None, 0      # of watch_crashes()

    def note(self, *what):
        self.events.append((time.time(), what))
        if self.file is not None:
            self.lines += 1
            if self.lines > 2 * EVENTS:
                self.begin_file()
            else:
                self.add_line(self.line(*self.events[-1]))

    @staticmethod
    def line(at, what):
        return f"{time.strftime('%H:%M:%S', time.localtime(at))}.{int(at % 1 * 1000):03d} {' '.join(map(str, what))}"

    def new_report(self, at):
        """A name that no report has yet."""
        stem, more = time.strftime("report-%Y%m%d-%H%M%S", time.localtime(at)), ""
        while (path := self.folder / f"{stem}{more}.txt").exists():
            more = f"-{int(more[1:] or 1) + 1}"
        return path

    def header(self):
        return [f"{self.program} {self.version}", time.strftime("%Y-%m-%d %H:%M:%S"), f"configuration {self.ini_path}",
                f"sha256 {self.config_hash()}", ""]

    # -- crashes of the process ------------------------------------------------------------

    def watch_crashes(self):
        """Keeps the events in a file from now on. Returns the reports of former runs that ended without close()."""
        found = []
        try:
            self.folder.mkdir(exist_ok=True)
            for left in sorted(self.folder.glob("running-*")):
                with open(left) as f:
                    try:
                        fcntl.flock(f, fcntl.LOCK_EX | fcntl.LOCK_NB)        # of one that runs it is taken
                    except BlockingIOError:
                        continue
                    report = self.new_report(left.stat().st_mtime)
                    os.replace(left, report)
                    found.append(report)
            self.file = open(self.folder / f"running-{os.getpid()}", "w", buffering=1)
            fcntl.flock(self.file, fcntl.LOCK_EX)
            self.begin_file()
            faulthandler.enable(self.file)
        except OSError as e:
            print(f"{self.program}: a crash would leave no report: {e}", file=sys.stderr)
        return found

    def begin_file(self):
        try:
            self.file.seek(0)
            self.file.truncate()
        except OSError:
            pass
        self.lines = len(self.events)
        for text in (*self.header(), "events, then what crashed:", *(self.line(*e) for e in self.events)):
            self.add_line(text)

    def add_line(self, text):
        try:
            self.file.write(text.replace("\n", " ") + "\n")
        except OSError:              # the disk is full: the screen goes on
            pass

    def fell(self, trace):
        """The program ends by an exception: its traceback takes the place of the stack in what
        watch_crashes() keeps."""
        if self.file is not None:
            for text in trace.splitlines():
                self.add_line(text)

    def close(self):
        """The program ends as it should: no report is wanted."""
        if self.file is not None:
            faulthandler.disable()
            Path(self.file.name).unlink(missing_ok=True)
            self.file.close()
            self.file = None

    # -- faults of the program's code ------------------------------------------------------

    def config_hash(self):
        try:
            return hashlib.sha256(Path(self.ini_path).read_bytes()).hexdigest()
        except OSError as e:
            return str(e)

    def write(self, trace):
        """Path of the report, or None where none can be written."""
        lines = [*self.header(), trace.rstrip(), "", f"the last {len(self.events)} events:",
                 *(self.line(*e) for e in self.events)]
        path = self.new_report(time.time())
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
