# SPDX-License-Identifier: GPL-2.0-or-later
import contextlib
import ctypes
import errno
import io
import os
import random
import subprocess
import sys
from pathlib import Path

from axis.mdi import MdiHistory
from axis.prefs import Preferences
from kerf import configs, files
from kerf.halscope import configfile, settings
from kerf.haltools import latency_test
from kerf.tktools import halshow, image_to_gcode, ngcfiles, tclprefs, textfiles, tooltable

SCRATCH, TOP = Path(sys.argv[1]), Path(os.environ["EMC2_HOME"])
SEED, ROUNDS = int(os.environ.get("SEED", "132")), int(os.environ.get("ROUNDS", "12"))
FAILURES = (0, errno.ENOSPC, errno.EROFS, errno.EIO)     # 0: killed
TABLE = "; mine\n" + "".join(f"T{n} P{n} D{n}.5 Z{n} ;number {n}\n" for n in range(1, 9))
INI = "[TUNING]\nP = 1\n"
failing = ctypes.CDLL(None).failing_writes
tools = ctypes.CDLL(f"{TOP}/lib/libtooldata.so")
os.chdir(SCRATCH)
tools.tool_mmap_set_fname(str(SCRATCH / "store").encode())
tools.tool_mmap_creator(None, 0)


def controller_table(path, version):
    tools.tooldata_load(bytes(path))
    tools.tooldata_save(bytes(path))


def edited_table(path, version):
    table = tooltable.Table(path)
    table.comments.append(f" {version}")
    table.save()


def parameters(path, version):
    part = path.with_name("part.ngc")
    part.write_text(f"G10 L2 P1 X{len(version)}.5\nM2\n")
    subprocess.run([TOP / "bin/rs274", "-g", "-v", path, part], stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL, check=False)


def halscope_settings(version):
    s = settings.Settings()
    s.zoom = len(version)
    return s


def halshow_settings(path, version):
    halshow.Preferences(path).save("10x10+1+1", 0.5, 100, [version], "showhal", {})


def ngcgui_program(path, version):
    program = ngcfiles.Program()
    program.text = lambda: version + "\n"
    program.write(path)


# Name: (file, what is there before, write(path, version))
WRITERS = {
    "tool table, controller": ("t.tbl", TABLE, controller_table),
    "tool table, tooledit": ("t.tbl", TABLE, edited_table),
    "parameter file": ("t.var",
                       (TOP / "configs/sim/mill/mill.var").read_text() if (TOP / "configs/sim/mill/mill.var").exists()
                       else "", parameters),
    "preferences of AXIS": ("prefs", "[DEFAULT]\nshow_tool = True\n",
                            lambda path, version: Preferences(path).putpref("name", version, str)),
    "history of MDI lines": ("history", "G0 X1\n", lambda path, version: MdiHistory(path).add(f"(msg,{version})")),
    "last configuration": ("home/.linuxcncrc", "[PICKCONFIG]\nLAST_CONFIG = /a.ini\n",
                           lambda path, version: configs.remember(f"/{version}.ini")),
    "settings of halshow": ("prefs.tcl", "set ::workmode showhal\n", halshow_settings),
    "settings of tooledit, watch lists": ("list.halshow", "pin+a\n", tclprefs.write),
    "settings of halscope": ("scope.cfg", "HZOOM 1\n",
                             lambda path, version: configfile.save(path, halscope_settings(version))),
    "settings of image-to-gcode": ("home/.image2gcoderc", "",
                                   lambda path, version: image_to_gcode.remember(image_to_gcode.remembered())),
    "greatest latency": ("latency", "1\n", lambda path, version: latency_test.keep_worst(path, len(version) * 1000)),
    "programs of ngcgui": ("auto.ngc", "(old)\n", ngcgui_program),
    "subroutines of texts": ("text.ngc", f"(info: x)\n({textfiles.MADE})\n", textfiles.write),
    "tuning, INI files": ("t.ini", INI, files.replace),
}


def child(work):
    """How a process that does the work ended."""
    sys.stdout.flush()
    pid = os.fork()
    if pid == 0:
        null = os.open(os.devnull, os.O_WRONLY)
        os.dup2(null, 1)
        os.dup2(null, 2)
        with contextlib.suppress(OSError, textfiles.Failed):
            work()
        os._exit(0)
    status = os.waitpid(pid, 0)[1]
    return "killed" if os.WIFSIGNALED(status) else status


def lay(path, text):
    path.parent.mkdir(exist_ok=True)
    for other in path.parent.glob(path.name + "*"):
        other.unlink()
    path.write_text(text)


def cuts(name):
    """Each call of the write fails in each way; (calls, what went wrong)."""
    file, text, write = WRITERS[name]
    path = SCRATCH / file
    lay(path, text)
    child(lambda: write(path, "new text"))
    whole, old, wrong = path.read_bytes(), text.encode(), []
    if not any(p.read_bytes() == old for p in path.parent.glob(path.name + ".bak")):
        wrong.append("the old one is not kept")
    for error in FAILURES:
        number = 0
        while number < 60:
            number += 1
            lay(path, text)
            os.environ["FAILING_WRITES"] = f"{path}:{number}:{error}"

            def work():
                failing(str(path).encode(), number, error)
                write(path, "new text")
                os._exit(9 if failing(b"", 0, 0) < number and name != "parameter file" else 0)
            ended = child(work)
            found = path.read_bytes() if path.exists() else None
            if found not in (old, whole):
                wrong.append((number, error, found and found[:60]))
            if error and list(path.parent.glob(path.name + ".new")):
                wrong.append((number, error, "a part is left"))
            if ended == 9 << 8 or (name == "parameter file" and number > 12):
                break
        calls = number - 1
        lay(path, text)
        path.with_name(path.name + ".new").write_text("half")     # what a power cut left
        os.environ.pop("FAILING_WRITES")
        child(lambda: write(path, "new text"))
        if path.read_bytes() != whole:
            wrong.append("the next write does not make it whole")
    return calls, wrong


def told(work):
    """What the work printed; a traceback as its last line."""
    out = io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
        try:
            work()
        except (OSError, textfiles.Failed) as e:
            print(e)
        except Exception as e:          # this is what must not be
            return f"TRACEBACK {type(e).__name__}: {e}"
    return out.getvalue()


def scope(path):
    for warning in configfile.load(path, settings.Settings(), lambda kind, name: None):
        print(f"{path}: {warning}")


# Name: read(path) tells on standard output or error what is wrong
READERS = {
    "tool table, tooledit": tooltable.Table,
    "preferences of AXIS": lambda path: Preferences(path).recent(),
    "history of MDI lines": MdiHistory,
    "settings of halshow": halshow.Preferences,
    "settings of halscope": scope,
    "settings of image-to-gcode": lambda path: image_to_gcode.remembered(),
}


def damages(whole, rng):
    yield from (whole[:n] for n in range(0, len(whole), max(1, len(whole) // 8)))
    yield from (b"", b"\0" * len(whole), whole.replace(b"\n", b"\r\n"), b"\xef\xbb\xbf" + whole,
                whole.replace(b".", b","), b"\xff\xfe\x80garbage" + whole)
    for _ in range(ROUNDS):
        bad = bytearray(whole)
        for _ in range(rng.randrange(1, 9)):
            bad[rng.randrange(len(bad))] = rng.randrange(256)
        yield bytes(bad)


def damaged(name):
    """Broken files are read; (how many, how many were told with their name, what went wrong)."""
    file, text, write = WRITERS[name]
    path, rng, wrong, named = SCRATCH / file, random.Random(f"{SEED} {name}"), [], 0
    lay(path, text)
    child(lambda: write(path, "new text"))
    whole, count = path.read_bytes(), 0
    for bad in damages(whole, rng):
        count += 1
        lay(path, "")
        path.write_bytes(bad)
        said = told(lambda: READERS[name](path))
        named += path.name in said
        if "TRACEBACK" in said:
            wrong.append((bad[:40], said))
        child(lambda: write(path, "newer text"))
        if path.name in said and not any(p.read_bytes() == bad for p in path.parent.glob(path.name + "*")):
            wrong.append((bad[:40], "is nowhere any more"))
        if b"garbage" in bad and path.name not in said:
            wrong.append((bad[:40], "is not told"))
    lay(path, "")
    path.unlink()
    path.mkdir()
    said = told(lambda: (READERS[name](path), write(path, "new text")))
    if "TRACEBACK" in said or not path.is_dir():
        wrong.append(("a folder", said))
    path.rmdir()
    return count, named, wrong


for name in WRITERS:
    calls, wrong = cuts(name)
    print(f"{name}: {'the old text or the new one' if not wrong else wrong[:3]}, calls that fail: "
          f"{'enough' if calls >= 4 else calls}")
print()
for name in READERS:
    count, named, wrong = damaged(name)
    print(f"{name}: {wrong[:3] or 'read on'}, told by name: {'often' if named > count // 4 else named}")
