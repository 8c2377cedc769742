# motion.interp.*, motion.feed-*, types, lines and speeds on pins, in each mode.
import math

import kerf_motion as km
from motion_bench import Machine, eq

TRAVERSE, FEED, ARC, TOOLCHANGE, PROBING = 1, 2, 3, 4, 5
INCH, CIRCLE = 1 << 0, 1 << 24
m = Machine(motmod="num_misc_error=2")


def pins(prefix, **wanted):
    for name, value in wanted.items():
        name = name.replace("_", "-")
        eq(m.get(f"{prefix}{name}"), value, f"{prefix}{name}")


# ---- free and teleop mode
eq(m.get("motion.servo.last-period"), 1000000, "period in virtual time")
for joint in (0, 1):
    m.send(km.JOG_CONT, joint=joint, axis=-1, vel=30.0 + 10 * joint)
m.sleep(0.3)
pins("motion.", current_vel=50.0, requested_vel=0.0, in_position=False, motion_enabled=True, coord_mode=False,
     teleop_mode=False, is_all_homed=True)
pins("joint.0.", vel_cmd=30.0, acc_cmd=0.0, free_vel_lim=30.0, free_tp_enable=True, free_pos_cmd=100.0,
     in_position=False, active=True)
m.send(km.JOG_ABORT, joint=0, axis=-1)
m.send(km.JOG_ABORT, joint=1, axis=-1)
m.rest()
pins("joint.0.", free_tp_enable=False, in_position=True, kb_jog_active=False)
pins("motion.", current_vel=0.0, in_position=True, motion_type=0, program_line=0)
m.mode(km.TELEOP)
m.send(km.JOG_CONT, joint=-1, axis=0, vel=-30)
m.send(km.JOG_CONT, joint=-1, axis=2, vel=40)
m.sleep(0.3)
pins("motion.", current_vel=50.0, teleop_mode=True)
pins("axis.x.", teleop_vel_cmd=-30.0, teleop_vel_lim=30.0, teleop_pos_cmd=-100.0, teleop_tp_enable=True,
     kb_jog_active=True)
eq(abs(m.get("axis.x.pos-cmd") - m.get("joint.0.pos-cmd")) < 0.1, True, "position of the axis")
m.send(km.ABORT)
m.wait(lambda s: not m.get("motion.jog-is-active"), "end of the jogs")
m.sleep(0.05)

# ---- coordinated mode: SET_VEL, SET_ACC, SET_VEL_LIMIT; types, lines
m.mode(km.COORD)
m.send(km.SET_VEL, vel=17, ini_maxvel=50)
m.send(km.SET_ACC, acc=321)
eq((m.status()["vel"], m.status()["acc"]), (17.0, 321.0), "status of SET_VEL and SET_ACC")
m.line(0, 0, 0, vel=50)
m.rest()
m.line(40, 30, 0, vel=20, id=77, kind=FEED, line=77, feed=1200, tag_field={3: 10, 4: 170}, tag_float={9: 36.87})
m.sleep(0.5)
pins("motion.", motion_type=FEED, program_line=77, current_vel=20.0, requested_vel=20.0, coord_mode=True,
     in_position=False, feed_upm=1200.0, feed_mm_per_minute=1200.0, feed_mm_per_second=20.0,
     feed_inches_per_minute=1200 / 25.4, feed_inches_per_second=20 / 25.4)
pins("motion.interp.", line_number=77, motion_type=10, feedrate=1200.0, heading=36.87, iscircle=False,
     normal_heading=0.0)
left = m.get("motion.distance-to-go")
eq(abs(left - math.dist((40, 30, 0), m.joints_at())) < 0.1, True, f"distance to go {left}")
m.send(km.FEED_SCALE, scale=0.5)
m.sleep(0.2)
pins("motion.", feed_upm=600.0, current_vel=10.0, requested_vel=10.0)
m.send(km.SET_VEL_LIMIT, vel=7)
m.sleep(0.2)
pins("motion.", current_vel=7.0, requested_vel=7.0)
m.send(km.SET_VEL_LIMIT, vel=1e9)
m.send(km.FEED_SCALE, scale=1)
m.rest()
pins("motion.", motion_type=0, program_line=0, distance_to_go=0.0, current_vel=0.0, feed_upm=0.0)
m.line(0, 0, 0, vel=50, kind=TRAVERSE, feed=1200, tag_field={3: 0}, tag_float={9: 12})
m.sleep(0.2)
pins("motion.", motion_type=TRAVERSE, feed_upm=0.0)  # no feed
pins("motion.interp.", motion_type=0, heading=12.0)
m.rest()
m.line(1, 0, 0, vel=2, kind=TOOLCHANGE)
m.sleep(0.2)
pins("motion.", motion_type=TOOLCHANGE)
m.rest()
m.line(0, 0, 0, vel=10, kind=FEED, feed=100, flag=INCH, id=5)
m.sleep(0.03)
pins("motion.", feed_upm=100.0, feed_inches_per_minute=100.0, feed_mm_per_minute=2540.0)
m.rest()
m.send(km.PROBE, pos=[2] + [0] * 8, vel=10, ini_maxvel=10, acc=500, ini_maxjerk=1e9, id=6,
       motion_type=PROBING, probe_type=1)
m.sleep(0.05)
pins("motion.", motion_type=PROBING, program_line=6)
m.rest()

# ---- headings on arcs: tangent and inward normal from the place, in each plane and direction
# first and second direction, normal
planes = {170: ((0, 1), (0, 0, 1)), 180: ((2, 0), (0, 1, 0)), 190: ((1, 2), (1, 0, 0))}
m.line(0, 0, 0, vel=50)
m.rest()
for plane, ((a, b), normal) in planes.items():
    for mode, sign in ((20, -1), (30, 1)):
        start, centre = [0.0] * 3, [0.0] * 3
        start[a], start[b] = 20.0, 0.0
        m.line(*start, vel=50)
        m.rest()
        m.send(km.SET_CIRCLE, pos=start + [0] * 6, center=centre, normal=[sign * x for x in normal], turn=0, vel=20,
               ini_maxvel=50, acc=500, ini_maxjerk=1e9, id=9, motion_type=ARC, line=9, feed=1200, flag=CIRCLE,
               tag_field={3: mode, 4: plane}, tag_float={5: 20, 6: 0, 7: 0, 8: 0})
        for _ in range(5):
            m.sleep(0.9)
            now = [m.get(f"joint.{j}.pos-fb") for j in range(3)]
            angle = math.degrees(math.atan2(now[b], now[a]))
            for pin, wanted in (("heading", angle + 90 * sign), ("normal-heading", angle + 180)):
                got = m.get(f"motion.interp.{pin}")
                eq(0 <= got < 360 and abs((got - wanted + 180) % 360 - 180) < 0.2, True,
                   f"{pin} {got}, place {now}, plane {plane}")
        pins("motion.interp.", motion_type=mode, arc_radius=20.0, arc_center_x=0.0, iscircle=True, line_number=9)
        pins("motion.", motion_type=ARC)
        m.send(km.ABORT)
        m.rest()
pins("motion.interp.", iscircle=True)  # from the tag again, until the next move
m.line(0, 0, 0, vel=50, tag_field={3: 10})
m.rest()

# ---- inputs that stop the machine, error flag, parameters
m.set("motion.misc-error-01", 1)
m.sleep(0.01)
eq([t.strip() for t in m.errors()], ["Motion Stopped by misc error 1"], "message")
pins("motion.", motion_enabled=False)
m.set("motion.misc-error-01", 0)
m.sleep(0.01)
m.enable()
m.mode(km.COORD)
m.send(km.SET_LINE, pos=[1000] + [0] * 8, vel=1, ini_maxvel=1, acc=1)
m.sleep(0.005)
pins("motion.", coord_error=True)
m.send(km.ABORT)
m.sleep(0.005)
pins("motion.", coord_error=False)
m.send(km.SPINDLE_ON, spindle=0, vel=500, state=1)
m.send(km.SPINDLE_SCALE, spindle=0, scale=0.5)
m.send(km.AF_ENABLE, flags=1)
m.sleep(0.005)
pins("motion.", debug_float_0=500.0, debug_float_2=17.0, debug_float_3=0.5, debug_bit_1=True, debug_s32_0=0)
pins("spindle.0.", speed_out=250.0, speed_out_rps=250 / 60, speed_cmd_rps=500 / 60, speed_out_abs=250.0, on=True,
     forward=True, reverse=False, brake=False)
eq(m.violations(), [], "limits")
print("pins agree")
m.close()
