# SPDX-License-Identifier: GPL-2.0-or-later
import os

from mill import *

on()
for name in b"Teil \xc3\xbc 1.ngc", b"lat\xe4.ngc", b"bad.ngc":
    mode(MODE_AUTO)
    c.program_open(os.path.abspath(os.fsdecode(name)))
    c.wait_complete()
    with open(poll().file, "rb") as f:
        size = len(f.read())
    c.auto(AUTO_RUN, 0)
    c.wait_complete(20)
    print(name, size, ascii(messages()), poll().position[0])
    c.abort()
    c.wait_complete()
mdi("(MSG, ä)")
print(ascii(messages()))
