# SPDX-License-Identifier: GPL-2.0-or-later
"""failures.py GROUP [WORD ...]: starts the sample mill with one thing wrong at a time; prints what the user is told
and what is left."""
import os
import re
import shutil
import socket
import subprocess
import sys
from pathlib import Path

from kerf import instance

TOP = Path(os.environ["EMC2_HOME"])
LINUXCNC = shutil.which("linuxcnc")
SUFFIX = "." + (instance.name() or "none")
PORT = 21000 + os.getpid() % 9000
# What a good start says, too; and the list of logs that ends every failed one.
USUAL = re.compile(r"LINUXCNC - |Machine configuration |Starting LinuxCNC|linuxcnc TPMOD=|Found file|Shutting "
                   r"down|task: \d+ cycles|Running HAL shutdown|"
                   r"LinuxCNC terminated|Note: Using virtual time|    .*\.txt$|and$|as well as|$")
CASES = []  # (group, title, file, (pattern, replacement) ..., preparation, environment, words before the command)
GROUP = "settings"


def case(title, *edits, prepare=None, file="mill.ini", env={}, before=()):
    """env: what differs in the environment, None: not set. prepare: may return a port that is
    busy while the machine starts."""
    CASES.append((GROUP, title, file, edits, prepare, env, before))


def put(name, text, mode=0o644):
    def write():
        Path(name).write_text(text)
        Path(name).chmod(mode)
    return write


def busy(number):
    """A server that is no machine's at a port of the documented number, and the port of this instance for it."""
    def listen():
        return [socket.create_server(("127.0.0.1", p)) for p in number]
    return listen


HAL = r"\A"  # in front of a HAL file
case("no INI file", prepare=lambda: Path("mill.ini").unlink())
case("a folder instead of the INI file", prepare=lambda: (Path("mill.ini").unlink(), Path("mill.ini").mkdir()))
case("an empty INI file", (r"(?s).*", ""))
case("a line that is no setting", (r"JOINTS = 3", "JOINTS 3"))
case("an include that is not there", (r"\[KINS\]", "#INCLUDE more.inc\n[KINS]"))
case("no [KINS]JOINTS", (r"JOINTS = 3\n", ""))
case("too many joints", (r"JOINTS = 3", "JOINTS = 30"))
case("fewer joints than coordinates", (r"JOINTS = 3", "JOINTS = 2"))
case("numeric units", (r"LINEAR_UNITS = mm", "LINEAR_UNITS = 1"))
case("no angular units", (r"ANGULAR_UNITS.*\n", ""))
case("nine spindles", (r"\[TRAJ\]", "[TRAJ]\nSPINDLES = 9"))
case("a joint smaller than its axis", (r"(\[JOINT_0\](?:.*\n)*?MAX_LIMIT = ).*", r"\g<1>3"))
case("a version of the future", (r"VERSION = 1.1", "VERSION = 7"))
case("no version", (r"VERSION = 1.1\n", ""))
# --- programs
GROUP = "programs"
case("no such task", (r"TASK = milltask", "TASK = notask"))
case("no [DISPLAY]DISPLAY", (r"DISPLAY = .*\n", ""))
case("no such display", (r"DISPLAY = .*", "DISPLAY = noscreen"))
case("a display that stands beside the INI file", (r"DISPLAY = .*", "DISPLAY = screen"),
     prepare=put("screen", "#!/bin/sh\n", 0o755))
case("a display that is not executable", (r"DISPLAY = .*", "DISPLAY = ./screen"), prepare=put("screen", "#!/bin/sh\n"))
case("a display of an interpreter that is not there", (r"DISPLAY = .*", "DISPLAY = ./screen"),
     prepare=put("screen", "#!/usr/bin/nopython\n", 0o755))
case("a display that fails", (r"DISPLAY = .*", "DISPLAY = ./screen"),
     prepare=put("screen", "#!/bin/sh\necho no X display >&2\nexit 3\n", 0o755))
case("no such halui", (r"HALUI = halui", "HALUI = nohalui"))
case("no such bridge", (r"HALUI = halui", "HALBRIDGE = nobridge"))
case("a task that ends", (r"TASK = milltask", "TASK = ./mytask"), prepare=put("mytask", "#!/bin/sh\nexit 1\n", 0o755))
case("no such planner", (r"\[TRAJ\]", "[TRAJ]\nTPMOD = notp"))
# --- HAL
GROUP = "hal"
case("no such HAL file", (r"HALFILE = mill.hal", "HALFILE = nowhere.hal"))
case("no such library file", (r"HALFILE = mill.hal", "HALFILE = LIB:nowhere.tcl"))
case("no such motion module", (r"EMCMOT = motmod", "EMCMOT = nomod"))
case("no such kinematics", (r"KINEMATICS = trivkins", "KINEMATICS = nokins"))
case("kinematics with a bad parameter", (r"KINEMATICS = .*", "KINEMATICS = trivkins coordinates=XYQ"))
case("no such component", (HAL, "loadrt nocomp\n"), file="spindle.hal")
case("no such command", (HAL, "\nlodrt and2\n"), file="spindle.hal")
case("no such pin", (HAL, "# one\n\nnet x joint.0.motor-pos-comand\n"), file="spindle.hal")
case("a pin of another type", (HAL, "net x joint.0.motor-pos-cmd\nnet x motion.probe-input\n"), file="spindle.hal")
case("two writers", (HAL, "net x spindle.0.on\nnet x motion.motion-enabled\n"), file="spindle.hal")
case("no such function", (HAL, "addf nothing.0 servo-thread\n"), file="spindle.hal")
case("no such thread", (HAL, "loadrt and2\naddf and2.0 base-thread\n"), file="spindle.hal")
case("a setting that is not there", (HAL, "setp motion.probe-input [PROBE]INVERTED\n"), file="spindle.hal")
case("a program that is not there", (HAL, "loadusr -W noprogram\n"), file="spindle.hal")
case("a program that ends before it is ready", (HAL, "loadusr -W false\n"), file="spindle.hal")
case("a Tcl file with an error", (r"HALFILE = mill.hal", "HALFILE = mill.hal\nHALFILE = more.tcl"),
     prepare=put("more.tcl", "\nnet x [nothing]\n"))
case("a Tcl file with a pin that is not there", (r"HALFILE = mill.hal", "HALFILE = mill.hal\nHALFILE = more.tcl"),
     prepare=put("more.tcl", "# one\nnet x joint.7.homed\n"))
case("a HALCMD that fails", (r"\[HAL\]", "[HAL]\nHALCMD = net x nopin"))
case("two passes and a missing file", (r"\[HAL\]", "[HAL]\nTWOPASS = on\nHALFILE = nowhere.hal"))
case("two passes and a pin that is not there", (r"\[HAL\]", "[HAL]\nTWOPASS = on"),
     (r"(HALFILE = spindle.hal)", r"\1\nHALFILE = more.hal"),
     prepare=put("more.hal", "# one\nnet x joint.7.homed\n"))
case("a card that is not there", (HAL, "loadrt hal_motenc\n"), file="spindle.hal")
# --- files of the interpreter and of task
GROUP = "files"
case("no such tool table", (r"TOOL_TABLE = .*", "TOOL_TABLE = none.tbl"))
case("no [RS274NGC]PARAMETER_FILE", (r"PARAMETER_FILE.*\n", ""))
case("a parameter file out of order", prepare=put("mill.var", "5220\t1\n5161\t0\n"))
case("a parameter file that is a folder",
     prepare=lambda: (Path("mill.var").unlink(missing_ok=True), Path("mill.var").mkdir()))
case("a remap without its file", (r"\[RS274NGC\]", "[RS274NGC]\nREMAP = M400 modalgroup=10 ngc=nowhere"))
case("a remap with a bad option", (r"\[RS274NGC\]", "[RS274NGC]\nREMAP = M400 modalgroop=10 ngc=nowhere"))
case("Python that does not load", (r"\[RS274NGC\]", "[PYTHON]\nTOPLEVEL = top.py\n[RS274NGC]"),
     prepare=put("top.py", "import nothing_of_this_name\n"))
case("a compensation file that is not there", (r"\[JOINT_0\]", "[JOINT_0]\nCOMP_FILE = none.comp"))
case("a HOME that is no number", (r"\[TRAJ\]", "[TRAJ]\nHOME = 0 zero"))
case("a tool change position of two numbers", (r"\[EMCIO\]", "[EMCIO]\nTOOL_CHANGE_POSITION = 1 2"))
case("a tool database that is not there", (r"TOOL_TABLE = .*", "DB_PROGRAM = ./nodb"))

# --- what is around the machine
GROUP = "around"
case("no display for the screen", (r"DISPLAY = .*", "DISPLAY = axis"))
case("a display that can't be opened", (r"DISPLAY = .*", "DISPLAY = axis"), env={"DISPLAY": ":7777"})
case("a display of Tk that can't be opened", (r"DISPLAY = .*", "DISPLAY = tklinuxcnc"), env={"DISPLAY": ":7777"})
case("no LCD server", (r"DISPLAY = .*", "DISPLAY = linuxcnclcd -p 7"))
case("a port that another program has", (r"DISPLAY = .*", f"DISPLAY = linuxcncrsh --port {PORT}"), prepare=busy([PORT]))
case("a port of the server that another program has", prepare=busy([instance.port(5005)]))
case("no room for files", env={"PYTHONDONTWRITEBYTECODE": "1"}, before=("bash", "-c", 'ulimit -f 0; exec "$@"', "bash"))
case("no home", env={"HOME": None})
case("a home that is not there", env={"HOME": "/nonexistent"})
case("a blank and a letter beyond ASCII in the path", prepare=lambda: shutil.copytree(".", "a b/ü"),
     before=("env", "-C", "a b/ü"))
case("a path of programs without ours",
     env={"PATH": "/usr/bin:/bin", "LINUXCNC_RIP_FLAG": None, "LD_LIBRARY_PATH": None, "PYTHONPATH": None})
case("a language with a comma", before=(TOP / "tests/lib/with-comma-locale",))
case("applications of all kinds",
     (r"\Z", "[APPLICATIONS]\nDELAY = soon\nAPP = none\nAPP = sh -c 'echo here\nAPP = ./mill.hal\n"))
case("a HALCMD with a quotation mark", (r"\[HAL\]", "[HAL]\nHALCMD = show sig 'x"))
case("a HAL file that sources what is not there", (HAL, "loadrt and2\nsource one.hal\n"), file="spindle.hal")
case("a mistake two sources deep", (HAL, "loadrt and2\nsource one.hal\n"), file="spindle.hal",
     prepare=lambda: (put("one.hal", "\n\nsource two.hal\n")(), put("two.hal", "net a\nnet a and2.0.none\n")()))
case("a HAL file that is no text", (HAL, "\0\1\n"), file="spindle.hal")
case("a mistake two Tcl files deep", (r"HALFILE = mill.hal", "HALFILE = mill.hal\nHALFILE = more.tcl"),
     prepare=lambda: (put("more.tcl", "proc deep {} {\n  source inner.tcl\n}\ndeep\n")(),
                      put("inner.tcl", "\nsetp nothing.at.all 5\n")()))
case("a host that dies while the machine is started",
     (r"(HALFILE = spindle.hal)", r"\1\nHALCMD = loadusr -w ./kill-host"),
     prepare=put("kill-host", "#!/bin/sh\nfor p in $(pgrep -x rtapi_app); do grep -qszx "
                              "LINUXCNC_SESSION=$LINUXCNC_SESSION /proc/$p/environ && kill -9 $p; done; true\n", 0o755))
case("a HAL file for shutdown with a mistake", (r"\[HAL\]", "[HAL]\nSHUTDOWN = down.hal"),
     prepare=put("down.hal", "\nnet a nothing\n"))

groups, chosen = sys.argv[1].split(","), sys.argv[2:]
for group, title, file, edits, prepare, other, before in CASES:
    if group not in groups or chosen and not any(c in title for c in chosen):
        continue
    shutil.rmtree("mill", ignore_errors=True)
    shutil.copytree(TOP / "configs/sim/mill", "mill", ignore=shutil.ignore_patterns("*.var*"))
    os.chdir("mill")
    ini = Path("mill.ini")
    ini.write_text(re.sub(r"DISPLAY = axis", "DISPLAY = true", ini.read_text()).replace("../../../nc_files", "."))
    for pattern, replacement in edits:
        text, count = re.subn(pattern, replacement, Path(file).read_text(), count=1)
        assert count, (title, pattern)
        Path(file).write_text(text)
    busy_ports = (prepare() or []) if prepare else []
    env = {k: v for k, v in ({k: v for k, v in os.environ.items() if k != "DISPLAY"} | {"HOME": os.getcwd()}
                             | other).items() if v is not None}
    try:
        done = subprocess.run([*before, LINUXCNC, "-r", "mill.ini"], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, errors="replace", timeout=60, env=env)
        status, out = done.returncode, done.stdout
    except subprocess.TimeoutExpired as e:
        status, out = "none: it goes on", (e.stdout or b"").decode(errors="replace")
    print(f"# {title}: status {status}")
    for line in out.splitlines():
        if not USUAL.match(line):
            print("    " + re.sub(r"(port|process) \d{2,}", r"\1 N",
                                  line.replace(os.getcwd() + "/", "").replace(str(TOP) + "/", "").replace(SUFFIX, "")))
    for server in busy_ports:
        if isinstance(server, socket.socket):
            server.close()
    left = subprocess.run(["realtime", "status"], capture_output=True, text=True).stdout.strip()
    if left != "rtapi_app is not running":
        print("    LEFT:", left)
    os.chdir("..")
shutil.rmtree("mill", ignore_errors=True)
