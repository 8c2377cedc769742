# SPDX-License-Identifier: GPL-2.0-or-later
"""The `linuxcnc` command: starts a machine from its INI file and stops it again.

A small guard process starts the session process and waits. Whichever of the two is
killed, the other one ends everything that was started, so nothing is left behind.
Order, texts and exit statuses: launcher reference, sections 1 to 7.
"""

import contextlib
import getopt
import os
import shlex
import select
import shutil
import signal
import subprocess
import sys
import time
import traceback
import uuid
from pathlib import Path

from . import clock, instance
from .inivalues import IniError, IniValues
from .launch_logs import Logs, Lossy
from .process import end_with_parent
from .screen_record import CRASH, MOST, RETRY_S, VARIABLE, WITHIN_S, Restarts
from .session_processes import (CHILD_END_S, SESSION, comm_of, end, ended, lives, session_processes, state_of, status_of,
                                user_name)
from .tree import Tree

USAGE = """linuxcnc: Run LinuxCNC

Usage:
  linuxcnc [options] [INIFILE] [display arguments]
  linuxcnc -l | -h

Options:
  -d           show every command that is run
  -v           accepted for old scripts: everything is printed where it can be read
  -r           no redirection of output when standard input is not a terminal
  -l           use the last configuration again
  -k           go on after errors in HAL files
  -t "MODULE [PARAMETERS]"   trajectory planner module
  -m "MODULE [PARAMETERS]"   homing module
  -H DIR       search DIR for HAL files first (may be repeated)
  -D "PROGRAM [ARGUMENTS]"   display program, instead of [DISPLAY]DISPLAY
  -n           try: load everything up to the HAL files, start no thread and no display, and stop
"""

WATCH_MS = 100          # at most between two looks at the processes
BUSY_MS = 1000          # between two looks whether a program runs, while there is no screen
READY_WAIT_S = 10.0     # for task to publish the first settings
TASK_COMPONENT = "inihal"        # of task, in HAL
SAFE_STOP_S = 2.0       # for motion to be ended after task has died
DISPLAY_PART = "_DISPLAY"     # of the variable that marks the display and its children
HOST_KEYS = (0x48414C32, 0x90280A48, 0x48484C34)     # HAL, RTAPI, UUID
TOOL_KEY = 101


class Failure(Exception):
    """Ends the start-up: the text says what, where and what to do; status is the exit status."""

    def __init__(self, text, status=1):
        super().__init__(text)
        self.status = status


class Died(Failure):
    """A part of the machine ended that must not."""


class Options:
    """The command line."""

    def __init__(self, argv):
        self.debug = self.verbose = self.test_mode = self.keep_going = self.last = self.try_only = False
        self.tpmod = self.homemod = self.display = None
        self.hallib_dirs = []
        try:
            found, rest = getopt.getopt(argv, "dvlhkrnH:t:m:D:")
        except getopt.GetoptError as e:
            print(f"linuxcnc: {e}", file=sys.stderr)
            print(USAGE)
            sys.exit(1)
        for flag, value in found:
            if flag == "-h":
                print(USAGE)
                sys.exit(0)
            elif flag == "-H":
                if not os.path.isdir(value):
                    print(f"Invalid dirname specified: -H {value}")
                    sys.exit(1)
                self.hallib_dirs.append(os.path.realpath(value))
            else:
                name = {"-d": "debug", "-v": "verbose", "-r": "test_mode", "-k": "keep_going", "-l": "last",
                        "-n": "try_only", "-t": "tpmod", "-m": "homemod", "-D": "display"}[flag]
                setattr(self, name, value or True)
        self.ini = rest[0] if rest else None
        self.extra = rest[1:]
        if os.isatty(0):
            print("Debug mode on\n" * bool(self.debug) + "Verbose mode on\n" * bool(self.verbose), end="", flush=True)
        if self.ini == "-":
            self.last, self.ini = True, None


def last_config():
    """Path of the configuration that the picker remembered, or None."""
    rc = Path.home() / ".linuxcncrc"
    if not rc.exists():
        return None
    try:
        return IniValues(rc).get("PICKCONFIG", "LAST_CONFIG")
    except IniError:
        return None


def interpreter_of(program, env):
    """The program that the script's first line asks for, in words for a message; "": no script."""
    try:
        with open(shutil.which(program, path=env["PATH"]), "rb") as f:
            first = f.readline(200).decode(errors="replace").strip()
    except (OSError, TypeError):
        return ""
    return f"; its first line asks for {first[2:].strip()}" if first.startswith("#!") else ""


class Session:
    """One machine: everything between the lock file's creation and its removal."""

    def __init__(self, options, ini_path, tree):
        self.options, self.tree = options, tree
        self.ini_path = ini_path
        self.ini = None
        self.lock = instance.suffixed("/tmp/linuxcnc.lock")
        self.id = os.environ.get(SESSION + "_NEW") or uuid.uuid4().hex
        self.env = tree.environment()
        self.env[SESSION] = self.id
        config_dir = os.path.dirname(ini_path)
        self.env["PATH"] = os.pathsep.join([config_dir + "/bin", self.env["PATH"]])
        local_bin = os.path.expanduser("~/.local/bin")
        folders = self.env["PATH"].split(os.pathsep)
        if os.path.isdir(local_bin) and local_bin not in folders:
            own = folders.index(str(tree.bin)) + 1 if str(tree.bin) in folders else 1
            self.env["PATH"] = os.pathsep.join(folders[:own] + [local_bin] + folders[own:])
        hallib_path = os.pathsep.join(options.hallib_dirs + [".", str(tree.hallib)])
        self.halcmd = ["halcmd"] + (["-k"] if options.keep_going else [])
        self.env.update(CONFIG_DIR=config_dir, HALLIB_PATH=hallib_path, HALCMD=" ".join(self.halcmd))
        if options.hallib_dirs:
            print(f"HALLIB_PATH = {hallib_path}")
        if os.environ.get("LINUXCNC_OPENGL_PLATFORM", "glx") == "glx":
            self.env.update(PYOPENGL_PLATFORM="x11", GDK_BACKEND="x11", QT_QPA_PLATFORM="xcb")
        # Our own look-ups (subprocess, shutil.which) use the same path.
        os.environ["PATH"] = self.env["PATH"]
        os.environ["HALLIB_PATH"] = hallib_path
        self.task_pid = None
        self.watched = {}        # pid -> name: the session ends when one of these dies,
        self.dispensable = set()  # or the operator is told: server of remote clients, components of HAL
        self.display = None
        self.restarts = Restarts(f"/tmp/linuxcnc.screen.{self.id}")
        self.task_died = False   # without having put anything in order
        self.splash = None
        self.hal_failed = False  # some HAL file or command, with -k

    # -- helpers ---------------------------------------------------------------------------

    def trace(self, command):
        """With -d: what is run, as a shell's -x."""
        if self.options.debug:
            print("+ " + shlex.join(command), file=sys.stderr, flush=True)

    def run(self, *command, quiet=False):
        """Runs a program of ours to its end; returns its exit status."""
        self.trace(command)
        options = dict(env=self.env, stdin=subprocess.DEVNULL)
        if quiet:
            options.update(stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            return status_of(clock.run(list(command), **options).returncode)
        except FileNotFoundError:
            raise Failure(f"Can't execute {command[0]}: not found on PATH") from None

    def output(self, *command):
        done = clock.run(list(command), env=self.env, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                         stderr=subprocess.DEVNULL, text=True)
        return done.stdout.strip() if done.returncode == 0 else ""

    def need_program(self, name, message):
        if not shutil.which(name, path=self.env["PATH"]):
            if shutil.which(name, mode=os.F_OK, path=self.env["PATH"]):
                message += f"\n{name} is not executable: chmod +x {name}"
            elif "/" not in name and os.path.exists(name):
                message += f"\n{name} is in the folder of the INI file, which is not searched: write ./{name}"
            raise Failure(message)

    # -- start -----------------------------------------------------------------------------

    def check_ini(self):
        try:
            self.ini = IniValues(self.ini_path, self.env)
        except IniError as e:
            sys.stderr.write(str(e))
            raise Failure("E: The INI-file contains errors that need to be fixed.") from None
        sys.stderr.write(self.ini.messages)
        if not self.ini.sections:
            print(f"{self.ini_path}: no setting in it", file=sys.stderr)
            raise Failure("E: The INI-file contains errors that need to be fixed.")
        if not self.options.test_mode:
            print(f"Machine configuration directory is '{os.path.dirname(self.ini_path)}'")
            print(f"Machine configuration file is '{os.path.basename(self.ini_path)}'", flush=True)
        if self.ini.get("EMC", "VERSION") != "1.1":
            self.update_ini()
        from . import check_ini
        if not self.options.try_only and check_ini.check(self.ini, self.ini_path):
            raise Failure("linuxcnc_check_ini validation failed")

    def update_ini(self):
        version = self.ini.get("EMC", "VERSION") or "0.0"
        if version > "1.1" and version[0].isdigit():    # update_ini leaves those alone
            print(f"{self.ini_path}: [EMC]VERSION = {version} is newer than 1.1, the newest that is "
                  "known: started as it is", file=sys.stderr)
            return
        if not os.environ.get("DISPLAY"):       # nobody to ask: the backup keeps the old files
            from . import update_ini
            try:
                backup = update_ini.convert(Path(self.ini_path), version)
            except update_ini.UpdateError as e:
                raise Failure(str(e)) from None
            print(f"{self.ini_path}: updated to version 1.1; the old files are in {backup}", flush=True)
            self.ini = IniValues(self.ini_path, self.env)
            return
        status = self.run("update_ini", "-d", self.ini_path)
        if status == 42:
            raise Failure("update_ini cancelled by user", 0)
        if status:
            raise Failure("update script failed in an unexpected way.", status)
        self.ini = IniValues(self.ini_path, self.env)

    def read_settings(self):
        get = self.ini.get
        self.task = get("TASK", "TASK") or "milltask"
        self.halui = get("HAL", "HALUI")
        self.halbridge = get("HAL", "HALBRIDGE")
        words = (self.options.display or get("DISPLAY", "DISPLAY") or "").split()
        if not words:
            raise Failure(f"{self.ini_path}: [DISPLAY]DISPLAY is missing: name a user interface, e.g. DISPLAY = axis")
        self.display_program, self.display_args = words[0], words[1:]
        nml = get("LINUXCNC", "NML_FILE") or get("EMC", "NML_FILE")
        self.env.update(NMLFILE=os.path.join(os.path.dirname(self.ini_path), nml) if nml else str(self.tree.nml),
                        TRAJ_COORDINATES=get("TRAJ", "COORDINATES") or "",
                        KINS_KINEMATICS=get("KINS", "KINEMATICS") or "")
        self.tpmod = self.options.tpmod or get("TRAJ", "TPMOD") or "tpmod"
        self.homemod = self.options.homemod or get("EMCMOT", "HOMEMOD") or "homemod"

    def take_lock(self):
        """Makes the lock file; a lock whose session is dead is removed with all it left."""
        while True:
            try:
                fd = os.open(self.lock, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o644)
                try:
                    os.write(fd, f"{os.getpid()} {self.id}\n".encode())
                except OSError as e:
                    os.unlink(self.lock)
                    raise Failure(f"Can't write the lock file {self.lock}: {e.strerror}") from None
                os.close(fd)
                return
            except FileExistsError:
                pass
            try:
                with open(self.lock) as f:
                    owner, old_id = (f.read().split() + ["0", ""])[:2]
            except OSError:
                continue
            if owner.isdigit() and old_id and not lives(owner):
                print("Cleaning up after a session that ended without cleaning up...")
            elif not self.wants_restart():
                raise Failure("Not starting new LinuxCNC", 0)
            else:
                print("Cleaning up old LinuxCNC...", flush=True)
            self.clean_other(int(owner) if owner.isdigit() else 0, old_id)

    def wants_restart(self):
        if os.isatty(0):
            try:
                answer = input("LinuxCNC is still running.  Restart it? [Y/n] ")
            except EOFError:        # Ctrl-D
                answer = "n"
            return answer in ("", "y", "Y", "yes")
        if not os.environ.get("DISPLAY"):
            print("No display, no tty, trying to clean up other instance automatically", flush=True)
            return True
        script = ("wm withdraw .; set a [tk_messageBox -type yesno -title LinuxCNC -message "
                  "{LinuxCNC is still running.  Restart it?}]; puts $a; exit")
        done = subprocess.run(["wish8.6"], input=script, stdout=subprocess.PIPE, text=True)
        return done.stdout.strip() == "yes"

    def clean_other(self, owner, old_id):
        self.need_rights(owner)
        if owner and lives(owner):
            os.kill(owner, signal.SIGTERM)
            until = time.monotonic() + 5 * CHILD_END_S
            while os.path.exists(self.lock) and lives(owner) and time.monotonic() < until:
                time.sleep(0.01)
            if not os.path.exists(self.lock):
                return
        mine, self.id = self.id, old_id
        self.clean(remove_lock=True)
        self.id = mine

    def need_rights(self, owner):
        """Another user's session can't be ended by this one."""
        with contextlib.suppress(FileNotFoundError):
            uid = os.stat(self.lock).st_uid
            if os.geteuid() not in (0, uid):
                end_it = f"end its process {owner}" if owner and lives(owner) else f"remove {self.lock}"
                raise Failure(f"LinuxCNC was started by {user_name(uid)}: {end_it} as that user or as root")

    def start(self):
        env = self.env
        print("Starting LinuxCNC...", flush=True)
        os.chdir(os.path.dirname(self.ini_path))
        self.show_splash()
        env["INI_FILE_NAME"] = self.ini_path
        self.need_program("linuxcncsvr", "Can't execute server program linuxcncsvr")
        if self.run("linuxcncsvr", "-ini", self.ini_path):
            raise Failure("linuxcncsvr could not create the NML channels: see its messages above")
        if self.run(str(self.tree.realtime), "start"):
            raise Failure("Realtime system did not load")
        print(f"linuxcnc TPMOD={self.tpmod} HOMEMOD={self.homemod} EMCMOT={self.ini.get('EMCMOT', 'EMCMOT') or 'motmod'}",
              flush=True)
        for module in (self.tpmod, self.homemod):
            if self.run(*self.halcmd, "loadrt", *module.split()):
                raise Failure(f"{self.ini_path}: cannot load realtime module '{module}'")
        self.need_program(self.task, f"Can't execute TASK program {self.task}")
        if self.run(*self.halcmd, "loadusr", "-Wn", TASK_COMPONENT, self.task, "-ini", self.ini_path):
            raise Failure(f"TASK program {self.task} did not start: see its messages above")
        if self.halui:
            self.need_program(self.halui.split()[0], f"Can't execute halui program {self.halui}")
            if self.run(*self.halcmd, "loadusr", "-Wn", "halui", *self.halui.split(), "-ini", self.ini_path):
                raise Failure(f"halui program {self.halui} did not start: see its messages above")
        if self.halbridge:
            self.need_program(self.halbridge.split()[0], f"Can't execute bridge program {self.halbridge}")
            if self.run(*self.halcmd, "loadusr", "-Wn", "bridge", *self.halbridge.split()):
                raise Failure(f"Bridge program {self.halbridge} did not start: see its messages above")
        self.load_hal()
        if self.options.try_only:
            return 1 if self.hal_failed else 0
        if self.run(*self.halcmd, "start"):
            raise Failure("halcmd start failed")
        self.start_applications()
        self.watch()
        self.wait_ready()
        return self.run_display()

    def show_splash(self):
        """Shows [DISPLAY]INTRO_GRAPHIC while the machine starts, for INTRO_TIME seconds at most."""
        name = self.ini.get("DISPLAY", "INTRO_GRAPHIC")
        if not name or not os.environ.get("DISPLAY"):
            return
        for path in (os.path.expanduser(name), os.path.join(os.path.dirname(self.ini_path), name),
                     str(self.tree.share / "images" / name)):
            if os.path.isfile(path):
                seconds = self.ini.get("DISPLAY", "INTRO_TIME", "5")
                self.splash = subprocess.Popen([sys.executable, "-m", "kerf.launch_windows", "splash", path, seconds],
                                               env=self.python_env(), stdin=subprocess.DEVNULL,
                                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                return

    def python_env(self):
        """The session's environment for a Python module of ours, out of the clock's order."""
        return {k: v for k, v in self.env.items() if k != "KERF_CLOCK"} | {"PYTHONPATH": str(self.tree.python)}

    def close_splash(self):
        if self.splash and self.splash.poll() is None:
            self.splash.terminate()
            self.splash.wait()

    def load_hal(self):
        if self.ini.get("HAL", "TWOPASS"):
            script = self.tree.tcl / "twopass.tcl"
            status = self.run("haltcl", "-i", self.ini_path, str(script))
            self.hal_failed |= status != 0
            if status and not self.options.keep_going:
                raise Failure(f"{self.ini_path}: [HAL]TWOPASS failed: see the messages above")
        else:
            for entry in self.ini.all("HAL", "HALFILE"):
                if not entry:
                    break
                self.load_hal_file(entry)
        for line in self.ini.all("HAL", "HALCMD"):
            failed = self.run(*self.halcmd, *line.split()) != 0
            self.hal_failed |= failed
            if failed and not self.options.keep_going:
                raise Failure(f"INI file HAL command {line} failed.")

    def find_hal_file(self, name):
        """(kind, path) of a HAL file by the documented search."""
        if name.startswith("LIB:"):
            path = str(self.tree.hallib / name[4:])
            if not os.access(path, os.R_OK):
                raise Failure(f"CANNOT READ LIB:file:{path}")
            return "LIB", path
        name = os.path.expanduser(name) if name.startswith("~/") else name
        if name.startswith("/"):
            if os.access(name, os.R_OK) and os.path.isfile(name):
                return "ABS", name
        else:
            for folder in self.env["HALLIB_PATH"].split(os.pathsep):
                path = os.path.join(folder, name)
                if os.access(path, os.R_OK) and os.path.isfile(path):
                    return ("REL" if folder.startswith(".") else "lib"), path
        raise Failure(f"CANNOT FIND FILE FOR:{name}")

    def load_hal_file(self, entry):
        words = entry.replace("\\", " ").split()
        kind, path = self.find_hal_file(words[0])
        print(f"Found file({kind}): {path}", flush=True)
        if path.endswith(".tcl"):
            status = self.run("haltcl", "-i", self.ini_path, path, *words[1:])
        else:
            status = self.run(*self.halcmd, "-i", self.ini_path, "-f", path)
        self.hal_failed |= status != 0
        if status and not self.options.keep_going:
            raise Failure(f"{path}: failed (see the message above); it stands in {self.ini_path} as "
                          f"[HAL]HALFILE = {entry}")

    def start_applications(self):
        try:
            delay = float(self.ini.get("APPLICATIONS", "DELAY", "0") or 0)
        except ValueError:           # linuxcnc_check_ini has told it
            delay = 0.0
        for value in self.ini.all("APPLICATIONS", "APP"):
            if not value:
                break
            try:
                words = shlex.split(os.path.expanduser(value) if value.startswith("~/") else value)
            except ValueError as e:
                print(f"APP: {e}: <{value}>")
                continue
            name = words[0]
            local = os.path.join(os.getcwd(), name)
            path = name if name.startswith("/") else local if name.startswith("./") or os.access(local, os.X_OK) and os.path.isfile(local) \
                else shutil.which(name, path=self.env["PATH"])
            if not path or not os.path.exists(path):
                print(f"APP: Cannot find executable file for: <{name}>")
                continue
            if not os.access(path, os.X_OK):
                print(f"APP: File not executable: <{path}>")
                continue
            print(f"APP: {name} found: <{path}>", flush=True)
            self.trace([path] + words[1:])
            line = f"exec {shlex.join([path] + words[1:])}"
            subprocess.Popen(["sh", "-c", f"sleep {delay}; {line}" if delay else line], env=self.env,
                             stdin=subprocess.DEVNULL)

    def wait_ready(self):
        """Waits until task has published its settings."""
        begun = time.monotonic()

        def ready():
            if not any(name.startswith("rtapi_app") and lives(pid) for pid, name in self.watched.items()):
                raise Failure("rtapi_app, the realtime host, died while the machine was started: the kernel's log "
                              "(dmesg) may name the module")
            if not self.task_pid or not lives(self.task_pid):
                raise Failure(f"TASK program {self.task} ended while the machine was started: see its messages above")
            try:
                return float(self.output("halcmd", "getp", "ini.traj_max_velocity") or 0) != 0
            except ValueError:
                return False
        if not clock.wait_until(ready, READY_WAIT_S):
            print(f"ini.traj_max_velocity still 0.0 after {time.monotonic() - begun:.0f} seconds")
            if not self.output("halcmd", "list", "pin", "motion.motion-enabled"):
                print(f"{self.ini_path}: no motion module is loaded: a [HAL]HALFILE has to hold `loadrt "
                      "[EMCMOT]EMCMOT ...`", file=sys.stderr)

    def watch(self):
        """Remembers the programs that must not end: without most of them the machine cannot go on."""
        wanted = {"rtapi_app", "linuxcncsvr"}
        for pid in session_processes(self.id):
            name = comm_of(pid)
            kind = "rtapi_app" if name.startswith("rtapi_app") else name
            if kind in wanted:
                self.watched[pid] = name
                if kind == "linuxcncsvr":
                    self.dispensable.add(pid)
                wanted.remove(kind)
                if not wanted:
                    break
        for line in self.output("halcmd", "-s", "show", "comp").splitlines():
            words = line.split()       # number, kind, name, process, state
            if len(words) != 5 or words[1] != "User" or not words[3].isdigit() or not lives(int(words[3])):
                continue
            pid, name = int(words[3]), words[2]
            if name == TASK_COMPONENT:           # [TASK]TASK may be a path, or a script that starts it
                self.task_pid = pid
                self.watched[pid] = comm_of(pid)
                self.dispensable.discard(pid)
            elif pid not in self.watched:
                self.watched[pid] = name
                self.dispensable.add(pid)

    def tell_operator(self, text):
        """In the logs and, by task, at every screen. Does not wait."""
        print(text, file=sys.stderr, flush=True)
        subprocess.Popen([sys.executable, "-c", "import sys, linuxcnc; linuxcnc.command().error_msg(sys.argv[1])",
                          text], env=self.env,
                         stdin=subprocess.DEVNULL)

    def run_display(self):
        """Starts the screen and waits for its end; one that has crashed comes again while the machine goes on. Returns
        the last one's status."""
        command, crash = self.display_command(), None
        ends, descriptors = select.poll(), {}    # a process descriptor is readable when the process has ended
        for pid in self.watched:
            with contextlib.suppress(OSError):   # it has gone already
                descriptors[pid] = os.pidfd_open(pid)
                ends.register(descriptors[pid], select.POLLIN)
        while True:
            self.start_display(command, crash)
            own = os.pidfd_open(self.display.pid)
            ends.register(own, select.POLLIN)
            while (status := self.display.poll()) is None:
                self.look_at_watched(ends, descriptors)
                ends.poll(WATCH_MS)
            ends.unregister(own)
            os.close(own)
            if status:
                print(f"DISPLAY program {command[0]} {ended(status)}", file=sys.stderr, flush=True)
            if not self.restarts.crashed(status, self.display.pid):
                return status_of(status)
            crash = ended(status)
            if self.restarts.too_many():
                self.go_on_without(command[0], crash, status, ends, descriptors)
            self.look_at_watched(ends, descriptors)      # a screen may crash because the machine did
            print(f"{command[0]} is started again, the machine goes on", file=sys.stderr, flush=True)

    def let_pins_of_the_dead_fall(self):
        """Whoever uses HAL next takes the pins of ended processes away; their bits fall."""
        clock.resume()
        self.run("halcmd", "-s", "show", "comp", quiet=True)
        clock.suspend()

    def start_display(self, command, crash):
        """crash: how the screen before ended, None: there was none."""
        self.trace(command)
        env = self.env | {SESSION + DISPLAY_PART: self.id, VARIABLE: self.restarts.path}
        if crash:
            env[CRASH] = crash
            self.let_pins_of_the_dead_fall()
            clock.resume()
            parts = set(self.restarts.left().get("parts", ()))
            end([p for p in session_processes(self.id, DISPLAY_PART) if p in parts])
        try:
            self.display = clock.spawn(command, "display", env=env)
        except OSError as e:
            raise Failure(f"Can't execute DISPLAY program {command[0]}: "
                          f"{e.strerror}{interpreter_of(command[0], self.env)}") from None
        clock.suspend()

    def look_at_watched(self, ends, descriptors):
        """Raises Died when a process that the machine needs has ended."""
        for pid, name in list(self.watched.items()):
            if lives(pid):
                continue
            if pid not in self.dispensable:
                self.task_died |= pid == self.task_pid
                raise Died(f"{name} (process {pid}) died unexpectedly; stopping everything")
            lost = "remote clients are cut off" if name == "linuxcncsvr" else "what it did is no longer done"
            self.let_pins_of_the_dead_fall()
            self.tell_operator(f"{name} (process {pid}) died: {lost}, the machine goes on")
            del self.watched[pid]
            if pid in descriptors:
                ends.unregister(descriptors[pid])

    def go_on_without(self, name, crash, status, ends, descriptors):
        """The screen can not come back. Nobody's work is cut off for that: while a program runs another try is made
        now and then."""
        if not self.busy():
            raise Died(f"DISPLAY program {name} crashed {MOST} times within {WITHIN_S:g} s, the last time it {crash}; "
                       "stopping everything",
                       status_of(status))
        if len(self.restarts.crashes) == MOST:           # once, not at each try
            print(f"{name} crashed {MOST} times within {WITHIN_S:g} s. A program runs: it goes on to its end "
                  "without a screen, "
                  f"which is tried again every {RETRY_S:g} s. To end the machine, end process {os.getpid()}",
                  file=sys.stderr, flush=True)
        until = time.monotonic() + RETRY_S
        while time.monotonic() < until and self.busy():
            self.look_at_watched(ends, descriptors)
            ends.poll(BUSY_MS)

    def busy(self):
        """Does a program or an MDI line run, or wait for something?"""
        ask = "import sys, linuxcnc; s = linuxcnc.stat(); s.poll(); sys.exit(s.interp_state == linuxcnc.INTERP_IDLE)"
        return subprocess.run([sys.executable, "-c", ask], env=self.env, stdin=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL).returncode == 0

    def display_command(self):
        program, extra = self.display_program, self.display_args + self.options.extra
        if program in ("tkemc", "tklinuxcnc"):
            return ["tklinuxcnc", "-ini", self.ini_path] + extra
        if program == "dummy":
            print("DUMMY DISPLAY MODULE, press <ENTER> to continue.", flush=True)
            return ["sh", "-c", "read line || :"]
        self.need_program(program, f"Can't execute DISPLAY program {' '.join([program] + extra)}")
        if program == "linuxcncrsh":
            return [program] + extra + ["--", "-ini", self.ini_path]
        return [program, "-ini", self.ini_path] + extra

    # -- stop ------------------------------------------------------------------------------

    def clean(self, remove_lock=True):
        """Ends everything of this session, also after a crash of any part of it."""
        ignore_ends()
        clock.leave()
        if self.task_died and not self.stopped_safely():
            self.try_run("kerf-safe-stop", "-ini", self.ini_path)
        self.close_splash()
        print("Shutting down and cleaning up LinuxCNC...", flush=True)
        if self.display and self.display.poll() is None:
            end([self.display.pid])
        elif not self.display:          # of a session that was killed
            end(list(session_processes(self.id, DISPLAY_PART)))
        shutdown = self.ini.get("HAL", "SHUTDOWN") if self.ini else None
        running = list(session_processes(self.id))
        host = [p for p in running if comm_of(p).startswith("rtapi_app")]
        if shutdown and host:
            print("Running HAL shutdown script")
            self.try_run("halcmd", "-f", shutdown, quiet=False)
        servers = [p for p in running if comm_of(p) in ("linuxcncsvr", "milltask", "motion-logger",
                                                       getattr(self, "task", "milltask")[:15])]
        end(servers)
        if host:
            self.try_run("halcmd", "stop")
            self.try_run("halcmd", "unload", "all")
        self.try_run(str(self.tree.realtime), "stop", seconds=10.0)
        for pid in end(list(session_processes(self.id))):
            print(f"Could not kill task {comm_of(pid)}, PID={pid}")
        self.restarts.remove()
        self.remove_segments()
        if remove_lock:
            try:
                os.unlink(self.lock)
            except FileNotFoundError:
                pass

    def stopped_safely(self):
        """Waits for the process that milltask leaves for its death. False: there is none, or it hangs."""
        own = [p for p in session_processes(self.id) if comm_of(p) == "kerf-safe-stop"]
        until = time.monotonic() + SAFE_STOP_S
        while own and time.monotonic() < until:
            if all(state_of(p) in "ZX" for p in own):
                return True
            time.sleep(0.005)
        return False

    def try_run(self, *command, seconds=5.0, quiet=True):
        """Runs a clean-up step; one that hangs is ended."""
        output = subprocess.DEVNULL if quiet else None
        self.trace(command)
        try:
            subprocess.run(list(command), env=self.env, stdin=subprocess.DEVNULL, stdout=output, stderr=output,
                           timeout=seconds)
        except (subprocess.TimeoutExpired, OSError):
            pass

    def remove_segments(self):
        """Removes the shared memory of the NML buffers and tool data, and of a host that was killed."""
        keys = {TOOL_KEY, 0x64, *HOST_KEYS}
        try:
            with open(self.env.get("NMLFILE", str(self.tree.nml))) as f:
                for line in f:
                    word = line.split()
                    if len(word) > 9 and word[0] == "B" and word[2] == "SHMEM":
                        keys.add(int(word[9], 0))
        except OSError:
            pass
        wanted = {instance.key(k) for k in keys}
        for key, segment in instance.segments().items():
            if key in wanted:
                instance.remove_segment(segment)


def find_ini(options, tree):
    """Absolute path of the INI file that the command line means."""
    path = options.ini
    if options.last:
        path = last_config()
        if not path:
            raise Failure("Could not find a last used configuration: start with an INI file first")
    if path is None:
        if not os.environ.get("DISPLAY"):
            raise Failure("No INI file given: use `linuxcnc FILE.ini` (the picker needs a display)")
        done = subprocess.run([sys.executable, "-m", "kerf.pickconfig"], env=tree.environment() |
                              {"PYTHONPATH": str(tree.python)}, stdout=subprocess.PIPE, text=True)
        path = done.stdout.strip()
        if not path:
            sys.exit(status_of(done.returncode))    # 0: cancelled
        if path.endswith(".demo"):
            subprocess.Popen([path], env=tree.environment(), cwd=os.path.dirname(path))
            sys.exit(0)
    full = path if path.startswith("/") else os.path.join(os.getcwd(), path)
    if not os.path.isfile(full):
        raise Failure(f"Could not find INI file '{full}'")
    return os.path.normpath(full)


def ignore_ends():
    for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP, signal.SIGQUIT):
        signal.signal(number, signal.SIG_IGN)


def interrupted(*_):
    ignore_ends()       # a second one would stop the clean-up
    raise KeyboardInterrupt


def on_hangup(handler):
    """The terminal was closed: an end like any other, unless the user wanted it to go on (nohup)."""
    if signal.getsignal(signal.SIGHUP) != signal.SIG_IGN:
        signal.signal(signal.SIGHUP, handler)


def session_main(options, ini_path, tree, guard, told):
    """The session process. Returns the exit status; what died is written to the descriptor `told`."""
    end_with_parent(parent=guard)
    signal.signal(signal.SIGTERM, interrupted)
    signal.signal(signal.SIGINT, interrupted)
    signal.signal(signal.SIGQUIT, interrupted)
    on_hangup(interrupted)
    session = Session(options, ini_path, tree)
    status = 0
    try:
        session.check_ini()
        session.read_settings()
        session.take_lock()             # before we join: what a killed session left may hold simulated time
        clock.join("linuxcnc")
        try:
            status = session.start()
        finally:
            session.clean()
    except Failure as e:
        print(e, file=sys.stderr if e.status else sys.stdout)
        status = e.status
        if isinstance(e, Died):
            os.write(told, str(e).encode())
    except KeyboardInterrupt:
        status = 0
    clock.leave()
    sys.stdout.flush()
    return status


def guarded(options, ini_path, tree):
    """Runs the session in a child; cleans up when the child is killed. Returns its status and
    what died ("": nothing)."""
    sys.stdout, sys.stderr = Lossy(sys.stdout), Lossy(sys.stderr)
    hear, tell = os.pipe()
    os.environ[SESSION + "_NEW"] = uuid.uuid4().hex
    sys.stdout.flush()
    guard = os.getpid()
    child = os.fork()
    if child == 0:
        status = 1
        try:
            status = session_main(options, ini_path, tree, guard, tell)
        except OSError as e:             # no space, no rights, no such folder
            print(f"linuxcnc: {e.strerror}" + (f": {e.filename}" if e.filename else ""), file=sys.stderr)
        except Exception:                # a fault of ours
            traceback.print_exc()
        finally:
            sys.stdout.flush()
            sys.stderr.flush()
            os._exit(status)

    def forward(number, _frame):
        try:
            os.kill(child, number)
        except OSError:
            pass
    signal.signal(signal.SIGTERM, forward)
    on_hangup(lambda *_: forward(signal.SIGTERM, None))
    for key in (signal.SIGINT, signal.SIGQUIT):        # from a terminal both processes get it
        signal.signal(key, lambda *_: None if os.isatty(0) else forward(signal.SIGTERM, None))
    _, how = os.waitpid(child, 0)
    os.close(tell)
    with open(hear, errors="replace") as f:
        died = f.read()
    status = os.waitstatus_to_exitcode(how)
    if status >= 0:
        return status, died
    print(f"The session process was ended by signal {-status}.", file=sys.stderr)
    session = Session(options, ini_path, tree)
    try:
        session.ini = IniValues(ini_path, session.env)
        session.read_settings()
    except (IniError, Failure):
        pass
    if os.path.exists(session.lock):
        session.clean()
    return 1, ""


def open_streams():
    """A desktop may start us without standard streams."""
    while (unused := os.open(os.devnull, os.O_RDWR)) <= 2:
        pass
    os.close(unused)
    sys.stdout, sys.stderr = sys.stdout or os.fdopen(1, "w"), sys.stderr or os.fdopen(2, "w")


def main(argv):
    open_streams()
    options = Options(argv)
    tree = Tree.find()
    for name, value in tree.environment().items():
        os.environ[name] = value
    try:
        ini_path = find_ini(options, tree)
    except Failure as e:
        print(e, file=sys.stderr)
        return e.status
    if not options.test_mode:
        print(f"LINUXCNC - {tree.version()}", flush=True)
    terminal = os.dup(2)
    logs = Logs(options)
    status, died = 1, ""
    try:
        status, died = guarded(options, ini_path, tree)
    finally:
        logs.finish(status, terminal, died)
    return status
