# SPDX-License-Identifier: GPL-2.0-or-later
# No button makes halui deaf to the others; of two at once the one that stops acts; a signal that is linked presses
# nothing, whatever it says; and a mode that somebody chose is kept.
import hal
import os
import signal

from mill import *

me = hal.component("panel")
HELD = "machine.off", "spindle.0.start", "program.pause", "mist.on", "axis.x.plus", "feed-override.counts"
EMERGENCY = "estop.activate"
for name in *HELD, EMERGENCY:
    me.newpin(name, hal.HAL_S32 if name.endswith("counts") else hal.HAL_BIT, hal.HAL_OUT)
me.ready()


def put(pin, value):
    hal.set_p("halui." + pin, str(value))


def press(*pins):
    for pin in pins:
        put(pin, 1)
    sleep(0.1)
    for pin in pins:
        put(pin, 0)
    sleep(0.1)


def spindle():
    return poll().spindle[0]["speed"], s.spindle[0]["brake"]


c.state(STATE_ESTOP_RESET)
sleep(0.2)
press("machine.on", "machine.off")
print("on and off:", poll().task_state == STATE_ESTOP_RESET)
press("machine.on", "estop.activate")
print("on and emergency stop:", poll().task_state == STATE_ESTOP)
press("estop.activate", "estop.reset")
print("emergency stop and reset:", poll().task_state == STATE_ESTOP)
on()
press("spindle.0.start", "spindle.0.stop")
print("spindle start and stop:", spindle())
press("spindle.0.forward", "spindle.0.reverse")
print("forward and reverse:", spindle())
press("spindle.0.brake-off")
press("spindle.0.brake-on", "spindle.0.brake-off")
print("brake on and off:", spindle())
program("G21 G90 G0 X0 Y0\nG1 F600 X20\nM2\n")
mode(MODE_MANUAL)
for stop in "program.stop", "abort":
    press("program.run", stop)
    print(f"run and {stop}:", poll().interp_state == INTERP_IDLE, xyz())
press("program.run")
press("program.pause", "program.resume")
print("pause and resume:", poll().interp_state == INTERP_PAUSED)
press("program.resume")
press("program.pause", "program.step", "program.stop")
print("pause, step and stop:", poll().interp_state == INTERP_IDLE, messages())

print("== a change of mode that waits")
for pin in "mode.teleop", "mode.joint":
    mode(MODE_MDI)
    c.mdi("G4 P100")
    sleep(0.5)
    put(pin, 1)
    sleep(0.1)
    put("feed-override.increase", 1)
    sleep(0.1)
    heard = poll().feedrate
    put("abort", 1)
    print(f"{pin} in a dwell: override", heard, "abort heard:", until(lambda s: s.interp_state == INTERP_IDLE, 0.2))
    for p in pin, "feed-override.increase", "abort":
        put(p, 0)
    c.feedrate(1)
    sleep(0.2)
messages()

print("== who chooses a mode after a failed MDI_COMMAND has it")
mode(MODE_MANUAL)
press("mdi-command-01")
print(messages(), poll().task_mode == MODE_MDI)
c.mode(MODE_AUTO)
c.wait_complete()
sleep(0.2)
print("auto stays:", poll().task_mode == MODE_AUTO, hal.get_value("halui.halui-mdi-is-running"))
mode(MODE_MANUAL)
press("mdi-command-02")
print("a line that would be cut:", messages(), xyz(), poll().task_mode == MODE_MANUAL,
      hal.get_value("halui.halui-mdi-is-running"))

print("== halui killed and started again while a program runs, with signals that are already on")
c.feedrate(0.5)
program("G21 G90 G0 X0 Y0\nG1 F600 X20\nM2\n")
c.auto(AUTO_RUN, 0)
sleep(1)
line = next(l for l in halcmd("show", "comp").splitlines() if l.split()[2] == "halui")
os.kill(int(line.split()[3]), signal.SIGKILL)
sleep(1)
messages()
clock.run(["halcmd", "loadusr", "-Wn", "halui", "halui", "-ini", "mill.ini"], stderr=subprocess.DEVNULL)


def link(pin):
    me[pin] = 500 if pin.endswith("counts") else 1
    hal.new_sig(pin, hal.HAL_S32 if pin.endswith("counts") else hal.HAL_BIT)
    hal.connect("panel." + pin, pin)
    hal.connect("halui." + pin, pin)


for pin in HELD:
    link(pin)
put("axis.jog-speed", 600)
sleep(0.3)
print("goes on:", poll().interp_state != INTERP_IDLE, s.task_paused, spindle(), s.mist, s.feedrate,
      [m for m in messages() if "died" not in m])
me["feed-override.counts"] = 501
sleep(0.1)
print("the next count counts:", poll().feedrate)
me["program.pause"] = 0
sleep(0.1)
me["program.pause"] = 1
sleep(0.1)
print("the next press, too:", poll().task_paused)
c.abort()
mode(MODE_MANUAL)
put("axis.jog-speed", 500)
sleep(0.3)
print("nothing moves:", poll().inpos, [s.axis[n]["velocity"] for n in range(3)])
link(EMERGENCY)
print("an emergency stop that is linked acts:", until(lambda s: s.task_state == STATE_ESTOP, 1))
