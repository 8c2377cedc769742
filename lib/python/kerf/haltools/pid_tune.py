# SPDX-License-Identifier: GPL-2.0-or-later
"""pid-tune: finds the gains of a PID controller (component pid), within bounds, and shows what they are worth.

The controller's own tuning lets the output switch between two levels. Here it is watched: where the error leaves its
bounds, or nothing comes of it in time, all is as it was before. Old and new gains are compared by the response to a
step, a constant that is added to the output for a while; new gains that do not settle are made smaller, or not taken.
"""

import argparse
import math
import signal
import sys
from dataclasses import dataclass

import hal

from .. import clock
from .session import ToolError

GAINS = ("Pgain", "Igain", "Dgain")
FEED_FORWARD = ("FF0", "FF1", "FF2", "FF3")
STEP_S = 0.001          # between two looks
REST_S = 0.2            # that the error is watched before anything is done
SETTLED = 0.1           # of the peak: the response has settled
MOST_SWINGS = 3         # beyond that after the peak
LEAST_STEPS = 3         # of the feedback in the amplitude of the oscillation
SMALLER = {"Pgain": 0.6, "Igain": 0.36, "Dgain": 0.8}   # factors for gains that do not settle
TRIES = 5


class OutOfBounds(ToolError):
    """The error is too great."""


@dataclass
class Response:
    """To a step of the output: greatest error, time until it stays small (None: it never does), changes of side."""
    peak: float
    settling: float | None
    swings: int

    def good(self):
        return self.settling is not None and self.swings <= MOST_SWINGS

    def __str__(self):
        settled = "does not settle" if self.settling is None else f"settles in {self.settling * 1000:.0f} ms"
        return f"greatest error {self.peak:.6g}, {settled}, {self.swings} swings"


def response_of(samples, rest):
    """samples: (time from the step, error); rest: the error that it ends at, if at all."""
    peak = max(abs(e - rest) for _, e in samples)
    band = SETTLED * peak
    outside = [(t, e - rest) for t, e in samples if abs(e - rest) > band]
    last = outside[-1][0] if outside else 0.0
    sides = [e > 0 for _, e in outside]
    return Response(peak, None if last > 0.8 * samples[-1][0] else last,
                    sum(a != b for a, b in zip(sides, sides[1:])))


def gains_of(ultimate, period, without_d):
    """By the rule of Tyreus and Luyben, which is meant for plants that integrate, as a position does: gentler than the
    one that the component uses."""
    p = ultimate / (3.2 if without_d else 2.2)
    return {"Pgain": p, "Igain": p / (2.2 * period), "Dgain": 0.0 if without_d else p * period / 6.3}


class Controller:
    """The pins of a controller."""

    def __init__(self, name, most_error):
        self.name, self.most_error = name, most_error
        try:
            self.get("tune-mode")
        except RuntimeError:
            raise ToolError(f"there is no PID controller {name} (halcmd show pin *.tune-mode lists them)") from None

    def get(self, pin):
        return hal.get_value(f"{self.name}.{pin}")

    def set(self, pin, value):
        try:
            hal.set_p(f"{self.name}.{pin}", str(value))
        except RuntimeError as error:
            raise ToolError(f"{self.name}.{pin} cannot be set: {error}. A gain that a signal drives cannot be tuned: "
                            "set it by setp instead") from None

    def values(self, names):
        return {name: self.get(name) for name in names}

    def set_all(self, values):
        for name, value in values.items():
            self.set(name, value)

    def ultimate(self):
        """Gain and period of the oscillation that the component has made its gains of (its page tells the rule)."""
        gain = self.get("Pgain") / 0.6
        return gain, 1.2 * gain / self.get("Igain")

    def look(self):
        """The error now. Raises OutOfBounds, and ToolError when the controller was switched off."""
        if not self.get("enable"):
            raise ToolError(f"{self.name} was switched off (its enable is FALSE): by a following error, or by somebody")
        error = self.get("command") - self.get("feedback")
        if abs(error) > self.most_error:
            raise OutOfBounds(f"the error became {error:.6g}, more than {self.most_error:g}")
        return error

    def record(self, seconds):
        """[(time, error)]"""
        begin, found = clock.now(), []
        while (now := clock.now() - begin) < seconds:
            found.append((now, self.look()))
            clock.sleep(STEP_S)
        return found

    def at_rest(self):
        """The error of a machine that stands. Raises ToolError when it does not."""
        before = self.get("command")
        errors = [e for _, e in self.record(REST_S)]
        if self.get("command") != before:
            raise ToolError(f"the command of {self.name} moves: let the machine stand")
        return sum(errors) / len(errors)

    def step(self, height, seconds):
        """The response to a step of the output by height."""
        rest, bias = self.at_rest(), self.get("bias")
        try:
            self.set("bias", bias + height)
            samples = self.record(seconds)
        finally:
            self.set("bias", bias)
        if self.get("Igain") == 0:  # without it the error stays where output and step are equal
            rest = samples[-1][1]
            samples.insert(0, (0.0, rest))
        self.record(seconds)
        return response_of(samples, rest)

    def oscillate(self, effort, half_cycles, most_s):
        """Lets the controller tune itself; the smallest change of its feedback that was seen."""
        self.set_all({"tune-effort": effort, "tune-cycles": half_cycles, "tune-type": 0, "tune-mode": 1})
        begin, smallest, before = clock.now(), math.inf, self.get("feedback")
        try:
            clock.sleep(5 * STEP_S)
            self.set("tune-start", 1)
            while self.get("tune-start"):
                self.look()
                now = self.get("feedback")
                if now != before:
                    smallest, before = min(smallest, abs(now - before)), now
                if clock.now() - begin > most_s:
                    raise ToolError(f"no oscillation of {half_cycles} half cycles within {most_s:g} s: see whether the "
                                    "motor follows the output; a greater --effort makes it stronger")
                clock.sleep(STEP_S)
        finally:
            self.set_all({"tune-start": 0, "tune-mode": 0})
        return smallest


def tune(pid, options, say):
    """Leaves the controller with its new gains, or raises ToolError and leaves it with the old ones."""
    if not pid.get("enable"):
        raise ToolError(f"{pid.name} is not enabled: turn the machine on, home it, and let it stand in the middle of "
                        "its travel")
    before = pid.values(GAINS + FEED_FORWARD)
    pid.set_all(before)  # can they be set?
    effort = options.effort if options.effort is not None else pid.get("tune-effort")
    height = options.height if options.height is not None else effort / 10
    try:
        pid.at_rest()
        old = None
        try:
            old = pid.step(height, options.step)
            say(f"with the present gains a step of {height:g}: {old}")
        except OutOfBounds as error:
            say(f"with the present gains a step of {height:g} is not held: {error}")
        try:
            resolution = pid.oscillate(effort, options.cycles, options.seconds)
        except OutOfBounds as error:
            raise ToolError(f"{error}: a smaller --effort swings less; where one side alone grows, feedback and output "
                            "have opposite signs") from None
        ultimate, period = pid.ultimate()
        amplitude = 4 * effort / (math.pi * ultimate)
        say(f"oscillates by {amplitude:.6g} with a period of {period * 1000:.3g} ms: ultimate gain {ultimate:.6g}")
        if amplitude < LEAST_STEPS * resolution:
            raise ToolError(f"the oscillation is only {amplitude:.6g}, the feedback changes by {resolution:.6g} at "
                            "least: a greater --effort gives a result that can be trusted")
        found = gains_of(ultimate, period, options.pi)
        for _ in range(TRIES):
            pid.set_all(before | found)
            gains = "gains " + ", ".join(f"{n} {found[n]:.6g}" for n in GAINS)
            try:
                clock.sleep(options.step)
                new = pid.step(height, options.step)
                say(f"{gains}, a step of {height:g}: {new}")
                if new.good():
                    return before, old, found, new
            except OutOfBounds as error:
                say(f"{gains}: {error}")
            pid.set_all(before)
            clock.sleep(options.step)
            found = {name: value * SMALLER[name] for name, value in found.items()}
        raise ToolError("no gains were found that settle")
    except ToolError as error:
        pid.set_all(before)
        raise ToolError(f"{error}. The gains are as before") from None
    except BaseException:
        pid.set_all(before)
        raise


def report(pid, before, old, found, new, say):
    say("")
    say(f"{pid.name:12}{'before':>14}{'now':>14}")
    for name in GAINS:
        say(f"{name:12}{before[name]:14.6g}{found[name]:14.6g}")
    if old:
        say(f"{'peak error':12}{old.peak:14.6g}{new.peak:14.6g}")
    ms = lambda r: "never" if r is None or r.settling is None else f"{r.settling * 1000:.0f} ms"
    say(f"{'settles in':12}{ms(old):>14}{ms(new):>14}")
    say("")
    say("The gains are in force until HAL ends. To keep them write them where the HAL files take them from, usually")
    for letter, name in zip("PID", GAINS):
        say(f"    {letter} = {found[name]:.6g}")
    say("in [JOINT_n] of the INI file (emccalib does so). Feed forward is as before.")


def main(words):
    parser = argparse.ArgumentParser(prog="pid-tune", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("controller", help="name of the controller: pid.0, x-pid...")
    parser.add_argument("--effort", type=float, help="output that it switches to and from (pin tune-effort)")
    parser.add_argument("--most-error", type=float, required=True, help="error that ends the tuning, in machine units")
    parser.add_argument("--cycles", type=int, default=50, help="half cycles of the oscillation (50)")
    parser.add_argument("--seconds", type=float, default=30.0, help="that the oscillation may take (30)")
    parser.add_argument("--step", type=float, default=1.0, help="seconds that a step of the output lasts (1)")
    parser.add_argument("--height", type=float, help="of that step (a tenth of the effort)")
    parser.add_argument("--pi", action="store_true", help="no D: for feedback that is coarse or noisy")
    parser.add_argument("--yes", action="store_true", help="asks nothing")
    options = parser.parse_args(words)
    sizes = (options.most_error, options.step, options.seconds, options.effort, options.height)
    if options.cycles < 4 or any(size is not None and not size > 0 for size in sizes):
        parser.error("--most-error, --effort, --height, --step and --seconds must be greater than 0, --cycles 4 or more")
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    clock.join("pid-tune", 900)
    try:
        pid = Controller(options.controller, options.most_error)
        if not options.yes:
            print(f"{options.controller}: the motor will swing, by up to {options.most_error:g}, and be pushed aside. The\n"
                  "machine must be homed and stand in the middle of its travel, with nothing in its way and the emergency\n"
                  "stop at hand. A following error ends it, too: [JOINT_n]MIN_FERROR is the bound that realtime keeps.\n"
                  "Enter goes on, Ctrl-C ends: ", end="", flush=True)
            clock.suspend()
            sys.stdin.readline()
            clock.resume()
        report(pid, *tune(pid, options, print), print)
    except ToolError as error:
        print(f"pid-tune: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("\npid-tune: stopped. The gains are as before.", file=sys.stderr)
        return 1
    return 0
