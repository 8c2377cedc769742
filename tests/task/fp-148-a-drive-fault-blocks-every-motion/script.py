# SPDX-License-Identifier: GPL-2.0-or-later
# FP-148: the fault input of a drive blocks machine on, homing, jogs, MDI and programs, and ends what runs; nothing
# goes on by itself when it falls.
from mill import *


def moved(seconds=1.0):
    before = list(poll().joint_actual_position[:3])
    sleep(seconds)
    return [round(b - a, 6) for a, b in zip(before, poll().joint_actual_position[:3])] != [0, 0, 0]


def fault(on_):
    halcmd("setp", "joint.1.amp-fault-in", str(on_))
    sleep(0.05)


def tried(what, work):
    try:
        work()
    except linuxcnc.error as error:
        print("refused:", error)
    sleep(0.3)
    print(f"{what}: state {poll().task_state}, moved {moved()}, homing {any(j['homing'] for j in s.joint[:3])}",
          messages())


fault(1)
c.state(STATE_ESTOP_RESET)
c.wait_complete()
tried("on", lambda: c.state(STATE_ON))
c.teleop_enable(0)
tried("home", lambda: c.home(-1))
fault(0)
print("the fault falls: state", poll().task_state, "moved", moved())
on()
tasks = {"home": lambda: c.home(-1), "jog": lambda: c.jog(JOG_CONTINUOUS, 1, 1, 5.0),
         "MDI": lambda: c.mdi("G1 X50 Y20 F600"), "program": lambda: c.auto(AUTO_RUN, 0)}
for name, start in tasks.items():
    if poll().task_state != STATE_ON:
        on()
    if name == "home":
        c.teleop_enable(0)
        c.wait_complete()
    elif name == "jog":
        mode(MODE_MANUAL)
        c.teleop_enable(0)
        c.wait_complete()
    elif name == "MDI":
        mode(MODE_MDI)
    else:
        program("G21 G90\nG1 X-20 Y-20 F600\nG1 X20 Y20\nM2\n")
    start()
    need(lambda s: any(abs(j["velocity"]) > 1 for j in s.joint[:3]), f"motion of {name}")
    fault(1)
    told = messages()
    sleep(0.5)
    print(f"{name} runs: state {poll().task_state}, moves {moved()}", told)
    fault(0)
    print(f"the fault falls: state {poll().task_state}, moves {moved()}", messages())
