# SPDX-License-Identifier: GPL-2.0-or-later
# FP-120, FP-121: done, failed, aborted and late are different ends; a sequence goes on after done only.
import linuxcnc as module
from kerf.sequence import *
from mill import *

on()


def attempt(what, steps):
    """Runs the steps; how far it came and why it ended."""
    done = []
    try:
        with Sequence() as run:
            for step in steps:
                step(run)
                done.append(len(done) + 1)
    except Broken as broken:
        print(f"{what}: {len(done)} done, {type(broken).__name__}: {broken}")
        try:
            run.mdi("G0 X99")
        except Ended as ended:
            print("   then", type(ended).__name__)
    else:
        print(f"{what}: {len(done)} done")
    sleep(0.1)
    messages()
    print("   at", xyz(2))


mdi_ = lambda line, **k: lambda run: run.mdi(line, **k)
mode_ = lambda run: run.mode(MODE_MDI)
attempt("all good", [mode_, mdi_("G0 X1"), mdi_("G0 X2")])
attempt("a wrong line", [mode_, mdi_("G0 X3"), mdi_("G1 F0 X4"), mdi_("G0 X5")])
attempt("a probe without contact", [mode_, mdi_("G0 Z0"), mdi_("G38.2 Z-1 F600"), mdi_("G0 X6")])
attempt("too late", [mode_, mdi_("G4 P3", timeout=0.5), mdi_("G0 X7")])
c.abort()
c.wait_complete()


def intruder(run):
    """Another client aborts while the dwell runs."""
    other = module.command()
    poll_once = run.stat.poll
    calls = []

    class Stat:
        def poll(self):
            calls.append(1)
            if len(calls) == 20:
                other.abort()
            poll_once()

        def __getattr__(self, name):
            return getattr(stat, name)

    stat, run.stat = run.stat, Stat()
    run.mdi("G4 P100")


attempt("aborted by another", [mode_, intruder, mdi_("G0 X8")])
attempt("another one between two steps", [mode_, lambda run: module.command().mode(MODE_MDI), mdi_("G0 X9")])
c.state(STATE_ESTOP)
attempt("estop", [lambda run: run.mode(MODE_MDI), mdi_("G0 X10")])
on(home=False)
c.mode(MODE_MDI)
try:
    with Sequence() as run:
        c.mdi("G4 P1000")
        raise KeyError("the client's own mistake")
except KeyError:
    print("nothing is left running:", until(lambda s: s.interp_state == INTERP_IDLE, 1))
