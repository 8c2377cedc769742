# SPDX-License-Identifier: GPL-2.0-or-later
"""A realtime session for a measuring tool, and what to know of the machine it runs on."""

import contextlib
import os
import signal
import subprocess
import sys
from pathlib import Path

from .. import clock
from ..language import _
from ..tree import Tree

SETTLE_S = 0.02         # for a thread to see that a pin was set
CPU = Path("/sys/devices/system/cpu")


class ToolError(Exception):
    """Ends a tool with exit status 1; the text is for the user."""


def lost(error: Exception) -> ToolError:
    """What a tool ends with whose figures cannot be read any more."""
    return ToolError(f"nothing is measured any more: the realtime session was ended or changed ({error})")


@contextlib.contextmanager
def measuring():
    """Raises ToolError where pins or streams are not there any more."""
    try:
        yield
    except (RuntimeError, TypeError) as error:
        raise lost(error) from None


def halcmd(*words: str) -> str:
    """Executes a HAL command; its output. Raises ToolError with its complaint."""
    done = clock.run(["halcmd", *words], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                     text=True)
    if done.returncode:
        raise ToolError(done.stderr.strip() or f"halcmd {' '.join(words)} failed")
    return done.stdout


def realtime(command: str, **options) -> subprocess.CompletedProcess:
    script = os.environ.get("REALTIME") or str(Tree.find().realtime)
    return clock.run([script, command], stdin=subprocess.DEVNULL, **options)


def realtime_running() -> bool:
    return realtime("status", stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode == 0


class RealtimeSession:
    """A realtime process of our own, ended with all that was loaded when the block is left."""

    def __enter__(self):
        if realtime_running():
            raise ToolError("Realtime is running already: end the running session first (halrun -U)")
        if realtime("start").returncode:
            raise ToolError("the realtime system did not start")
        return self

    def __exit__(self, *exception):
        for words in (("stop",), ("unload", "all")):
            try:
                halcmd(*words)
            except ToolError as problem:
                print(problem, file=sys.stderr)
        realtime("stop")
        return False


def run_tool(program: str, work, own_session: bool) -> int:
    """Calls work(), in a realtime session of its own or in the one that runs; the exit status. Interrupts end it."""
    clock.join(program)
    for number in (signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(number) is signal.SIG_DFL:
            signal.signal(number, signal.default_int_handler)
    try:
        with RealtimeSession() if own_session else contextlib.nullcontext():
            work()
    except KeyboardInterrupt:
        pass
    except BrokenPipeError:             # nobody reads any more
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except ToolError as problem:
        print(f"{program}: {problem}", file=sys.stderr)
        return 1
    finally:
        clock.leave()
    return 0


def each_second(lines, seconds: int, pause_s: float = 1.0):
    """Prints lines(elapsed seconds) once a second; `seconds` 0: for ever. pause_s: less where
    lines() takes time itself."""
    start = clock.now()
    while True:
        clock.sleep(pause_s)
        elapsed = round(clock.now() - start)
        with measuring():
            found = list(lines(elapsed))
        for line in found:
            print(line, flush=True)
        if seconds and elapsed >= seconds:
            return


def pulse(*pins: str):
    """Sets them for as long as a thread needs to see it, then clears them."""
    import hal
    for value in ("1", "0"):
        for pin in pins:
            hal.set_p(pin, value)
        if value == "1":
            clock.sleep(SETTLE_S)


def fetch(streams: dict) -> list[list]:
    """What the component of each prefix sends into its stream when asked. streams: hal.stream by prefix."""
    import hal
    for prefix, stream in streams.items():
        while stream.readable:
            stream.read()
        hal.set_p(f"{prefix}.stream", "1")
    clock.sleep(SETTLE_S)
    found = []
    for prefix, stream in streams.items():
        values = []
        while stream.readable:
            values.append(stream.read()[0])
        found.append(values)
        hal.set_p(f"{prefix}.stream", "0")
    clock.sleep(SETTLE_S)
    return found


def _read(path: Path) -> str:
    try:
        return path.read_text().strip()
    except OSError:
        return ""


def facts(platform) -> list[str]:
    """Kind of realtime, governor and isolated processors of a Platform."""
    return [_("realtime: %s") % platform.realtime, _("governor: %s") % (",".join(platform.governors) or _("unknown")),
            _("isolcpus: %s") % (platform.isolated or _("none"))]


class Platform:
    """What decides whether a latency measurement says anything: kind of realtime, clock
    governor of the processors, processors kept free of other work."""

    def __init__(self):
        verify = realtime("verify", stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.is_realtime = verify.returncode == 0
        self.realtime = verify.stdout.strip() or "No realtime"
        self.governors = sorted({_read(p) for p in CPU.glob("cpu[0-9]*/cpufreq/scaling_governor")} - {""})
        self.isolated = _read(CPU / "isolated")
        self.kernel = os.uname().release
        self.virtual_clock = clock.is_virtual()

    def text(self) -> str:
        """One line."""
        return "; ".join(facts(self))

    def doubts(self) -> list[str]:
        """Reasons why figures from this run are no measure of the machine; empty: none."""
        found = []
        if self.virtual_clock:
            found.append(_("time is simulated: these figures say nothing about latency"))
        if not self.is_realtime:
            found.append(_("no realtime scheduling (%s): expect latencies of milliseconds; see 'realtime verify'")
                         % self.realtime)
        slow = [g for g in self.governors if g not in ("performance",)]
        if slow:
            found.append(_("processor governor is %s, not performance") % ",".join(slow))
        if self.is_realtime and not self.isolated and (os.cpu_count() or 1) > 1:
            found.append(_("no processor is isolated (isolcpus)"))
        return found

    def banner(self) -> str:
        lines = [self.text()]
        lines += [_("NOT REPRESENTATIVE: %s") % doubt for doubt in self.doubts()]
        return "\n".join(lines)
