#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Compare rs274 with recorded runs.

usage: compare.py [-v] [-j N] TOOLTABLE CASE...

A CASE is NAME.ngc with NAME.canon (standard output) and perhaps NAME.err (exit status on
the first line, then standard error without "executing" and the note on the parameter
file), or a folder of them, or a .tar with such files. Each runs in an empty folder as
`rs274 -t tool.tbl -v new.var -g NAME.ngc`. Lines must be equal, but a number may differ by
one unit in its last printed digit. Exit status 1 when a case differs.
"""
import argparse
import concurrent.futures
import os
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile

NUMBER = re.compile(r"-?\d+\.\d+")


def same_line(ours: str, theirs: str) -> bool:
    if ours == theirs:
        return True
    if NUMBER.sub("#", ours) != NUMBER.sub("#", theirs):
        return False
    for a, b in zip(NUMBER.findall(ours), NUMBER.findall(theirs)):
        if a == b:
            continue
        places = len(b.split(".")[1])
        if len(a.split(".")[1]) != places or abs(float(a) - float(b)) > 1.0001 * 10 ** -places:
            return False
    return True


def first_difference(ours: list[str], theirs: list[str]):
    for i in range(max(len(ours), len(theirs))):
        a = ours[i] if i < len(ours) else "(nothing)"
        b = theirs[i] if i < len(theirs) else "(nothing)"
        if not same_line(a, b):
            return i, a, b
    return None


# The recorded interpreter wrote notes of its own splines to standard output; they are no calls.
def canon_lines(text: str) -> list[str]:
    return [l for l in text.split("\n") if not re.match(r"(mode == G_|X +-?[\d.]+, )", l)]


def error_lines(text: str) -> list[str]:
    keep = [l for l in text.split("\n") if l != "executing" and "updating variable file" not in l]
    while keep and not keep[-1]:
        keep.pop()
    return keep


def run_case(rs274: str, table: str, base: str, sanitize: bool):
    name = os.path.basename(base)
    with tempfile.TemporaryDirectory() as scratch:
        shutil.copy(table, scratch + "/tool.tbl")
        shutil.copy(base + ".ngc", scratch)
        environment = dict(os.environ, HOME=scratch)
        environment.pop("INI_FILE_NAME", None)
        try:
            run = subprocess.run([rs274, "-t", "tool.tbl", "-v", "new.var", "-g", name + ".ngc"], cwd=scratch,
                                 capture_output=True, timeout=60, env=environment, stdin=subprocess.DEVNULL)
        except subprocess.TimeoutExpired:
            return "does not end"
    if sanitize or run.returncode < 0:
        if run.returncode < 0 or b"Sanitizer" in run.stderr or b"runtime error" in run.stderr:
            return "crash: " + run.stderr.decode("utf-8", "replace")[:2000]
    ours = canon_lines(run.stdout.decode("latin-1"))
    with open(base + ".canon", encoding="latin-1") as f:
        theirs = canon_lines(f.read())
    difference = first_difference(ours, theirs)
    if difference:
        i, a, b = difference
        return f"line {i + 1}:\n    ours   {a}\n    theirs {b}"
    if os.path.exists(base + ".err"):
        with open(base + ".err", encoding="latin-1") as f:
            status, *expected = f.read().split("\n")
        while expected and not expected[-1]:
            expected.pop()
        got = error_lines(run.stderr.decode("latin-1"))
        if run.returncode != int(status):
            return f"exit status {run.returncode}, not {status}: {got}"
        difference = first_difference(got, expected)
        if difference:
            return f"standard error:\n    ours   {difference[1]}\n    theirs {difference[2]}"
    return None


def cases_of(arguments, unpacked):
    for a in arguments:
        if a.endswith(".tar") or ".tar." in a:
            folder = tempfile.mkdtemp(dir=unpacked)
            with tarfile.open(a) as t:
                t.extractall(folder)
            a = folder
        if os.path.isdir(a):
            yield from (os.path.join(a, f[:-4]) for f in sorted(os.listdir(a)) if f.endswith(".ngc"))
        else:
            yield a[:-4] if a.endswith(".ngc") else a


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("-v", action="store_true", help="print every difference")
    parser.add_argument("-j", type=int, default=2)
    parser.add_argument("--sanitize", action="store_true", help="look for sanitizer reports")
    parser.add_argument("table")
    parser.add_argument("case", nargs="+")
    o = parser.parse_args()
    rs274 = shutil.which("rs274")
    if not rs274:
        sys.exit("rs274 is not in PATH")
    bad = []
    with tempfile.TemporaryDirectory() as unpacked:
        bases = [b for b in cases_of(o.case, unpacked) if os.path.exists(b + ".canon")]
        with concurrent.futures.ThreadPoolExecutor(o.j) as pool:
            results = pool.map(lambda b: run_case(rs274, o.table, b, o.sanitize), bases)
            for base, problem in zip(bases, results):
                if problem:
                    bad.append(base)
                    if o.v or len(bad) <= 5:
                        print(f"{os.path.basename(base)}: {problem}")
    print(f"{len(bases) - len(bad)} of {len(bases)} equal")
    return 1 if bad or not bases else 0


if __name__ == "__main__":
    sys.exit(main())
