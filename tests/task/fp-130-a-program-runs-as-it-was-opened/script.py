# SPDX-License-Identifier: GPL-2.0-or-later
import hashlib
import os

from mill import *

LINES = 60000                    # more than are read ahead, or in one piece
MAIN = "G21 G90 G64 F6000\n" + "G1 X0.2\nG1 X0\n" * 600 + "(more)\n" * LINES + "G1 X1 Y{}\nM2\n"
CALLER = "G21 G90 F6000\no<part> call\nG1 X1\nG1 X0\nG4 P2\no<part> call\nM2\n"
PART = "o<part> sub\nG1 Z[#5422 + {}]\n(rest)\no<part> endsub\n"


def write(path, text, keep_times=False):
    """In place, as some editors and all network shares do."""
    before = os.stat(path) if keep_times else None
    with open(path, "r+" if os.path.exists(path) else "w") as f:
        f.write(text)
        f.truncate()
    if before:
        os.utime(path, ns=(before.st_atime_ns, before.st_mtime_ns))


def start(what):
    """Starts, to the end; where it ended, what was told."""
    c.auto(AUTO_RUN, 0)
    c.wait_complete()
    idle()
    print(f"{what}: at {xyz()[1:]}", [m.replace(str(Path.cwd()) + "/", "") for m in messages()])


on()
path = str(Path("part.ngc").resolve())
program(MAIN.format(1), "part.ngc")
print("hash:", poll().program_hash == hashlib.sha256(MAIN.format(1).encode()).hexdigest())
c.auto(AUTO_RUN, 0)
need(lambda s: s.motion_line > 20, "motion")
print("edited while it runs, further on than was read:", poll().read_line < LINES, end=" ")
write(path, MAIN.format(2))
idle()
print("at", xyz()[1:], messages())
start("started again")
write(path, MAIN.format(1))
os.utime(path, (1, 1))
start("the same text with another time")
write(path, MAIN.format(3), keep_times=True)
start("another text of the same size with the same time")
os.remove(path)
start("gone")
write(path, MAIN.format(3))
start("another text, another file")
program(MAIN.format(3), "part.ngc")
start("opened again")
c.program_open(str(Path("nowhere.ngc").resolve()))
c.wait_complete()
messages()
print("a program that can not be opened: the hash stays that of the one that is open:",
      poll().program_hash == hashlib.sha256(MAIN.format(3).encode()).hexdigest())
os.utime(path)
start("it can be run")

write("part.ngc", PART.format(1))            # by name a sub now
write("caller.ngc", CALLER)
mdi("G0 Z10")
program(CALLER, "caller.ngc")
c.auto(AUTO_RUN, 0)
need(lambda s: s.current_line == 5, "the pause")
write("part.ngc", PART.format(3))
idle()
print("a called file is edited while the program runs: at", xyz()[2],
      [m.replace(str(Path.cwd()) + "/", "") for m in messages()])
start("started again")
mdi("F6000")
mdi("o<part> call")
print("called by hand: at", xyz()[2], "again, edited:", end=" ")
write("part.ngc", PART.format(4))
mdi("o<part> call")
print("at", xyz()[2], messages())
start_z = xyz()[2]
program(CALLER, "caller.ngc")
start("opened again")
print("moved up by", round(xyz()[2] - start_z, 3))
write("part.ngc", PART.format(4))
os.utime("part.ngc", (1, 1))
start("the same text with another time")

big = "G21\n" + "(a long line that makes up the size of it)\n" * 100000 + "G1 X2 F6000\nM2\n"
program(big, "big.ngc")
Path("big.ngc").write_text(big[:-20])
start("a long program, shortened on disk")
Path("big.ngc").write_text(big)
start("and as it was again")
print("hash:", poll().program_hash == hashlib.sha256(big.encode()).hexdigest(), "at", xyz()[0])
