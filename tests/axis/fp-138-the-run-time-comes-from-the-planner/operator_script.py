#!/usr/bin/python3
import sys

import operator_lib as lib
from axis.program import properties
from kerf import clock


def script(op):
    sys.stdout = open("transcript", "w", buffering=1)
    app = op.app
    op.power_on()
    op.home()
    op.key("r", state=4)         # Control-R: from where the machine stands now
    app.estimate.wait()
    op.wait(0.1)
    told, total = app.vars.run_time.get(), app.estimate.total
    rows = dict(properties(app.shown_file, None, app.preview.program, app.settings, True, run_time=total))
    print("told before the start:", told, "properties:", rows["Run time"])
    looks, begin = [], clock.now()
    op.key("r")

    def look(what):
        app.estimate.wait()
        op.wait(0.1)
        looks.append((what, clock.now(), app.estimate.remaining))
    op.wait(3)
    look("after 3 s")
    op.key("p")
    op.wait(5)
    look("after a pause of 5 s")
    op.key("s")
    looks.pop()                  # the pause itself is no part of it
    look("after a pause of 5 s")
    op.wait(2)
    app.set_override("feedrate", 50)
    op.wait(1)
    look("at half the feed")
    op.wait(8)
    look("still at half the feed")
    print("status bar:", app.vars.run_time.get().split(":")[0])
    op.idle()
    end = clock.now()
    for what, at, remaining in looks[2:]:
        near = abs(remaining / (end - at) - 1) < 0.05
        print(what, "within 5 %" if near else f"told {remaining:.2f}, took {end - at:.2f}")
    print("longer than told, by the pause and the override:", end - begin > total + 5)
    # The first looks knew nothing of the override: they are compared with a run of the whole.
    app.set_override("feedrate", 100)
    op.wait(1)
    app.estimate.wait()
    op.wait(0.2)
    expected, begin = app.estimate.total, clock.now()
    op.key("r")
    op.idle()
    print("whole program within 5 %:", abs(expected / (clock.now() - begin) - 1) < 0.05)
    first, paused = looks[0], looks[1]
    print("a pause takes nothing off:", abs(first[2] - paused[2]) < 1)


lib.run(script)
