# SPDX-License-Identifier: GPL-2.0-or-later
from mill import *

sleep(0.1)
print("joints", [round(poll().joint[j]["output"], 3) for j in range(3)], messages())
on()
print(mdi("G0 X1"), messages())
