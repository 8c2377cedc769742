#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""FP-137: what every shipped tool weighs that lives for HOURS (24) beside a machine that works (make bench-tools-soak).

The programs are those that ship, each a process of its own. Windows live by fast_tk: the looks of a day without the
waits. What takes part in virtual time lives as long as the machine's clock went. A server lives by what it was asked:
ten requests a second are a day's 864,000. Each tool is ended when it has lived HOURS; MINUTES of wall time end all.
REST: part of the time in which the machine stands still (0.9: its windows get most of the processor). REPORT is written
each minute; a tool grows that gained MOST_KB a day in the later half of its life.
"""
import os
import pty
import signal
import socket
import subprocess
import sys
import threading
import time
from pathlib import Path

HERE = Path(__file__).resolve()
TOP = HERE.parents[4]
HOURS, MINUTES = float(os.environ.get("HOURS", "24")), float(os.environ.get("MINUTES", "600"))
REST = float(os.environ.get("REST", "0"))
REPORT = Path(os.environ.get("REPORT", TOP / "objects/tools-soak.txt"))
MOST_KB, LEAST_KB = 2000, 400       # in a day; and what is never called growth, however short the run
# What a tool keeps by intent: 131072 observations fill up first.
BUFFERS_KB = {"mtconnect-agent": 32000}
LOOK_S = 20
ONLY = [name for name in os.environ.get("TOOLS", "").split(",") if name]
PROGRAM = ("T1 M6\no1 while [1]\nG10 L2 P1 X0.25\nT1 M6\nG0 X1\n(MSG, round)\nG1 F6000 X0 Y5\nG2 X0 Y0 I0 J-2.5\n"
           "T2 M6\n"
           "M3 S1000\nM8\nG1 Z[60-#5400]\nM9\nM5\n(DEBUG, #5420)\no1 endwhile\nM2\n")
SOURCES = ["loadrt siggen num_chan=2", "addf siggen.0.update {t}", "addf siggen.1.update {t}",
           "setp siggen.0.frequency 3", "setp siggen.1.frequency .7", "setp siggen.1.amplitude 50", 
           "net sine siggen.0.sine", "net square siggen.0.clock",
           "net slow siggen.1.sawtooth",
           "newsig soak-bit bit", "newsig soak-int s32", "newsig soak-float float"]
PENDANT = """import hal, time
c = hal.component("xhc-hb04")
for name in ("connected", "require_pendant"):
    c.newpin(name, hal.HAL_BIT, hal.HAL_OUT)
c.ready()
time.sleep(1e6)
"""
STREAMS = ["loadrt sampler depth=200 cfg=ff", "loadrt streamer depth=200 cfg=f",
           "addf streamer.0 servo-thread", "addf sampler.0 servo-thread",
           "net sine sampler.0.pin.0", "net slow sampler.0.pin.1"]
TUNED = ["loadrt pid names=soak-pid", *(f"setp soak-pid.{n} [TUNE]{n.upper()}" for n in ("Pgain", "Igain", "FF1"))]
CHANGER = ["!iocontrol.0.tool-change", "loadusr -W hal_manualtoolchange",
           "net tool-change iocontrol.0.tool-change => hal_manualtoolchange.change",
           "net tool-changed iocontrol.0.tool-changed <= hal_manualtoolchange.changed",
           "net tool-number iocontrol.0.tool-prep-number => hal_manualtoolchange.number", 
           # the operator's answer comes after half a second
           "loadrt oneshot", "addf oneshot.0 servo-thread", "setp oneshot.0.width .5", "net tool-change oneshot.0.in",
           "net confirm oneshot.0.out-not => hal_manualtoolchange.change_button"]


def weigh(pid):
    """kB: (of its own, resident). Pages of files are nobody's own: they become private when others that map them end."""
    lines = Path(f"/proc/{pid}/smaps_rollup").read_text().splitlines()[1:]
    sizes = {words[0]: int(words[1]) for words in map(str.split, lines)}
    return sizes["Private_Dirty:"] + sizes["Swap:"], sizes["Rss:"]


class Tool:
    """lived(): hours. process: a Popen, or the number of a process."""

    def __init__(self, name, process, lived, pid=None):
        self.name, self.process, self.lived = name, process, lived
        self.pid = pid or (lambda: getattr(process, "pid", process))
        self.looks, self.end = [], ""        # (hours, own kB, resident kB)

    def look(self):
        if self.end:
            return
        try:
            hours, sizes = self.lived(), weigh(self.pid())
        except (OSError, ValueError, KeyError, IndexError):
            if isinstance(self.process, subprocess.Popen) and self.process.poll() is not None:
                self.end = f"ended by itself, status {self.process.returncode}"
            return
        if hours > 0 and (not self.looks or hours > self.looks[-1][0]):
            self.looks.append((hours, *sizes))
        if hours >= HOURS:
            self.finish("done")

    def finish(self, why):
        if not self.end:
            self.end = why
            if isinstance(self.process, subprocess.Popen):
                self.process.send_signal(signal.SIGTERM)

    def row(self):
        if not self.looks:
            return f"{self.name:22s} never looked {self.end}", True
        hours = self.looks[-1][0]
        at = [min(self.looks, key=lambda l, part=part: abs(l[0] - hours * part)) for part in (0, .25, .5, .75, 1)]
        grown = at[4][1] - at[2][1]
        leaks = 2 * min(at[3][1] - at[2][1], at[4][1] - at[3][1])       # what leaks does so in each quarter
        day = leaks / max(at[4][0] - at[2][0], 1e-9) * 24
        filled = at[4][1] - at[0][1] > max(LEAST_KB, BUFFERS_KB.get(self.name, 0))
        bad = (filled and leaks > LEAST_KB and day > MOST_KB) or self.end.startswith("ended by")
        own = " ".join(f"{look[1]:7d}" for look in at)
        return (f"{self.name:22s} {hours:7.2f} h  own kB {own}  RSS {at[0][2]:7d} {at[4][2]:7d}  "
                f"{grown:+6d} kB in the later half {'GROWS' if bad else 'flat'}  {self.end}"), bad


class Soak:
    def __init__(self, scratch):
        self.scratch, self.tools, self.closing, self.sessions = scratch, [], [], []

    def wanted(self, name):
        return not ONLY or name in ONLY

    def environment(self, name, session=None, **more):
        env = {k: v for k, v in os.environ.items() if k != "KERF_CLOCK_SLOT"}
        env.update(more)
        env["HOME"] = str(self.scratch)
        if session:
            env.update(KERF_INSTANCE=session, KERF_CLOCK="real")
        return env

    def start(self, name, words, env, cwd=None, **how):
        log = open(self.scratch / f"{name}.log", "w")
        # what takes part in virtual time has one processor; these do not
        options = {"stdin": subprocess.DEVNULL, "stdout": log, "stderr": log,
                   "preexec_fn": lambda: os.sched_setaffinity(0, range(os.cpu_count()))} | how
        return subprocess.Popen(words, env=env, cwd=cwd, **options)

    def window(self, name, words, hand="", session=None, cwd=None, size=""):
        """A Tk program that lives by fast_tk."""
        if not self.wanted(name):
            return
        life = self.scratch / f"{name}.life"
        env = self.environment(name, session, SOAK_LIFE=str(life), SOAK_HAND=hand, SOAK_SIZE=size)
        env["PYTHONPATH"] = f"{HERE.parent / 'fast_tk'}:{env.get('PYTHONPATH', '')}"
        # they never wait: the machine goes first
        process = self.start(name, ["nice", "-n", "10", *words], env, cwd)
        self.tools.append(Tool(name, process, lambda: float(life.read_text().split()[1]),
                               lambda: int(life.read_text().split()[0])))

    def server(self, name, words, ask, per_s=10, session=None, **how):
        """A program that ask(process, told) talks to, in a thread; told(n): n answers came, per_s make a second."""
        if not self.wanted(name):
            return
        process = self.start(name, words, self.environment(name, session), **how)
        answered = [0]

        def told(n=1):
            answered[0] += n
        threading.Thread(target=self.patient, args=(ask, process, told), daemon=True).start()
        self.tools.append(Tool(name, process, lambda: answered[0] / per_s / 3600))

    @staticmethod
    def patient(ask, process, told):
        while process.poll() is None:
            try:
                ask(process, told)
            except (OSError, ValueError):       # not there yet, or the connection ended
                time.sleep(0.2)

    def ticking(self, name, process, now):
        """A program that takes part in virtual time."""
        if self.wanted(name):
            began = now()
            self.tools.append(Tool(name, process, lambda: (now() - began) / 3600))

    def session(self, name, lines):
        """A realtime of its own, in real time."""
        env = self.environment(name, name)
        (self.scratch / f"{name}.hal").write_text("\n".join(lines) + "\n")
        subprocess.run(["realtime", "start"], env=env, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        subprocess.run(["halcmd", "-f", str(self.scratch / f"{name}.hal")], env=env, check=True)
        self.sessions.append(env)

    @staticmethod
    def until_net(env, signal_name, pin):
        """As soon as the pin is there."""
        for _ in range(600):
            if not subprocess.run(["halcmd", "net", signal_name, pin], env=env, stderr=subprocess.DEVNULL).returncode:
                break
            time.sleep(0.1)

    def run(self, wait):
        """wait(): some of the machine's time passes."""
        began = looked = told = time.monotonic()
        while time.monotonic() - began < MINUTES * 60 and any(not t.end for t in self.tools):
            wait()
            if time.monotonic() - looked > LOOK_S or HOURS < 1:
                looked = time.monotonic()
                for tool in self.tools:
                    tool.look()
            if time.monotonic() - told > 60:
                told = time.monotonic()
                self.report(f"after {(told - began) / 60:.0f} minutes")
        for tool in self.tools:
            tool.look()
        bad = self.report(f"after {(time.monotonic() - began) / 60:.0f} minutes, the end")
        for tool in self.tools:
            tool.finish("not done")
        for work in self.closing:
            work()
        for tool in self.tools:
            if isinstance(tool.process, subprocess.Popen):
                try:
                    tool.process.wait(20)
                except subprocess.TimeoutExpired:
                    tool.process.kill()
        for env in self.sessions:
            subprocess.run(["realtime", "stop"], env=env, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        return bad

    def report(self, head):
        rows = [tool.row() for tool in self.tools]
        head += "; own kB at 0, 1/4, 1/2, 3/4 and the end of what was lived"
        REPORT.write_text("\n".join([head, *(text for text, _ in rows)]) + "\n")
        return [tool.name for tool, (_, bad) in zip(self.tools, rows) if bad]


def conversation(port, hello, lines, last, end=b"\r\n"):
    """ask() of a line server: lines go together, the last answer is known; a connection holds for a hundred turns."""
    text = b"".join(line.encode() + end for line in lines)

    def ask(process, told):
        with socket.create_connection(("127.0.0.1", port), 20) as s:
            s.sendall(hello.encode() + end)
            for _ in range(100):
                s.sendall(text)
                got = b""
                while last not in got:
                    data = s.recv(65536)
                    if not data:
                        return
                    got += data
                told(len(lines))
    return ask


def web(port):
    def ask(process, told):
        import urllib.request
        for path in ("current", "sample?count=50", "probe", "assets"):
            with urllib.request.urlopen(f"http://127.0.0.1:{port}/{path}", timeout=30) as answer:
                answer.read()
            told()
        time.sleep(0.01)
    return ask


def lcd(listener):
    def ask(process, told):
        connection, _ = listener.accept()
        connection.sendall(b"connect LCDproc 0.5.9 protocol 0.3 lcd wid 20 hgt 4 cellwid 5 cellhgt 8\n"
                           b"listen linuxcnc\n")
        while data := connection.recv(65536):
            told(data.count(b"widget_set"))
    return ask


def typed(process, told):
    """halcmd reads lines; the answer to a block's last one is waited for."""
    while process.poll() is None:
        process.stdin.write("show pin siggen\ngetp siggen.0.sine\nsets soak-float 2.5\nshow sig\nlist pin\nstatus\n"
                            "nosuchcommand\ngetp siggen.1.amplitude\n")
        process.stdin.flush()
        while process.stdout.readline() != "50\n":
            pass
        told(8)


def at_terminal(master):
    def ask(process, told):
        for n in range(1 << 60):
            os.write(master, f"getp siggen.0.sine\nsets soak-float {n}\ngetp siggen.1.amplitude\n".encode())
            got = b""
            while b"\r50\r\n" not in got:
                got = got[-2000:] + os.read(master, 65536)
            told(3)
    return ask


def poured(process, told):
    block = "".join(f"{n * .25}\n" for n in range(100))
    while process.poll() is None:
        process.stdin.write(block)
        process.stdin.flush()
        told(100)


def drained(process, told):
    while process.stdout.read(4096):
        told(200)


def windows_of_a_machine(soak, ini):
    watch = soak.scratch / "soak.halshow"
    watch.write_text("sig+sine sig+slow pin+joint.0.pos-cmd sig+soak-bit sig+soak-int pin+siggen.0.square "
                     "param+servo-thread.tmax pin+spindle.0.on\n")
    (soak.scratch / "pocket.ngc").write_text(
        "o<pocket> sub\n#<w> = #1 (=10 width)\n#<d> = #2 (=-2 depth)\nG1 F100 X#<w> Z#<d>\no<pocket> endsub\n")
    table = soak.scratch / "edited.tbl"
    table.write_text("".join(f"T{n} P{n} Z{n} D{n} ;tool {n}\n" for n in range(1, 60)))
    soak.window("halshow", ["halshow", "--noprefs", str(watch)])
    soak.window("halmeter", ["halmeter", "pin", "siggen.0.sine"])
    soak.window("halmeter -s", ["halmeter", "-s", "sig", "slow"])
    soak.window("emccalib", ["emccalib", "--", "-ini", ini], "Refresh,Test,Cancel,Test,OK")
    soak.window("linuxcnctop", ["linuxcnctop", "-ini", ini])
    soak.window("debuglevel", ["debuglevel", "-ini", ini])
    soak.window("mdro", ["mdro", "-ini", ini])
    soak.window("tooledit", ["tooledit", str(table)], "AddTool,ReRead")
    soak.window("tklinuxcnc", ["tklinuxcnc", "-ini", ini])
    soak.window("ngcgui", ["ngcgui", "-S", str(soak.scratch / "pocket.ngc"), "-o", str(soak.scratch / "made.ngc")],
                "Create Feature,Finalize,Restart")
    soak.window("halconfig", ["halconfig"])
    soak.window("teach-in", ["teach-in", "", str(soak.scratch / "taught")], "Learn")
    soak.window("sim_pin", ["sim_pin", "soak-bit", "soak-int", "soak-float"])
    soak.window("simulate_probe", ["simulate_probe"])
    if soak.wanted("monitor-xhc-hb04"):
        pendant = soak.start("pendant", [sys.executable, "-c", PENDANT], soak.environment("pendant"))
        soak.closing.append(pendant.kill)
        soak.until_net(soak.environment("pendant"), "pendant-here", "xhc-hb04.connected")
        soak.window("monitor-xhc-hb04", ["monitor-xhc-hb04"])
    soak.window("pickconfig", [sys.executable, "-m", "kerf.pickconfig"], "<Down>,<Down>,<Right>,<Down>,<Up>")


def windows_of_a_bench(soak):
    """Beside a thread in real time: what measures, draws many points, or has a panel."""
    scope = ("THREAD slow\nHMULT 1\nCHAN 1\nPIN siggen.0.sine\nCHAN 2\nSIG slow\n"
             "TSOURCE 1\nTLEVEL 0\nTPOS .2\nTPOLAR 1\nTMODE 1\n")
    saved = str(soak.scratch / "saved")
    bench = ["loadrt threads name1=slow period1=1000000", *(line.format(t="slow") for line in SOURCES), "start"]
    if soak.wanted("halscope triggered"):
        machine = f"{os.environ['KERF_INSTANCE']}t"
        soak.session(machine, bench)
        (soak.scratch / "triggered").write_text("# SAMPLES 1000\n" + scope + "RMODE 1\n")
        words = ["halscope", "-i", f"{soak.scratch}/triggered", "-o", saved + "1"]
        soak.window("halscope triggered", words, session=machine)
    wanted = ("halscope roll", "hal-histogram", "pyvcp", "vismach", "halcmd -f", "halcmd at a terminal")
    if any(soak.wanted(name) for name in wanted):
        machine = f"{os.environ['KERF_INSTANCE']}b"
        soak.session(machine, bench)
        (soak.scratch / "rolling").write_text("# SAMPLES 16000\n" + scope + "RMODE 3\n")
        soak.window("halscope roll", ["halscope", "-i", f"{soak.scratch}/rolling", "-o", saved + "2"], session=machine)
        soak.window("hal-histogram", ["hal-histogram", "siggen.0.sine"], session=machine)
        panels = TOP / "tests/pyvcp/every-widget-works-with-its-pins"
        soak.window("pyvcp", ["pyvcp", "-c", "all", "panel.xml"], session=machine, cwd=panels)
        soak.window("vismach", ["xyzac-trt-gui"], session=machine, size="160x120")
        env = soak.environment("halcmd", machine)
        pins = {"slow": "all.bar.0 all.meter.0.value xyzac-trt-gui.tilt-a xyzac-trt-gui.table-x",
                "sine": "all.number.0 xyzac-trt-gui.rotate-c", "square": "all.led.0 all.my-led all.timer.0.run"}
        for signal_name, names in pins.items():
            for pin in names.split():
                if soak.wanted("pyvcp" if pin.startswith("all.") else "vismach"):
                    soak.until_net(env, signal_name, pin)
        pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "text": True}
        soak.server("halcmd -f", ["halcmd", "-kf"], typed, 1, machine, **pipes)
        master, slave = pty.openpty()
        pipes = dict.fromkeys(("stdin", "stdout", "stderr"), slave)
        soak.server("halcmd at a terminal", ["halcmd", "-kf"], at_terminal(master), 1, machine, **pipes)
    for name, words in (("latency-test", ["-", "1ms"]),
                        ("latency-histogram", ["--nobase", "--servo", "1000000", "--show"]),
                        ("latency-plot", ["-b", "1000000", "-s", "2000000"])):
        soak.window(name, [name, *words], session=f"{os.environ['KERF_INSTANCE']}{name[8:10]}")


def servers_of_a_machine(soak, ini, clock):
    def port():
        with socket.socket() as s:
            s.bind(("127.0.0.1", 0))
            return s.getsockname()[1]
    shell, schedule, rmt, http = port(), port(), port(), port()
    soak.server("linuxcncrsh", ["linuxcncrsh", "-q", "-p", str(shell), "--", "-ini", ini], conversation(
        shell, "HELLO EMC soak 1.1", (
            "SET ENABLE EMCTOO", "SET WAIT_MODE RECEIVED", "GET ESTOP", "GET REL_ACT_POS", "GET TOOL", "GET ERROR",
            "GET PROGRAM", "SET FEED_OVERRIDE 100", "NONSENSE", "HELP GET", "GET PLAT"), b"PLAT Linux"))
    soak.server("schedrmt", ["schedrmt", "-p", str(schedule), "--", "-ini", ini], conversation(
        schedule, "HELLO EMC soak 1.0", (
            "SET ENABLE EMCTOO", "GET QSTATUS", "GET PGMALL", "SET PGMADD 1 2 3 4 0 a.ngc 100 100 1", "SET QMODE STOP",
            "GET PLAT"), b"PLAT Linux", b"\r"))
    soak.server("halrmt", ["halrmt", "-q", "-p", str(rmt)], conversation(
        rmt, "HELLO EMC soak 1.0", (
            "SET ENABLE EMCTOO", "GET PINS siggen*", "GET SIGNALS", "SET SETS soak-float 1", "GET THREADS", "GET COMPS",
            "NONSENSE"), b"'NONSENSE'"))
    agent = Path("agent.ini")
    agent.write_text(f"{Path(ini).read_text()}\n[MTCONNECT]\nHTTP_PORT = {http}\nTRANSPORT = http, shdr\n"
                     f"SHDR_PORT = {port()}\n")
    soak.server("mtconnect-agent", ["mtconnect-agent", str(agent), "--port", str(http)], web(http), 1)
    listener = socket.create_server(("127.0.0.1", 0))
    soak.server("linuxcnclcd", ["linuxcnclcd", "-p", str(listener.getsockname()[1]), "-t", "0.002", "-ini", ini],
                lcd(listener), 5)
    soak.server("halstreamer", ["halstreamer"], poured, 10, stdin=subprocess.PIPE, text=True)
    soak.server("halsampler", ["halsampler", "-t"], drained, 10, stdout=subprocess.PIPE)
    from session import processes
    for name in ("milltask", "rtapi_app", "halui", "linuxcncsvr", "hal_manualtoolc"):
        for process in processes(name):
            soak.ticking(name, process, clock.now)


def beside_the_machine():
    """The display program of the machine."""
    from kerf import clock
    import mill
    scratch = Path.cwd() / "soak"
    scratch.mkdir()
    soak = Soak(scratch)
    ini = os.environ["INI_FILE_NAME"]
    mill.on()
    mill.program(PROGRAM)
    mill.c.auto(mill.AUTO_RUN, 0)
    mill.sleep(1)
    clock.suspend()
    windows_of_a_machine(soak, ini)
    windows_of_a_bench(soak)
    servers_of_a_machine(soak, ini, clock)
    clock.resume()
    def ended():
        mill.poll()
        print(f"the program runs: {mill.s.interp_state != mill.INTERP_IDLE}, {clock.now() / 3600:.2f} h of the machine")
        mill.c.abort()
    soak.closing.append(ended)

    def some_time():
        began = time.monotonic()
        mill.sleep(0.5)
        mill.messages()
        if REST:
            time.sleep((time.monotonic() - began) * REST / (1 - REST))      # we are in the clock: it stands still
    bad = soak.run(some_time)
    for name in bad:
        text = (scratch / f"{name}.log").read_text() if (scratch / f"{name}.log").exists() else ""
        print("GROWS or ended:", name, text[-1500:])


def main():
    lines = []
    for line in [*(text.format(t="servo-thread") for text in SOURCES), *STREAMS, *CHANGER, *TUNED]:
        lines += ["-hal", line]
    REPORT.unlink(missing_ok=True)
    env = dict(os.environ, HOURS=str(HOURS), REPORT=str(REPORT), MACHINE_TEST_S=str(MINUTES * 60 + 600))
    machine = [TOP / "tests/lib/with-display", "1600x1200", TOP / "tests/task/lib/machine-test", HERE]
    done = subprocess.run([*machine, *lines, "HAL.HALUI=halui",
                           "TUNE.PGAIN=100", "TUNE.IGAIN=3", "TUNE.FF1=1"], env=env)
    table = REPORT.read_text() if REPORT.exists() else "it did not begin"
    print(table)
    sys.exit(done.returncode or any(word in table for word in ("GROWS", "never looked", "not begin")))


if __name__ == "__main__":
    beside_the_machine() if "INI_FILE_NAME" in os.environ else main()
