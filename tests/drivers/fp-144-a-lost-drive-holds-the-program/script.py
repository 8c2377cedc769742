# SPDX-License-Identifier: GPL-2.0-or-later
import configparser
from pathlib import Path

import hal
from mill import *
from modbus_device import TcpDevice

COMMAND, LIMIT, TURNS = 0xFA00, 0x0012, 0x500
settings = configparser.ConfigParser()
settings.read("drive.ini")
drive = TcpDevice(int(settings["VFS11"]["PORT"]), 0x10000)
drive.holding[LIMIT] = 8000
told = []
drive.watch = lambda address, value: address == COMMAND and told.append(value)


def turns():
    return bool(drive.holding[COMMAND] & TURNS)


on()
need(lambda s: hal.get_value("drive.modbus-ok"), "answers of the drive")
Path("part.ngc").write_text("G21 G90 F600\nM3 S1000\nG1 X0\nG1 X60\nM2\n")
mode(MODE_AUTO)
c.program_open(str(Path("part.ngc").resolve()))
c.auto(AUTO_RUN, 0)
need(lambda s: s.position[0] > 1 and turns(), "cut")
print("cuts:", poll().paused)
for what in ("silent", "unplugged"):
    if what == "unplugged":
        port = drive.port
        drive.stop()
    drive.silent = True
    need(lambda s: s.paused and s.interp_state == INTERP_PAUSED and s.current_vel == 0, "hold")
    told.clear()
    held = poll().position[0]
    print(what + ": the program is held, off its end:", held < 60, "at speed:", hal.get_value("drive.at-speed"))
    drive.silent = False
    if what == "unplugged":
        drive.start(port)
    need(lambda s: hal.get_value("drive.modbus-ok"), "connection")
    print("there again: the first that it hears is no start:", bool(told) and not told[0] & TURNS, "it stands:",
          not turns(), "still held:", poll().paused, s.position[0] == held)
    c.spindle(SPINDLE_OFF)
    need(lambda s: not hal.get_value("spindle.0.on"), "spindle off")
    sleep(0.2)
    c.spindle(SPINDLE_FORWARD, 1000)
    need(lambda s: turns(), "spindle")
    c.auto(AUTO_RESUME)
    need(lambda s: s.current_vel > 0, "motion")
    sleep(0.3)
need(lambda s: s.interp_state == INTERP_IDLE, "end")
print("the program ends where it should:", round(poll().position[0], 4))
