# SPDX-License-Identifier: GPL-2.0-or-later
"""Home switches that bounce when they close and when they open: alone, wired to the limit inputs of
one or both ends (HOME_IGNORE_LIMITS), and one for two joints (HOME_IS_SHARED). The latch position
is that of the first contact, so it is off by no more than the way within the bounce; homing neither
fails nor hangs, also when the final move ends while the switch still bounces."""
from rig import IGNORE_LIMITS, IS_SHARED, Report, Rig

r = Report()
T, AT, HYST, LATCH = 0.001, 10.0, 0.05, 2.0
ALONE, BOTH_ENDS, ONE_END, SHARED, OTHER, SHARED_ALONE, OTHER_ALONE = range(7)
m = Rig(7, hw={"all": dict(hysteresis=HYST, home_from=AT)}, low=-200.0, high=200.0, hal_lines=[
    f"unlinkp joint.{BOTH_ENDS}.pos-lim-sw-in", f"unlinkp joint.{BOTH_ENDS}.neg-lim-sw-in",
    f"net home{BOTH_ENDS} joint.{BOTH_ENDS}.pos-lim-sw-in joint.{BOTH_ENDS}.neg-lim-sw-in",
    *(line for j in (ONE_END, SHARED, OTHER)
      for line in (f"unlinkp joint.{j}.pos-lim-sw-in", f"net home{j} joint.{j}.pos-lim-sw-in")),
    "loadrt or2 count=2", "addf or2.0 servo-thread 8", "addf or2.1 servo-thread 8",
    *(line for j in range(SHARED, OTHER_ALONE + 1) for n in [(j - SHARED) // 2]
      for line in (f"unlinkp joint.{j}.home-sw-in", f"net home{j} or2.{n}.in{(j - SHARED) % 2}",
                   f"net shared{n} or2.{n}.out joint.{j}.home-sw-in"))])


def home(joints, flags, bounce, latch, home, start=0.0, seed=1):
    name = f"joints {joints} bounce {bounce} ms, latch {latch}, home {home}, start {start}, seed {seed}"
    m.unhome()
    for j in range(7):
        m.set_home(j, home_sequence=999)
    for n, j in enumerate(joints):
        m.hw(j, bounce_ms=0)
        m.set(f"sim-joint.{j}.seed", seed)
        m.place(j, start)
        m.hw(j, bounce_ms=bounce)
        m.set_home(j, home_sequence=n, search_vel=20.0, latch_vel=latch, home=home, flags=flags, home_final_vel=10.0)
    m.errors()
    moves = []  # the latch move happens once: nothing is tried again
    last = [None]

    def watch(rig):
        s = tuple(rig.state(j) for j in joints)
        if s != last[0]:
            moves.extend(x for x in s if x in ("RISE_START", "FALL_START") and (last[0] is None or x not in last[0]))
            last[0] = s

    seen, _ = m.run_home(-1 if len(joints) > 1 else joints[0], 30, watch)
    m.free()
    m.sleep(0.2)
    got = m.errors()
    r.check(all(m.homed(j) for j in joints) and not got, f"{name}: {got} {seen}")
    r.check(m.status()["enabled"], f"{name}: machine went off")
    r.check(not m.violations(), f"{name}: {m.violations()}")
    r.check(len(moves) == len(joints), f"{name}: latch moves {moves}")
    for j in joints:
        zero = m.at(j) - m.get(f"joint.{j}.pos-cmd")
        edge = AT if latch > 0 else AT - HYST
        late = (zero - edge) * (1 if latch > 0 else -1)
        r.check(-3 * T * LATCH <= late <= LATCH * (bounce * 1e-3 + 3 * T),
                f"{name}: joint {j} latched {late:.4f} after the contact")
        r.near(m.get(f"joint.{j}.pos-cmd"), home, f"{name}: joint {j} final position")


WIRINGS = (((ALONE,), 0), ((BOTH_ENDS,), IGNORE_LIMITS), ((ONE_END,), IGNORE_LIMITS),
           ((SHARED, OTHER), IS_SHARED | IGNORE_LIMITS), ((SHARED_ALONE, OTHER_ALONE), IS_SHARED))
for joints, flags in WIRINGS:
    for bounce in (15, 60):
        for latch in (LATCH, -LATCH):
            for seed, place in enumerate((-4.0, -0.25, -0.06 if latch > 0 else -0.01), 1):
                home(joints, flags, bounce, latch, place, seed=seed)
home((ALONE,), 0, 15, LATCH, -4.0, start=15.0)
r.finish()
