#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""clients_bench.py: how fast clients get through to the controller, in real time.

Prints the speed of an NML queue, starts the simulated mill and prints the time from the launcher's start to the
screen's, from a Python command to its effect in the status (median, 99 %), and status polls a second with 1, 10 and
50 clients.
"""
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from multiprocessing import Barrier, Process, Queue
from pathlib import Path

top = Path(__file__).resolve().parents[4]


def latency(n=1000):
    """(seconds until the call returns, seconds until the status shows it), sorted."""
    import linuxcnc

    stat, command = linuxcnc.stat(), linuxcnc.command()
    returned, shown = [], []
    for i in range(n):
        value = 0.5 + (i % 100) / 1000
        begin = time.monotonic()
        command.feedrate(value)
        returned.append(time.monotonic() - begin)
        stat.poll()
        while stat.feedrate != value:
            stat.poll()
        shown.append(time.monotonic() - begin)
    return sorted(returned), sorted(shown)


def poller(barrier, results, seconds):
    import linuxcnc

    stat, n, fresh, last = linuxcnc.stat(), 0, 0, None
    stat.poll()
    barrier.wait()
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        for _ in range(20):
            stat.poll()
            n += 1
            beat = stat.taskbeat
            fresh += beat != last
            last = beat
    results.put((n, fresh))


def polls(clients, seconds=2.0):
    barrier, results = Barrier(clients), Queue()
    all_ = [Process(target=poller, args=(barrier, results, seconds)) for _ in range(clients)]
    for p in all_:
        p.start()
    counts = [results.get() for _ in all_]
    for p in all_:
        p.join()
    return sum(n for n, _ in counts) / seconds, statistics.mean(f for _, f in counts) / seconds


def measure():
    import linuxcnc

    print(f"launcher to screen: {time.time() - float(os.environ['BENCH_BEGIN']):.2f} s")
    stat, command = linuxcnc.stat(), linuxcnc.command()
    command.state(linuxcnc.STATE_ESTOP_RESET)
    command.state(linuxcnc.STATE_ON)
    for what, times in zip(("call returns", "status shows it"), latency()):
        print(f"command.feedrate, {what}: median {times[len(times) // 2] * 1e3:.2f} ms, 99 % "
              f"{times[len(times) * 99 // 100] * 1e3:.2f} ms")
    for n in (1, 10, 50):
        total, fresh = polls(n)
        print(f"{n:2d} clients: {total:9.0f} polls/s together, each sees {fresh:.0f} new ones/s")
    beat = stat.poll() or stat.taskbeat
    time.sleep(1)
    stat.poll()
    print(f"task cycles/s meanwhile: {stat.taskbeat - beat}")


def queue_speed(messages=16000):
    """Messages a second through one queue, from eight clients at once."""
    env = dict(os.environ, KERF_INSTANCE=f"{os.environ.get('KERF_INSTANCE', '')[:8]}b{os.getpid() % 1000}")
    begin = time.monotonic()
    subprocess.run([top / "objects/test/nml-test", "many-clients-lose-nothing"], env=env, check=True,
                   stdout=subprocess.DEVNULL)
    print(f"NML queue, 8 writers: {messages / (time.monotonic() - begin):.0f} messages/s")


def main():
    queue_speed()
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch) / "mill"
        shutil.copytree(top / "configs/sim/mill", folder)
        ini = (folder / "mill.ini").read_text().replace("DISPLAY = axis",
                                                        "DISPLAY = ./display").replace("HALUI = halui", "")
        (folder / "mill.ini").write_text(ini)
        (folder / "display").write_text(f"#!/bin/sh\nexec /usr/bin/python3 {Path(__file__).resolve()} "
                                        "measure > out 2>&1\n")
        (folder / "display").chmod(0o755)
        env = dict(os.environ, BENCH_BEGIN=str(time.time()), HOME=scratch)
        done = subprocess.run(["linuxcnc", "-r", "mill.ini"], cwd=folder, env=env, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True)
        print((folder / "out").read_text() if (folder / "out").exists() else done.stdout, end="")
        return done.returncode


if __name__ == "__main__":
    sys.exit(measure() if sys.argv[1:] == ["measure"] else main())
