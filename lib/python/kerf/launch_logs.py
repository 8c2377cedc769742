# SPDX-License-Identifier: GPL-2.0-or-later
"""Where the launcher's words go: to logs when there is no terminal, and nowhere when their reader has gone."""

import contextlib
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from . import instance
from .tree import Tree


class Logs:
    """Temporary logs when standard input is no terminal; kept in HOME after an error."""

    SENT = {"print": "(print information was sent to stdout)", "debug": "(debug information was sent to stderr)"}

    def __init__(self, options):
        self.quiet = options.test_mode
        self.active = not os.isatty(0) and not self.quiet
        self.files = {}
        if not self.active:
            return
        for kind, stream in (("print", 1), ("debug", 2)):
            fd, path = tempfile.mkstemp(prefix=f"linuxcnc.{kind}.")
            self.files[kind] = path
            self.tee(fd, stream)

    @staticmethod
    def tee(fd, stream):
        sys.stdout.flush()
        os.dup2(fd, stream)
        os.close(fd)

    def keep(self, kind):
        """The name of the log that is kept."""
        try:
            target = instance.suffixed(str(Path.home() / f"linuxcnc_{kind}.txt"))
            if self.active:
                shutil.copyfile(self.files[kind], target)
            else:
                Path(target).write_text(self.SENT[kind] + "\n")
            return target
        except (OSError, RuntimeError):     # there is no home, or nothing can be written in it
            return self.files.get(kind, self.SENT[kind])

    def show(self, died, *texts):
        """A window of its own process: the screen is gone."""
        if os.environ.get("DISPLAY") and not self.quiet:
            subprocess.Popen([sys.executable, "-m", "kerf.launch_windows", "errors", died, *texts],
                             stdin=subprocess.DEVNULL, env=dict(os.environ, PYTHONPATH=str(Tree.find().python)),
                             stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)

    def finish(self, status, terminal, died):
        """died: the part of the machine that ended and must not; the operator is told also without logs."""
        if not self.active and died:
            self.show(died)
        if self.quiet:
            return
        sys.stdout.flush()
        sys.stderr.flush()
        texts = []
        if status:
            texts = [self.keep(kind) for kind in self.SENT]
            if self.active:
                with open(self.files["debug"], "rb") as f:
                    os.write(terminal, f.read()[-4000:])
                self.show(died, *texts)
            os.write(terminal, (
                "LinuxCNC terminated with an error.  You can find more information in the log:\n"
                f"    {texts[1]}\nand\n    {texts[0]}\n"
                "as well as in the output of the shell command 'dmesg' and in the terminal\n").encode())
        for path in self.files.values():
            if path not in texts:
                with contextlib.suppress(OSError):
                    os.unlink(path)


class Lossy:
    """A text stream whose reader may go away: what can't be written is lost, and nothing else happens."""

    def __init__(self, stream):
        self.stream = stream

    def write(self, text):
        try:
            return self.stream.write(text)
        except OSError:
            return len(text)

    def flush(self):
        try:
            self.stream.flush()
        except OSError:
            pass

    def __getattr__(self, name):
        return getattr(self.stream, name)
