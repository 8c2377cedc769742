# SPDX-License-Identifier: GPL-2.0-or-later
from mill import *

told = []
clock.wait_until(lambda: told.extend(messages()) or told, 5)
clock.sleep(0.1)
told += messages()
for text in told:
    print(text.split(" (", 1)[0])
print("line", poll().cut_off_line, s.cut_off_file)
on()
print("runs:", run("G0 X1\nM2\n"), xyz()[0], poll().cut_off_line)
