# PAUSE, RESUME, STEP, REVERSE and FORWARD: rest where they should, the way back is the way that was gone.
import kerf_motion as km
from motion_bench import Machine, eq

m = Machine()

def at(): return [round(x, 6) for x in m.joints_at()]


def stands(what, paused=1):
    """Waits for rest with moves left; returns the line."""
    m.sleep(0.02)
    m.wait(lambda s: s["current_vel"] == 0 and (not paused or s["paused"]) and not s["stepping"], what)
    m.sleep(0.01)  # the interpolator is two cycles behind
    before = at()
    m.sleep(0.3)
    eq(at(), before, f"{what}: at rest")
    return m.status()["id"]


m.mode(km.COORD)
m.send(km.SET_TERM_COND, termCond=1, tolerance=0)
corners = [(10, 0, 0), (10, 10, 0), (0, 10, 0), (0, 0, 0), (5, 5, 5), (20, 0, 0)]
m.set("motion.feed-hold", 1)
for n, c in enumerate(corners):
    m.line(*c, vel=20, id=n + 1)
m.send(km.PAUSE)
m.set("motion.feed-hold", 0)
m.sleep(0.2)
eq((at(), m.status()["depth"]), ([0, 0, 0], 6), "queued while paused")
# one line a step; the id is that of the line begun
for n in range(3):
    m.send(km.STEP)
    line = stands(f"step {n}")
    eq(m.status()["paused"], 1, "paused after a step")
    eq(at()[:2], list(corners[n][:2]), f"place after step {n}, line {line}")
eq(m.errors(), [], "messages")
m.send(km.RESUME)
m.send(km.STEP)
eq([t.strip() for t in m.errors()], ["MOTION: can't STEP while already executing"], "step while running")
m.wait(lambda s: s["id"] == 5, "line 5")
m.sleep(0.1)
m.send(km.REVERSE)  # refused while moving
eq((m.status()["reverse_run"], m.get("motion.tp-reverse")), (0, False), "direction while moving")
m.send(km.PAUSE)
stands("pause")
forward = []
m.send(km.REVERSE)
m.send(km.RESUME)
m.sleep(0.01)
eq(m.get("motion.tp-reverse"), True, "tp-reverse")
m.wait(lambda s: s["id"] == 2, "line 2 on the way back", 60)
m.send(km.PAUSE)
stands("pause on the way back")
here = at()
eq(here[2] == 0 and 0 <= here[1] <= 10 and abs(here[0] - 10) < 0.3, True, f"on line 2 again {here}")
# step back: one line
m.send(km.STEP)
stands("step back")
eq(m.status()["id"] <= 2, True, "line after a step back")
m.send(km.RESUME)
m.wait(lambda s: at() == [0, 0, 0], "back at the start", 60)
m.sleep(0.5)
eq(at(), [0, 0, 0], "no farther than the start")
m.send(km.FORWARD)
m.rest()
eq(at(), [20, 0, 0], "the end after all")
eq((m.get("motion.tp-reverse"), m.violations(), m.errors()), (False, [], []), "direction, limits, messages")
# negative adaptive feed runs back as well
m.send(km.AF_ENABLE, flags=1)
m.line(0, 0, 0, vel=10, id=8)
m.sleep(1)
x = at()[0]
m.set("motion.adaptive-feed", -0.5)
m.sleep(1)
eq(at()[0] > x and m.get("motion.tp-reverse"), True, f"runs back with a negative adaptive feed from {x}: {at()}")
m.sleep(3)
eq(at(), [20, 0, 0], "back at the start of the move")
m.set("motion.adaptive-feed", 1)
m.rest()
eq((at(), m.violations()), ([0, 0, 0], []), "forward again")
print("ok")
m.close()
