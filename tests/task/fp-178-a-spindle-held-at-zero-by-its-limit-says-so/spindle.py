# SPDX-License-Identifier: GPL-2.0-or-later
import hal
from mill import *

on()
for line in ("S1000 M3", "M5", "S1000 M4", "M5", "S9000 M4"):
    mdi(line)
    sleep(0.1)
    print(f"{line}: {hal.get_value('spindle.0.speed-out'):g}", messages())
