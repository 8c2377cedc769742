# SPDX-License-Identifier: GPL-2.0-or-later
"""terminal.py ANSWER COMMAND...: runs a command at a terminal, answers its question [Y/n], and prints what it shows
and its status."""
import os
import pty
import sys

pid, terminal = pty.fork()
if pid == 0:
    os.execvp(sys.argv[2], sys.argv[2:])
text = b""
try:
    while data := os.read(terminal, 4096):
        text += data
        if b"[Y/n]" in data:
            os.write(terminal, sys.argv[1].encode())
except OSError:          # it has ended
    pass
print(text.decode().replace("\r\n", "\n"), end="")
print("status", os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]))
