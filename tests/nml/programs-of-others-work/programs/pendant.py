#!/usr/bin/env python3
"""A jog box: +X and -Z in teleop, a step, feed override, spindle."""
import time
import linuxcnc

c, s = linuxcnc.command(), linuxcnc.stat()
c.mode(linuxcnc.MODE_MANUAL)
c.wait_complete()
c.teleop_enable(1)
c.wait_complete()


def wait(test):
    for _ in range(3000):
        s.poll()
        if test():
            return True
        time.sleep(0.01)
    return False


s.poll()
x, z = s.position[0], s.position[2]
c.jog(linuxcnc.JOG_CONTINUOUS, False, 0, 10.0)
print("moves", wait(lambda: s.position[0] > x + 1))
c.jog(linuxcnc.JOG_STOP, False, 0)
print("stops", wait(lambda: s.inpos and s.joint[0]["velocity"] == 0))
c.jog(linuxcnc.JOG_INCREMENT, False, 2, -5.0, 0.5)
print("step", wait(lambda: abs(s.position[2] - (z - 0.5)) < 1e-6))
c.feedrate(0.5)
c.rapidrate(0.25)
c.spindleoverride(0.8)
print("overrides", wait(lambda: (s.feedrate, s.rapidrate, s.spindle[0]["override"]) == (0.5, 0.25, 0.8)))
c.spindle(linuxcnc.SPINDLE_FORWARD, 300)
print("spindle", wait(lambda: s.spindle[0]["speed"] == 300 and s.spindle[0]["direction"] == 1))
c.spindle(linuxcnc.SPINDLE_OFF)
c.flood(linuxcnc.FLOOD_ON)
print("coolant", wait(lambda: s.flood and not s.spindle[0]["enabled"]))
c.abort()
c.wait_complete()
c.feedrate(1.0)
c.rapidrate(1.0)
c.spindleoverride(1.0)
print("abort", wait(lambda: not s.flood))
