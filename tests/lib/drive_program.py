# SPDX-License-Identifier: GPL-2.0-or-later
"""A drive program under test: its pins, and how it ends."""
import signal
import subprocess
import time

from hal_outside import halcmd, until


class DriveProgram:
    """Runs `words`; `prefix` stands before its pins."""

    def __init__(self, *words, component=None, prefix=None):
        self.component = component or words[0]
        self.prefix = (prefix or self.component) + "."
        self.process = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        until(lambda: f" {self.component} " in f" {halcmd('list', 'comp')} ", "loaded")

    def get(self, name):
        return halcmd("getp", self.prefix + name)

    def set(self, **values):
        for name, value in values.items():
            halcmd("setp", self.prefix + name.replace("_", "-"), str(value))

    def all(self, names):
        return {name: self.get(name) for name in names.split()}

    def is_true(self, name):
        return self.get(name) == "TRUE"

    def end(self, number=signal.SIGTERM):
        """Status and the lines of stderr."""
        self.process.send_signal(number)
        self.out, told = self.process.communicate(timeout=30)
        return self.process.returncode, told.splitlines()


def refusals(program, *options):
    """What it says to options that are none."""
    for words in options:
        done = subprocess.run([program, *words], capture_output=True, text=True, timeout=20)
        print(list(words), done.returncode, done.stderr.splitlines()[-1:])


def ini_file(section, **keys):
    """Writes drive.ini anew."""
    with open("drive.ini", "w") as file:
        print(f"[{section}]", *(f"{key} = {value}" for key, value in keys.items()), sep="\n", file=file)
    return "drive.ini"


def stands(drive, turns, seconds=0.2):
    """Whether the drive is not told to run, all the time: `turns(drive)`."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if turns(drive):
            return "runs"
        time.sleep(0.005)
    return "stands"


def wait(seconds):
    """For what shall not happen, or goes on meanwhile."""
    stands(None, lambda _drive: False, seconds)


def starts(program, drive, turns, what, on="spindle_on", ok="modbus-ok", rest_s=0.1):
    """The command to run comes anew, to a drive that answers."""
    program.set(**{on: 0})
    until(lambda: not turns(drive) and program.is_true(ok), "ready")
    stands(drive, turns, rest_s)
    program.set(**{on: 1})
    until(lambda: turns(drive), what)
