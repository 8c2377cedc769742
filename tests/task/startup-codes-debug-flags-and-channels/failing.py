# SPDX-License-Identifier: GPL-2.0-or-later
from mill import *

sleep(0.5)
raise SystemExit("the operator was told: " + ", ".join(messages()))
