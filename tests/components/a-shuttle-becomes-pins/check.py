# SPDX-License-Identifier: GPL-2.0-or-later
"""shuttle with reports from two pipes that stand for raw HID devices: models, dial, spring wheel, buttons,
unplugging."""
import os
import struct
import subprocess
import tempfile

from hal_outside import halcmd, pins, until

# The program as it is, but for who a descriptor belongs to.
PROGRAM = """
import os, sys
from importlib.util import module_from_spec, spec_from_file_location
spec = spec_from_file_location("shuttle", sys.argv[1])
shuttle = module_from_spec(spec)
spec.loader.exec_module(shuttle)
models = {"xpress": (0x0b33, 0x0020), "pro": (0x0b33, 0x0030), "mouse": (0x046d, 0xc077)}
shuttle.identity = lambda fd: models[os.path.basename(os.readlink(f"/proc/self/fd/{fd}"))]
shuttle.SEARCH_MS = 5
sys.argv = ["shuttle", *sys.argv[2:]]
sys.exit(shuttle.main())
"""


def get(name):
    return halcmd("getp", f"shuttle.{name}")


with tempfile.TemporaryDirectory() as folder:
    pipes, writers = [f"{folder}/{name}" for name in ("mouse", "xpress", "pro")], {}
    for path in pipes:
        os.mkfifo(path)
        writers[path] = os.open(path, os.O_RDWR)
    source = os.path.join(os.environ["EMC2_HOME"], "src/hal/user_comps/shuttle.py")
    program = subprocess.Popen(["/usr/bin/python3", "-c", PROGRAM, source, *pipes], stderr=subprocess.PIPE, text=True)
    until(lambda: "shuttle" in halcmd("list", "comp").split(), "loaded")
    print(pins("shuttle.0.*"))
    print("buttons of the other one:", pins("shuttle.1.*").count("-not"))

    def report(which, wheel, dial, buttons):
        os.write(writers[pipes[which]], struct.pack("<bBBH", wheel, dial, 0, buttons))

    report(1, -7, 250, 0x0100)
    until(lambda: get("0.button-4-not") == "FALSE", "a report")
    print("spring wheel:", get("0.spring-wheel-s32"), "as a fraction:", get("0.spring-wheel-f"),
          "the first dial is where it begins:", get("0.counts"))
    print("last button:", get("0.button-4"), get("0.button-4-not"), "first one:", get("0.button-0"),
          get("0.button-0-not"))
    report(1, 0, 4, 0x0010)
    until(lambda: get("0.button-4-not") == "TRUE", "another one")
    print("the dial goes on over its end:", get("0.counts"))
    report(1, 0, 250, 0)
    until(lambda: get("0.button-0-not") == "TRUE", "another one")
    print("and back:", get("0.counts"), "released:", get("0.button-0"), get("0.button-4"))
    report(2, 3, 0, 0x4001)
    until(lambda: get("1.button-14") == "TRUE" and get("1.button-0") == "TRUE", "fifteen buttons of the other one")
    os.close(writers[pipes[2]])
    until(lambda: get("1.button-14") == "FALSE" and get("1.button-0-not") == "TRUE", "unplugged, at rest")
    print("FP-156: unplugged a hundred times, with the wheel turned and a button down, sometimes both devices")
    rest = None
    for n in range(100):
        report(1, -5, n, 0x0100)
        until(lambda: get("0.button-4") == "TRUE")
        counts = get("0.counts")
        os.unlink(pipes[1])
        os.close(writers[pipes[1]])
        until(lambda: get("0.button-4-not") == "TRUE")
        before, rest = rest, halcmd("show", "pin", "shuttle.0.*")
        if n == 0:
            print([get("0." + name) for name in ("spring-wheel-s32", "spring-wheel-f", "button-4")])
        elif rest.replace(f" {counts} ", " ") != before.replace(f" {last} ", " "):
            print("not at rest", before, rest)
        last = counts
        for which in (1, 2) if n == 50 else (1,):
            if which == 1:
                os.mkfifo(pipes[1])
            writers[pipes[which]] = os.open(pipes[which], os.O_RDWR)
        report(1, 0, 100 + n, 0)  # the dial begins anew
        until(lambda: get("0.counts") == counts)
    report(2, 0, 0, 1)
    until(lambda: get("1.button-0") == "TRUE", "the other one is back, too")
    program.terminate()
    program.wait()
    said = program.stderr.read().replace(folder, "").splitlines()
    print(said[:2], sum(line == "shuttle: /xpress is lost: unplugged" for line in said),
          sum(line == "shuttle: /xpress is back" for line in said))
    for words, what in (([], "none named"), ([f"{folder}/nothing"], "one that is not there"),
                        ([pipes[0]], "another device")):
        done = subprocess.run(["shuttle", *words], capture_output=True, text=True)
        print(f"{what}: {done.returncode}", done.stderr.replace(folder, "").strip().splitlines()[-1])
