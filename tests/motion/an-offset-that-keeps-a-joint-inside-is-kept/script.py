# A joint is jogged to its limit under an external offset, and the offset is taken back: it goes as far as the joint
# may, to the limit and not beyond it, and the whole way once the path makes room.
import kerf_motion as km
from motion_bench import Machine

for jerk in (0.0, 5000.0):
    m = Machine(jerk=jerk, eoffset_ratio=0.3, traj_jerk=jerk or 1e9)
    m.set("axis.z.eoffset-enable", 1)
    m.set("axis.z.eoffset-scale", 0.01)
    for sign in (1, -1):
        m.reset_limits()
        m.mode(km.COORD)
        m.set("axis.z.eoffset-counts", -sign * 20)
        m.sleep(1)
        m.mode(km.FREE)
        m.send(km.JOG_ABS, joint=2, axis=-1, vel=50.0, offset=sign * 99.9575)
        m.rest()
        m.set("axis.z.eoffset-counts", 0)
        m.sleep(0.01)
        m.mode(km.COORD)
        m.sleep(1)
        there = m.joints_at()[2], m.get("motion.eoffset-limited")
        m.line(0, 0, sign * 90, vel=20, id=1)
        m.rest()
        m.sleep(1)
        print(f"jerk {jerk:g}: joint at {there[0]:.6f} limited {there[1]}, then {m.joints_at()[2]:.6f}, "
              f"offset {m.get('axis.z.eoffset'):.6f}", [e for e in m.errors() if "xceeded" in e], m.violations())
    m.close()
