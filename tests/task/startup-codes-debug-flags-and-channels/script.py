# SPDX-License-Identifier: GPL-2.0-or-later
# What the startup code sets is active; kinds of messages keep their kind and order; debug flags
# reach task and print; logs are written while reading.
from mill import *

on(home=True)
poll()
print([g for g in s.gcodes[1:] if g in (200, 910, 610, 180)], s.settings[1:3], s.program_units, "coolant", s.flood)
KIND = {OPERATOR_ERROR: "error", OPERATOR_TEXT: "text", OPERATOR_DISPLAY: "display", NML_ERROR: "nml error",
        NML_TEXT: "nml text", NML_DISPLAY: "nml display"}
c.error_msg("first")
c.text_msg("second")
c.display_msg("third")
c.wait_complete()
while m := e.poll():
    print(KIND[m[0]], m[1])
c.debug(0x10 | 0x80)
c.wait_complete()
print(hex(poll().debug))
print(run("(LOGOPEN,my.log)\n(LOG,one)\n#1=4\n(LOG,value #1)\n(LOGCLOSE)\n(LOGAPPEND,my.log)\n(LOG,two)\n(LOGCLOSE)\n"
          "(MSG,hello)\n(DEBUG,#1)\n(PRINT,printed #1)\nG1 X1 F60\nM9\nM2\n"))
c.debug(0)
c.wait_complete()
while m := e.poll():
    print(KIND[m[0]], m[1])
print(open("my.log").read())
