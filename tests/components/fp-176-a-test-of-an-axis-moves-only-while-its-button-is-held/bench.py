# SPDX-License-Identifier: GPL-2.0-or-later
import os
import hal
from kerf import clock

clock.join("bench", 900)
h = hal.component("bench")
h.ready()
HAL = """loadrt threads name1=servo period1=1000000
loadrt axistest names=axis
loadrt steptest names=step
loadrt limit3 names=axis-motor,step-motor
addf axis.update servo
addf step servo
addf axis-motor servo
addf step-motor servo
setp axis-motor.maxv 5
setp axis-motor.maxa 50
setp step-motor.maxv 5
setp step-motor.maxa 50
setp axis.maxvel 5
setp step.maxvel 5
setp step.maxaccel 50
net axis-cmd axis.position-cmd => axis-motor.in
net step-cmd step.position-cmd => step-motor.in
net axis-at axis-motor.out => axis.position-fb
net step-at step-motor.out => step.position-fb
start
"""
with open("bench.hal.tmp", "w") as f:
    f.write(HAL)
clock.run(["halcmd", "-f", "bench.hal.tmp"])
os.remove("bench.hal.tmp")


def at(which):
    return hal.get_value(f"{which}-motor.out")


for which in ("axis", "step"):
    for button in ("jog-plus", "jog-minus"):
        before = at(which)
        hal.set_p(f"{which}.{button}", "1")
        clock.sleep(0.05)
        hal.set_p(f"{which}.{button}", "0")
        released = at(which)
        clock.sleep(0.6)
        stop = at(which)
        clock.sleep(5)
        print(f"{which} {button}: moved {abs(released - before) > 0.01}, stops within the braking distance "
              f"{abs(stop - released) < 0.3}, stands for 5 s {abs(at(which) - stop) < 1e-6}")
    start = at(which)
    hal.set_p(f"{which}.amplitude", "2")
    hal.set_p(f"{which}.run", "1")
    clock.sleep(1.3)
    far = at(which)
    hal.set_p(f"{which}.run", "0")
    clock.sleep(5)
    print(f"{which} run: went {abs(far - start) > 0.05}, back at the start {abs(at(which) - start) < 0.01}, running "
          f"{hal.get_value(f'{which}.running')}")
