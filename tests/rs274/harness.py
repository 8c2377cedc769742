# SPDX-License-Identifier: GPL-2.0-or-later
"""Helpers of the interpreter's tests: run rs274 on a text, look at the calls."""
import os
import re
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "lib", "python"))
HERE = os.path.dirname(os.path.abspath(__file__))
CALL = re.compile(r"^(?:READ => )* *\d+ N\S* *([A-Z_0-9.]+)\((.*)\)$")


class Run:
    """What one run of rs274 printed."""

    def __init__(self, out: str, err: str, status: int):
        self.out, self.err, self.status = out, err, status
        self.lines = out.split("\n")

    @property
    def calls(self):
        """(name, [arguments]) in order; numbers as float."""
        found = []
        for line in self.lines:
            m = CALL.match(line)
            if not m:
                continue
            words = [w for w in re.split(r",\s*|\s+", m.group(2)) if w]
            found.append((m.group(1), [float(w) if re.fullmatch(r"-?[\d.]+", w) else w for w in words]))
        return found

    def moves(self, kinds=("STRAIGHT_TRAVERSE", "STRAIGHT_FEED", "ARC_FEED")):
        return [(name, a) for name, a in self.calls if name in kinds]

    @property
    def printed(self):
        """Lines of (print,...)."""
        return [l for l in self.lines if l and not re.match(r"^ *\d+ N", l)]

    @property
    def error(self):
        """First line of the error report, or ''."""
        lines = [l for l in self.err.split("\n") if l != "executing" and "updating variable file" not in l]
        return lines[0] if lines else ""


def rs274(program: str, *options: str, files=None, ini: str = "", tools: str = "", var: str = "", keep=None) -> Run:
    """Runs a program's text. files: name -> text of further files; keep(folder) is called before it goes."""
    with tempfile.TemporaryDirectory() as d:
        def write(name, text):
            path = os.path.join(d, name)
            os.makedirs(os.path.dirname(path), exist_ok=True)
            with open(path, "w") as f:
                f.write(text)
        write("t.ngc", program)
        for name, text in (files or {}).items():
            write(name, text)
        if tools:
            write("tool.tbl", tools)
        else:
            shutil.copy(os.path.join(HERE, "golden.tbl"), d + "/tool.tbl")
        if var:
            write("p.var", var)
        command = ["rs274", "-t", "tool.tbl", "-v", "p.var", "-g", *options]
        if ini:
            write("t.ini", ini)
            command += ["-i", "t.ini"]
        environment = dict(os.environ, HOME=d)
        environment.pop("INI_FILE_NAME", None)
        r = subprocess.run([*command, "t.ngc"], cwd=d, capture_output=True, timeout=60, env=environment,
                           stdin=subprocess.DEVNULL, text=True, errors="replace")
        if keep:
            keep(d)
        return Run(r.stdout, r.stderr, r.returncode)


def check(what: bool, message) -> None:
    """Ends the test when a promise is not kept."""
    if not what:
        frame = sys._getframe(1)
        sys.exit(f"line {frame.f_lineno}: {message}")


def near(a, b, eps=1e-4) -> bool:
    return len(a) == len(b) and all(abs(x - y) <= eps for x, y in zip(a, b))


def done() -> None:
    print("ok")
