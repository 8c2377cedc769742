# SPDX-License-Identifier: GPL-2.0-or-later
# mdi, linuxcnctop -t and linuxcnclcd (with a display server of our own).
import os
import socket
import subprocess

from mill import *


def run_tool(*words, text=None):
    """What a tool prints; time goes on while it runs."""
    clock.suspend()
    done = subprocess.run(words, input=text, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=60,
                          env={k: v for k, v in os.environ.items() if k != "KERF_CLOCK_SLOT"})
    clock.resume()
    return f"{done.returncode} {done.stdout}"


print("mistakes:")
for words in (["mdi", "X" * 255], ["mdi", b"G0 X1 (\xff)"], ["linuxcnclcd", "-ini", "nothere.ini"],
              ["linuxcnctop", "-t", "-ini", "nothere.ini"], ["teach-in", "linuxcnc.nml", "/nowhere/out"]):
    print(" ", run_tool(*words).strip().replace("\n", " / "))
print("  typed:", run_tool("mdi", text="X" * 255 + "\n''\n").replace("MDI> ", "").split("\n")[0])
print("mdi in estop:", run_tool("mdi", "G0", "X1"), messages())
on()
print("mdi:", run_tool("mdi", "G0", "X5", "Y-2"))
idle()
print(xyz(3), poll().task_mode == MODE_MDI)
print("mdi typed:", run_tool("mdi", text="'G0 X1.5'\nG0 Y2\n''\n").replace(str(0.0), "").count("MDI> "))
sleep(1)
c.mdi("G0 X1.5")
c.wait_complete()
print(xyz(3))
mdi("T1 M6 G43")
mdi("G54 S100")
lines = run_tool("linuxcnctop", "-ini", "mill.ini", "-t").split("\n")
wanted = ("task_mode", "task_state", "exec_state", "interp_state", "state", "motion_mode", "motion_type",
          "program_units", "kinematics_type", "gcodes", "mcodes", "position", "tool_in_spindle", "file", "estop",
          "joint_position")
print("linuxcnctop:", lines[0].split()[0])
for line in [lines[0][2:]] + lines[1:]:
    if line[:20].strip() in wanted:
        print(line.rstrip())
skipped = {"poll", "tool_table", "axis", "joint", "gettaskfile"}
print("skipped:", not skipped & {line[:20].strip() for line in lines}, "all of one width:",
      all(len(line) <= 80 for line in lines))

mode(MODE_AUTO)
Path("no\udcffutf8.ngc").write_text("M2\n")
c.program_open(os.path.abspath("no\udcffutf8.ngc"))
c.wait_complete()
print("a name that is no UTF-8:", [line.split("/")[-1] for line in run_tool("linuxcnctop", "-t").split("\n")
                                   if line.startswith("file ")])
print("== linuxcnclcd")
server = socket.create_server(("127.0.0.1", 0))
port = server.getsockname()[1]
tool = subprocess.Popen(["linuxcnclcd", "-p", str(port), "-t", "0.05", "-ini", "mill.ini"])
server.settimeout(20)
clock.suspend()
lcd, _ = server.accept()
lcd.settimeout(20)


def lines_until(text):
    data = b""
    while text not in data:
        data += lcd.recv(4096)
    return data.decode().splitlines()


print(lines_until(b"hello\n"))
lcd.sendall(b"connect LCDproc 0.5.9 protocol 0.3 lcd wid 20 hgt 4 cellwid 5 cellhgt 8\nlisten linuxcnc\n")
for line in lines_until(b"line3 1 4"):
    print(line)
clock.resume()
mdi("G10 L2 P1 X1 Y2 R90")
mdi("G92 X5")
clock.suspend()
print("rotated and shifted:", any("{X     5.000 " in line for line in lines_until(b"X     5.000")))
clock.resume()
mdi("G92.1")
mdi("G10 L2 P1 X0 Y0 R0")
c.mdi("G4 P100000")
need(lambda s: s.exec_state == EXEC_WAITING_FOR_DELAY, "dwell")
clock.suspend()
lines_until(b"run")
lcd.sendall(b"success\nkey Escape\n")
lines_until(b"idle")
clock.resume()
need(lambda s: s.interp_state == INTERP_IDLE, "abort")
print("Escape aborts")
tool.terminate()
clock.suspend()
print(tool.wait(20))
clock.resume()
c.state(STATE_ESTOP)
need(lambda s: s.task_state == STATE_ESTOP, "emergency stop")
tool = subprocess.Popen(["linuxcnclcd", "-a", "-d", "CFontz", "-s", "localhost", "-p", str(port), "-ini", "mill.ini"])
clock.suspend()
lcd, _ = server.accept()
lcd.settimeout(20)
lcd.sendall(b"connect LCDproc 0.5.9 protocol 0.3 lcd wid 20 hgt 4 cellwid 5 cellhgt 8\n")
print([line for line in lines_until(b"line3 1 4") if "name" in line])
clock.resume()
print("autostart:", until(lambda s: s.task_state == STATE_ON, 60))
tool.terminate()
clock.suspend()
tool.wait(20)
clock.resume()
server.close()
print("no display server:", run_tool("linuxcnclcd", "-p", str(1), "-ini", "mill.ini").split(":")[0])
