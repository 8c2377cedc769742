"""A program with components that ends in any way leaves no component behind; SIGTERM raises
KeyboardInterrupt; a forked child does not take its parent's components with it."""
import os
import subprocess
import sys
import hal

START = """
import hal, os, signal, sys, time
c = hal.component("child"); c.newpin("in", hal.HAL_FLOAT, hal.HAL_IN); c.ready()
"""
WAYS = {
    "end of program": "",
    "exit()": "c.exit()",
    "sys.exit": "sys.exit(3)",
    "exception": "raise RuntimeError('x')",
    "os._exit": "os._exit(4)",
    "abort": "os.abort()",
    "kill -9": "os.kill(os.getpid(), signal.SIGKILL)",
    "terminated": "try:\n    os.kill(os.getpid(), signal.SIGTERM)\n    time.sleep(5)\nexcept KeyboardInterrupt:\n"
                  "    sys.exit(9)",
    "second component": "d = hal.component('child2'); d.ready()",
    "forgotten component": "del c; assert not hal.component_exists('child')",
}
for way, code in WAYS.items():
    status = subprocess.run([sys.executable, "-c", START + code], stderr=subprocess.DEVNULL).returncode
    print(way, status, hal.component_exists("child"), hal.component_exists("child2"))

c = hal.component("parent")
pin = c.newpin("in", hal.HAL_FLOAT, hal.HAL_IN)
c.ready()
pid = os.fork()
if pid == 0:
    pin.value = 3.5
    sys.exit(0)
os.waitpid(pid, 0)
print(hal.component_exists("parent"), pin.value)

# halcmd unload: SIGTERM ends it, and nothing is left.
child = subprocess.Popen([sys.executable, "-c", START + "print('up', flush=True)\ntime.sleep(60)"],
                         stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
child.stdout.readline()
subprocess.run(["halcmd", "unload", "child"])
child.wait()
print("unloaded", hal.component_exists("child"))
