# SPDX-License-Identifier: GPL-2.0-or-later
# Emergency stop, release and machine on, 1000 times, two clients at once; each command is acknowledged.
import linuxcnc as module
from mill import *

other = module.command()
print("the first command of a new controller:", s.poll(), c.state(STATE_ESTOP_RESET),
      until(lambda s: s.task_state == STATE_ESTOP_RESET, 1))
lost = []
for n in range(1000):
    for name, state, shown in [("estop", STATE_ESTOP, STATE_ESTOP), ("reset", STATE_ESTOP_RESET, STATE_ESTOP_RESET),
                               ("on", STATE_ON, STATE_ON)][:3 if n % 10 == 0 else 2]:
        (other if n % 2 else c).state(state)
        serial = (other if n % 2 else c).serial
        if not until(lambda s: s.task_state == shown and s.echo_serial_number >= serial, 0.5):
            lost.append((n, name, s.task_state))
print("lost:", lost, messages())
serials = []
for n in range(500):  # two at once: no number is used twice
    c.debug(0)
    other.debug(0)
    serials += [c.serial, other.serial]
print("numbers:", serials == sorted(set(serials)))
