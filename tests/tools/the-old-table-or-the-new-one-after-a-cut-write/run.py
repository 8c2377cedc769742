# SPDX-License-Identifier: GPL-2.0-or-later
# FP-086, FP-132: the process that saves the tool table dies at every byte of the write. What is
# there afterwards is the old table or the new one, whole.
import ctypes
import os
import resource
import signal
import sys
import tempfile

lib = ctypes.CDLL(os.environ["EMC2_HOME"] + "/lib/libtooldata.so")
scratch = tempfile.mkdtemp()
os.chdir(scratch)
table = "; my tools\n" + "".join(f"T{n} P{n} D{n}.5 Z{n * 10} ;tool number {n}\n" for n in range(1, 13))
open("t.tbl", "w").write(table)
lib.tool_mmap_set_fname(b"store")
lib.tool_mmap_creator(None, 0)
lib.tooldata_load(b"t.tbl")


def save(limit):
    """Saves in a process that may write `limit` bytes; how that ended."""
    pid = os.fork()
    if pid == 0:
        os.dup2(os.open("/dev/null", os.O_WRONLY), 2)
        if limit is not None:
            signal.signal(signal.SIGXFSZ, signal.SIG_DFL)  # the byte too many is its last
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
        os._exit(lib.tooldata_save(b"t.tbl") & 0xff)
    return os.waitpid(pid, 0)[1]


def entries():
    return sorted(os.listdir("."))


print(save(None), entries())
new = open("t.tbl").read()
open("t.tbl", "w").write(table)
os.remove("t.tbl.bak")
killed = 0
for limit in range(len(new)):
    status = save(limit)
    killed += os.WIFSIGNALED(status)
    text = open("t.tbl").read()
    if text != table:
        sys.exit(f"cut at byte {limit}: {text!r}")
print("the old one stays at each of", "all" if killed == len(new) else killed, "bytes")
print(save(len(new)), open("t.tbl").read() == new, entries())
os.system("rm -rf " + scratch)
