#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Mitsubishi drives on a serial line (computer link, not Modbus) as HAL pins: one component for each.

mitsub_vfd [-p PORT] [-b BAUD] NAME=STATION ...

STATION: the drive's number on the line, two characters. Source: Modbus sheet, section 5.
"""

import argparse
import signal
import sys
import time
from pathlib import Path

here = Path(__file__).resolve().parent
if (here.parent / "lib/python/kerf").is_dir():
    sys.path.insert(0, str(here.parent / "lib/python"))

import hal
from kerf import clock
from kerf.serial_line import RATES, SerialLine

PROGRAM = "mitsub_vfd"
ENQ, STX, ETX, ACK, NAK = b"\x05", b"\x02", b"\x03", b"\x06", b"\x15"
WAIT = "1"                      # tens of ms that the drive waits before its answer
ANSWER_S, PAUSE_S, NAP_S = 0.3, 0.05, 0.01
REOPEN_S, RETRY_S = 1.0, 0.5
HEARTBEAT_S = 0.5               # without monitoring: a lost drive is noticed all the same
LOST_S, FAILURES = 1.0, 2       # no good answer for so long, and so many failures
STOP_TRIES = 5
STATUS, FREQUENCY, AMPS, VOLTS, SPECIAL = "7A", "6F", "70", "71", "72"
MONITORED = ((STATUS, None, 1), (FREQUENCY, "fb", 0.01), (AMPS, "amps", 0.01), (VOLTS, "volts", 0.01),
             (SPECIAL, "user", 1))
SELECT_SPECIAL, TURN, SET_FREQUENCY, RESET = "F3", "FA", "ED", "FD"
SPECIAL_MONITOR, RESET_DATA = "0E", "9696"
FORWARD, REVERSE, STOP = "02", "04", "00"
MOST = 40000                    # 0.01 Hz
UP_TO_SPEED, ALARM = 3, 7       # bits of the status
POWER = 2.7                     # motor-power: volts times amps times this


def checksum(text):
    return b"%02X" % (sum(text) & 0xFF)


def is_complete(answer):
    """ACK and station; NAK, station and code; STX, station, data, ETX and checksum."""
    if answer[:1] == STX:
        return 0 <= answer.find(ETX) <= len(answer) - 3
    return len(answer) >= {ACK: 3, NAK: 4}.get(answer[:1], 64)


class Refused(Exception):
    """The drive answers that it will not."""


class Link:
    """The line with all drives. Failures are told once."""

    def __init__(self, port, rate):
        self.port, self.rate, self.line, self.told = port, rate, None, {}
        self.due = self.free = 0.0

    def tell(self, what, text=None):
        """A new problem of `what`; without a text it is over."""
        if text and self.told.get(what) != text:
            print(f"{PROGRAM}: {what}: {text}", file=sys.stderr, flush=True)
        self.told[what] = text

    def open(self):
        if self.line is None and time.monotonic() >= self.due:
            try:
                self.line = SerialLine(self.port, self.rate, stop_bits=2)
                self.tell(self.port)
            except OSError as e:
                self.due = time.monotonic() + REOPEN_S
                self.tell(self.port, e.strerror)
        return self.line is not None

    def drop(self, error):
        self.tell(self.port, error.strerror)
        self.line.close()
        self.line, self.due = None, time.monotonic() + REOPEN_S

    def ask(self, station, command, data="", show=False):
        """Data of the answer ("": taken); None: no good answer. Raises Refused."""
        if not self.open():
            return None
        body = (station + command + WAIT + data).encode()
        time.sleep(max(self.free - time.monotonic(), 0))
        self.free = time.monotonic() + PAUSE_S
        try:
            answer = self.line.ask(ENQ + body + checksum(body), is_complete, ANSWER_S)
        except OSError as e:
            self.drop(e)
            return None
        if show:
            print(f"{PROGRAM}: {body} {answer}", flush=True)
        return self.judge(station, answer)

    @staticmethod
    def judge(station, answer):
        if answer[1:3] != station.encode():
            return None                 # silence, or another drive
        if answer[:1] == NAK:
            raise Refused(f"refuses, code {answer[3:4].decode(errors='replace')}")
        if answer[:1] == ACK:
            return ""
        end = answer.find(ETX)
        # some count ETX too
        good = answer[end + 1:end + 3] in (checksum(answer[1:end]), checksum(answer[1:end + 1]))
        return answer[3:end].decode(errors="replace") if good else None


class Guard:
    """Whether a spindle may run: not while its drive is lost or held, and after that and at the start not before the
    command to run has been seen FALSE while the drive answered."""

    def __init__(self):
        self.lost, self.armed, self.bad, self.last_good = True, False, 0, 0.0

    def answered(self, good, connected):
        now = time.monotonic()
        if good:
            self.lost, self.bad, self.last_good = False, 0, now
            return
        self.bad += 1
        if not connected or (self.bad >= FAILURES and now - self.last_good >= LOST_S):
            self.lost, self.armed = True, False

    def may_run(self, wanted, held):
        if not wanted and not self.lost:
            self.armed = True
        if wanted and held:
            self.armed = False
        return wanted and not held and self.armed


class Drive:
    def __init__(self, link, name, station):
        self.link, self.name, self.station = link, name, station
        self.guard, self.due, self.beat, self.next = Guard(), 0.0, 0.0, 0
        self.turns = self.frequency = None      # what the drive has taken
        self.selected = self.estop_used = self.was_free = False
        self.pins = hal.component(name)
        for pin in ("fwd", "run", "debug", "monitor", "estop", "reset-on-estop"):
            self.pins.newpin(pin, hal.HAL_BIT, hal.HAL_IN)
        for pin in ("up-to-speed", "alarm", *(f"stat-bit-{bit}" for bit in range(8))):
            self.pins.newpin(pin, hal.HAL_BIT, hal.HAL_OUT)
        self.pins.newpin("motor-cmd", hal.HAL_FLOAT, hal.HAL_IN)
        for pin in ("fb", "amps", "volts", "power", "user"):
            self.pins.newpin(f"motor-{pin}", hal.HAL_FLOAT, hal.HAL_OUT)
        for pin in ("cmd", "fb", "amps", "volts", "power", "user"):
            self.pins.newpin(f"scale-{pin}", hal.HAL_FLOAT, hal.HAL_IN)
            self.pins[f"scale-{pin}"] = 1
        self.pins["fwd"] = True

    def ask(self, command, data=""):
        """Data of the answer; None: no good answer, or refused."""
        what = f"{self.name} (station {self.station})"
        try:
            answer = self.link.ask(self.station, command, data, self.pins["debug"])
            self.guard.answered(answer is not None, self.link.line is not None)
            self.link.tell(what, "no good answer" if self.guard.lost and self.link.line is not None else None)
            return answer
        except Refused as e:
            self.guard.answered(True, True)     # it is there
            self.link.tell(f"{what}, command {command}", str(e))
            return None

    def write(self, command, data):
        return self.ask(command, data) is not None

    def wanted_frequency(self):
        """0.01 Hz"""
        value = abs(self.pins["motor-cmd"] * 100 * self.pins["scale-cmd"])
        return min(int(value), MOST) if value < float("inf") else 0

    def is_held(self):
        """Emergency stop: FALSE, once `estop` has been TRUE; a pin that nobody uses stays FALSE. Resets when it ends."""
        free = self.pins["estop"]
        self.estop_used = self.estop_used or free
        if free and not self.was_free and self.pins["reset-on-estop"]:
            self.stop()
            self.ask(RESET, RESET_DATA)         # the drive begins anew, without an answer
            self.selected, self.frequency = False, None
        self.was_free = free
        return self.estop_used and not free

    def stop(self):
        if self.turns != STOP and self.write(TURN, STOP):
            self.turns = STOP
        return self.turns == STOP

    def step(self):
        wanted, held = self.pins["run"], self.is_held()
        run = self.guard.may_run(wanted, held)
        now = time.monotonic()
        if now < self.due:
            return
        if not self.command(run) or not self.look(now):
            self.pins["up-to-speed"] = False
        if self.guard.lost:                     # when it is back it stops first
            self.turns = self.frequency = None
            self.selected = False
            self.due = now + RETRY_S

    def command(self, run):
        """False: the drive has not taken all."""
        if not run and not self.stop():
            return False
        if not self.selected:
            self.ask(SELECT_SPECIAL, SPECIAL_MONITOR)
            self.selected = True
        frequency = self.wanted_frequency()
        if frequency != self.frequency:
            self.frequency = frequency if self.write(SET_FREQUENCY, f"{frequency:04X}") else None
        if not run:
            return True
        turns = FORWARD if self.pins["fwd"] else REVERSE
        if turns != self.turns and self.frequency is not None:
            self.turns = turns if self.write(TURN, turns) else None
        return self.turns == turns

    def value(self, command, digits):
        """None: no good answer."""
        text = self.ask(command)
        try:
            return int(text[:digits], 16) if text else None
        except ValueError:
            return None

    def look(self, now):
        """One request, so that a stop does not wait for many. False: what is known is not true any more."""
        if not self.pins["monitor"]:
            if now >= self.beat:
                self.beat = now + HEARTBEAT_S
                self.ask(FREQUENCY)
            return False
        command, pin, scale = MONITORED[self.next]
        self.next = (self.next + 1) % len(MONITORED)
        value = self.value(command, 2 if command == STATUS else 4)
        if value is None:
            return command != STATUS and not self.guard.lost
        if command == STATUS:
            self.show_status(value)
        else:
            self.pins[f"motor-{pin}"] = value * scale * self.pins[f"scale-{pin}"]
        self.pins["motor-power"] = self.pins["motor-volts"] * self.pins["motor-amps"] * POWER
        return True

    def show_status(self, status):
        for bit in range(8):
            self.pins[f"stat-bit-{bit}"] = bool(status >> bit & 1)
        self.pins["up-to-speed"] = bool(status >> UP_TO_SPEED & 1)
        self.pins["alarm"] = bool(status >> ALARM & 1)
        if self.pins["alarm"]:
            self.guard.armed = False            # its reset does not start the spindle

    def end(self):
        self.turns = None
        for _try in range(STOP_TRIES):
            if self.stop():
                return
        print(f"{PROGRAM}: {self.name}: ERROR: the drive did not take the stop: it may turn", file=sys.stderr)


def station(text):
    name, equals, number = text.partition("=")
    if not name or not equals or len(number) != 2 or not number.isascii():
        raise argparse.ArgumentTypeError(f"{text}: must be NAME=STATION, the station with two characters")
    return name, number


def arguments(words):
    parser = argparse.ArgumentParser(prog=PROGRAM, description="Mitsubishi drives (computer link) as HAL pins.")
    parser.add_argument("-p", "--port", default="/dev/ttyS0", help="serial line (%(default)s)")
    parser.add_argument("-b", "--baud", type=int, default=9600, help="bits a second (%(default)s)")
    parser.add_argument("drives", metavar="NAME=STATION", nargs="*", type=station,
                        help="component and number of a drive (mitsub_vfd=00)")
    options = parser.parse_args(words)
    if options.baud not in RATES:
        parser.error(f"baud {options.baud}: a serial line has no such rate")
    return options


def main():
    options = arguments(sys.argv[1:])
    link = Link(options.port, options.baud)
    link.open()
    drives = [Drive(link, *words) for words in options.drives or [(PROGRAM, "00")]]
    clock.join(PROGRAM, 500)
    clock.leave()                               # the drives live in real time
    ends = []
    for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
        if number != signal.SIGHUP or signal.getsignal(number) != signal.SIG_IGN:      # not under nohup
            signal.signal(number, lambda *_: ends.append(True))
    for drive in drives:
        drive.pins.ready()
    while not ends:
        for drive in drives:
            drive.step()
        time.sleep(NAP_S)
    for drive in drives:
        drive.end()


if __name__ == "__main__":
    main()
