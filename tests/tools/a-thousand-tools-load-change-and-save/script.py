# SPDX-License-Identifier: GPL-2.0-or-later
# 1000 tools and 50 more than the shared data holds: the first thousand work, the rest stays in the file.
import subprocess
from mill import *

open("mill.tbl", "w").write("".join(f"T{n} P{n} D{n / 100:.2f} Z{n / 10:.1f} ;tool {n}\n" for n in range(1, 1051)))
on()
messages()
c.load_tool_table()
print(c.wait_complete(), len(messages()), "too many")
print(len([t for t in poll().tool_table if t.id > 0]), "tools")
print(mdi("T1000 M6"), poll().tool_in_spindle, mdi("G43"), s.tool_offset[2], poll().tool_offset[2])
print(mdi("T1001"), messages())
print(mdi("G10 L1 P999 Z1.25"), mdi("G10 L1 P1000 Z2.5"), poll().tool_table[0].zoffset)
lines = open("mill.tbl").read().splitlines()
print(len(lines), lines[0], lines[998], lines[999], lines[1049], sep="\n")


def tool(*words):
    r = clock.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    print(r.returncode, r.stdout.rstrip())


tool("tool_mmap_read", "999", "1000")
tool("tool_mmap_read", "1000")
tool("tool_mmap_read")
tool("tool_mmap_read", "-1")
tool("tool_mmap_read", "5", "4")
tool("tool_mmap_read", "0", "1001")
watch = clock.spawn(["tool_watch"], "watch", stderr=open("watched", "w"))
sleep(2.5)
watch.terminate()
clock.run(["true"])
watch.wait()
print(*open("watched").read().splitlines()[1:], sep="\n")
