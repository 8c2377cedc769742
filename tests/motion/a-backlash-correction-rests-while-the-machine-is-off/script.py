# The machine is switched off in the middle of a correction of backlash: nothing is corrected while no motor follows, so
# the position that is shown stays, also when the machine is switched on; the next move corrects as ever.
import kerf_motion as km
from motion_bench import Machine

for jerk in (0.0, 8000.0):
    m = Machine(jerk=jerk, traj_jerk=jerk or 1e9)
    m.send(km.SET_JOINT_BACKLASH, joint=2, backlash=0.3)

    def jog(to):
        m.send(km.JOG_ABS, joint=2, axis=-1, vel=20.0, offset=to)

    def there():
        return tuple(round(m.get(f"joint.2.{p}"), 9) for p in ("pos-fb", "pos-cmd", "motor-pos-cmd", "backlash-filt"))

    jog(10.0)
    m.rest()
    m.sleep(0.5)
    jog(5.0)
    m.wait(lambda s: -0.1 < m.get("joint.2.backlash-filt") < 0.1, "middle of the correction")
    m.disable()
    m.sleep(0.005)
    off = there()
    m.sleep(1)
    later = there()
    m.enable()
    m.sleep(1)
    on = there()
    m.reset_limits()
    jog(4.0)
    m.rest()
    m.sleep(0.5)
    print(f"jerk {jerk:g}: middle {abs(off[3]) < 0.15}, still off {off == later}, still on {off == on},",
          f"then {[x + 0.0 for x in there()]}", m.errors(), m.violations())
    m.close()
