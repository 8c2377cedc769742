# Preconditions, effects and texts of motion commands, one after the other on one machine.
# Covers of the field problems: FP-065 and FP-066 (a jog moves the named joint or axis alone, whatever
# came before), FP-068 (an override of limits ends with the first jog, for the tripped switch only),
# FP-069 (a jog back inside is accepted), FP-070 (a position reached by jogging is legal), FP-071
# (unhomed joints jog both ways), FP-072 and FP-076 (contacts in probe moves and in others; more in
# tests/task/fp-072-...), FP-097 (the machine never goes off without a word, also where a joint
# has shown an error before).
import os
import tempfile

import kerf_motion as km
from motion_bench import Machine, eq

OK, UNKNOWN, INVALID_COMMAND, INVALID_PARAMS, BAD_EXEC = range(5)
log = tempfile.NamedTemporaryFile()
os.environ["MOTION_BENCH_LOG"] = log.name
m = Machine(jerk=5000.0, motmod="num_spindles=2 num_dio=4 num_aio=2", home=False, traj_jerk=5000.0)
m.send(km.SET_NUM_SPINDLES, spindle=2)


def told(*texts, what=""):
    eq([t.rstrip("\n") for t in m.errors()], list(texts), what or "messages")


def refused(status, text, code, **fields):
    m.send(code, **fields)
    eq(m.status()["commandStatus"], status, f"status of {code} {fields}")
    told(*([text] if isinstance(text, str) else text), what=f"messages of {code} {fields}")


def moved(before, but):
    """Joints that are elsewhere than before, at rest."""
    m.rest()
    after = m.joints_at()
    eq([j for j in range(3) if abs(after[j] - before[j]) > 1e-9], but, "joints that moved")
    return after


# ---- before machine on
refused(UNKNOWN, "unrecognized command 200", 200)
refused(INVALID_COMMAND, "need to be enabled, in coord mode for linear move", km.SET_LINE, pos=[1, 2, 3], id=7,
        vel=1, acc=1)
eq(m.status()["error"], True, "error flag")
refused(INVALID_COMMAND, "need to be enabled, in coord mode for circular move", km.SET_CIRCLE, pos=[1, 2, 3])
refused(INVALID_COMMAND, "need to be enabled, in coord mode for probe move", km.PROBE, pos=[1, 2, 3])
refused(INVALID_COMMAND, "need to be enabled, in coord mode for rigid tap move", km.RIGID_TAP, pos=[1, 2, 3])
refused(OK, "Can't jog joint when not enabled.", km.JOG_CONT, joint=0, axis=-1, vel=1)
eq(m.get("joint.0.error"), True, "joint error flag")
refused(OK, "MOTION: can't STEP while already executing", km.STEP)
m.set("motion.enable", 0)
refused(OK, "can't enable motion, enable input is false", km.ENABLE)
m.set("motion.enable", 1)
m.sleep(0.01)
eq(m.status()["enabled"], False, "enabled")
m.enable()
eq((m.get("joint.0.error"), m.status()["error"]), (False, False), "flags cleared by machine on")

# ---- free mode, not homed: FP-071
for direction in (1, -1):
    before = m.joints_at()
    m.send(km.JOG_INCR, joint=1, axis=-1, vel=direction * 20, offset=150)
    m.sleep(0.01)
    eq(m.get("joint.1.kb-jog-active"), True, "jog active")
    eq((m.get("motion.jog-is-active"), m.get("joint.0.kb-jog-active")), (True, False), "jog pins")
    after = moved(before, [1])
    eq(round(after[1] - before[1], 9), direction * 150, "distance")
refused(OK, "Joint jog requested for undefined joint number=3 (min=0,max=2)", km.JOG_CONT, joint=3, axis=-1, vel=1)
refused(OK, "Joint jog requested for undefined joint number=-1 (min=0,max=2)", km.JOG_CONT, joint=-1, axis=0, vel=1)
m.set("motion.jog-inhibit", 1)
refused(OK, "Cannot jog while jog-inhibit is active.", km.JOG_ABS, joint=0, axis=-1, vel=1, offset=2)
m.set("motion.jog-inhibit", 0)
m.set("motion.homing-inhibit", 1)
refused(OK, "Homing denied by motion.homing-inhibit joint=1", km.JOINT_HOME, joint=1)
m.set("motion.homing-inhibit", 0)
m.home()
told()

# ---- continuous, absolute, stop by release, jog-stop pins: FP-060
m.send(km.JOG_CONT, joint=2, axis=-1, vel=50)
m.sleep(0.5)
m.send(km.JOG_INCR, joint=2, axis=-1, vel=50, offset=1)  # another step size while the key is down
m.sleep(0.1)
m.send(km.JOG_ABORT, joint=2, axis=-1)
m.rest(2)
m.send(km.JOG_ABS, joint=2, axis=-1, vel=50, offset=1000)
m.rest()
eq(m.joints_at()[2], 100.0, "absolute jog ends at the limit")
refused(OK, (), km.JOG_CONT, joint=2, axis=-1, vel=10)
m.rest()
eq(m.joints_at()[2], 100.0, "FP-070: at the limit, not beyond")
for pin, text in (("jog-stop", "Jog aborted by jog-stop"), ("jog-stop-immediate", "Jog aborted by jog-stop-immediate")):
    m.send(km.JOG_CONT, joint=2, axis=-1, vel=-30)
    m.sleep(0.4)
    m.set(f"motion.{pin}", 1)
    m.sleep(0.002)
    eq(m.get("joint.2.vel-cmd") == 0, pin != "jog-stop", "stopped at once")
    m.rest(2)
    m.set(f"motion.{pin}", 0)
    told(text)
    if pin == "jog-stop":
        eq(m.violations(), [], "limits")
m.reset_limits()  # a stop at once is one

# ---- teleop: only the axis named moves (FP-065, FP-066), soft limits to the last bit
m.mode(km.TELEOP)
refused(OK, "JOG_INCR Mode is TELEOP, cannot jog joint", km.JOG_INCR, joint=0, axis=-1, vel=1, offset=1)
refused(OK, "JOG_CONT command.com teleop: unexpected negative axis_num", km.JOG_CONT, joint=-1, axis=-1, vel=1)
m.mode(km.COORD)
m.line(10, 20, 30)
m.rest()
for axis in range(3):
    m.mode(km.TELEOP)
    before = m.joints_at()
    m.send(km.JOG_INCR, joint=-1, axis=axis, vel=50, offset=5)
    m.wait(lambda s: not m.get("motion.jog-is-active"), "end of the jog")
    m.sleep(0.02)
    after = moved(before, [axis])
    eq(round(after[axis] - before[axis], 9), 5, "teleop distance")
    m.mode(km.COORD)
    m.line(*before)
    m.rest()
m.mode(km.TELEOP)
m.send(km.JOG_CONT, joint=-1, axis=0, vel=50)
m.wait(lambda s: not m.get("motion.jog-is-active"), "end of the jog")
m.sleep(0.02)
eq(m.joints_at()[0], 100.0, "teleop jog ends at the limit")
m.mode(km.COORD)
told()
m.line(100, 20, 29)  # FP-070: an axis that rests on its limit
eq(m.status()["commandStatus"], OK, "move along the limit")
m.rest()

# ---- moves
refused(INVALID_PARAMS, ("Linear move on line 9 would exceed X's positive limit",
                         "Linear move on line 9 would exceed joint 0's positive limit max:[100.000000]",
                         "invalid params in linear command"), km.SET_LINE, pos=[101, 0, 0], id=9, vel=1, acc=1)
refused(INVALID_PARAMS, ("Linear move on line 9 would exceed A's positive limit", "invalid params in linear command"),
        km.SET_LINE, pos=[1, 0, 0, 5], id=9, vel=1, acc=1)
refused(INVALID_PARAMS, ("Circular move on line 3 would exceed Y's negative limit",
                         "Circular move on line 3 would exceed joint 1's negative limit min:[-100.000000]"),
        km.SET_CIRCLE, pos=[0, -101, 0], center=[0, 0, 0], normal=[0, 0, 1], id=3, vel=1, acc=1)
m.send(km.ABORT)
# FP-067: an arc whose ends are inside and whose bulge is not is refused before it starts
m.line(90, 30, 30)
m.rest()
for normal, line in ((1, 4), (-1, 5)):
    beyond = normal > 0  # counter-clockwise it bulges over x = 100
    m.send(km.SET_CIRCLE, pos=[90, 60, 30], center=[90, 45, 30], normal=[0, 0, normal], id=line, vel=20,
           ini_maxvel=20, acc=500, ini_maxjerk=5000, motion_type=3, turn=0)
    eq(m.status()["commandStatus"], INVALID_PARAMS if beyond else OK, "arc beyond a limit")
    told(*(("Circular move on line 4 would exceed X's positive limit",
            "Circular move on line 4 would exceed joint 0's positive limit max:[100.000000]") if beyond else ()))
m.rest()
eq([round(x, 6) for x in m.joints_at()], [90, 60, 30], "the arc that stays inside")
m.line(60, 30 - 24.9, 30)
m.rest()
# a spiral is farthest out where its growth ends its way inward: 99.9 straight beside the centre, 100.96 later
m.send(km.SET_CIRCLE, pos=[60 + 49.9 * 0.5, 30 + 49.9 * 0.75 ** 0.5, 30], center=[60, 30, 30], normal=[0, 0, 1],
       id=6, vel=20, ini_maxvel=20, acc=500, ini_maxjerk=5000, motion_type=3, turn=0)
eq(m.status()["commandStatus"], INVALID_PARAMS, "spiral beyond a limit")
told("Circular move on line 6 would exceed X's positive limit",
     "Circular move on line 6 would exceed joint 0's positive limit max:[100.000000]")

# ---- faults; joint, value and limit are in the log
m.mode(km.FREE)
m.set("joint.1.neg-lim-sw-in", 1)
m.sleep(0.01)
told("joint 1 on limit switch error")
eq(m.status()["enabled"], False, "off after a limit switch")
m.send(km.OVERRIDE_LIMITS, joint=1)
m.enable()
for pin, text in (("joint.2.amp-fault-in", "joint 2 amplifier fault"),
                  ("spindle.1.amp-fault-in", "spindle 1 amplifier fault")):
    m.set(pin, 1)
    m.sleep(0.01)
    told(text)
    eq(m.status()["enabled"], False, f"off after {text}")
    m.set(pin, 0)
    m.sleep(0.01)
    m.send(km.ABORT)
    m.enable()
m.send(km.SET_JOINT_MIN_FERROR, joint=0, minFerror=0)
m.send(km.SET_JOINT_MAX_FERROR, joint=0, maxFerror=0.001)
m.send(km.SET_JOINT_MOTOR_OFFSET, joint=0, motor_offset=0.5)  # the feedback does not know yet
m.sleep(0.02)
told("joint 0 following error")
m.send(km.SET_JOINT_MAX_FERROR, joint=0, maxFerror=1)
m.send(km.SET_JOINT_MIN_FERROR, joint=0, minFerror=1)
m.send(km.ABORT)
m.enable()
m.set("motion.enable", 0)
m.sleep(0.01)
told("motion stopped by enable input")
m.set("motion.enable", 1)
m.enable()

# ---- FP-068: the override is of the tripped switch and ends with the first jog
m.send(km.OVERRIDE_LIMITS, joint=1)
eq(m.status()["overrideLimitMask"], 1 << 2, "mask of the tripped switch")
refused(OK, "Can't jog joint 1 further past min hard limit.", km.JOG_INCR, joint=1, axis=-1, vel=-5, offset=1)
# a jog to a place goes where the place is, whatever the sign of its speed
refused(OK, "Can't jog joint 1 further past min hard limit.", km.JOG_ABS, joint=1, axis=-1, vel=5, offset=-90)
refused(OK, "Can't jog joint 1 further past min hard limit.", km.JOG_INCR, joint=1, axis=-1, vel=5, offset=-1)
m.send(km.JOG_ABS, joint=1, axis=-1, vel=-5, offset=m.joints_at()[1] + 1)
m.sleep(0.05)
m.set("joint.1.neg-lim-sw-in", 0)
m.rest()
m.sleep(0.01)
eq(m.status()["overrideLimitMask"], 0, "override after the jog")
eq(m.status()["enabled"], True, "still on")

# ---- FP-069: from outside a soft limit back inside, homed and in the same mode
m.send(km.JOG_ABS, joint=1, axis=-1, vel=50, offset=50)
m.rest()
m.send(km.SET_JOINT_POSITION_LIMITS, joint=1, minLimit=-100, maxLimit=40)
m.sleep(0.01)
told("Exceeded POSITIVE soft limit (40.00000) on joint 1", "Joint must be unhomed, jogged into limits, rehomed")
eq(m.get("motion.on-soft-limit"), True, "on soft limit")
refused(OK, "Can't jog joint 1 further past max soft limit.", km.JOG_CONT, joint=1, axis=-1, vel=5)
m.send(km.JOG_INCR, joint=1, axis=-1, vel=-50, offset=20)
m.rest()
eq((round(m.joints_at()[1], 9), m.get("motion.on-soft-limit"), m.get("joint.1.homed")),
   (30, False, True), "back inside")
m.send(km.SET_JOINT_POSITION_LIMITS, joint=1, minLimit=-100, maxLimit=100)

# ---- probing
m.mode(km.COORD)
PROBING, TRAVERSE = 5, 1


def probe(kind, x, at=None, back=False):
    m.send(km.CLEAR_PROBE_FLAGS)
    m.send(km.PROBE, pos=[x, 30, 30], vel=20, ini_maxvel=20, acc=500, ini_maxjerk=5000, id=1, motion_type=PROBING,
           probe_type=kind)
    if at is not None:
        m.wait(lambda s: abs(m.joints_at()[0] - at) < 0.1, "place of the contact")
        m.set("motion.probe-input", 0 if kind & 2 else 1)
        m.sleep(0.001)
        if back:  # FP-076: bounce while it brakes
            for value in (0, 1, 0, 1):
                m.set("motion.probe-input", value)
                m.sleep(0.001)
    m.rest()
    m.sleep(0.005)
    return m.status()


m.line(90, 30, 30, vel=50)
m.rest()
m.errors()
s = probe(0, 80, 85, back=True)
eq((s["probeTripped"], s["probing"], abs(s["probedPos"][0] - 85) < 0.2), (1, 0, True), "G38.2 contact")
told(what="bounce of a contact")
refused(BAD_EXEC, "Probe is already tripped when starting G38.2 or G38.3 move", km.PROBE, pos=[70, 30, 30],
        vel=1, acc=1, motion_type=PROBING, probe_type=0)
s = probe(2, 70, 78)
eq(s["probeTripped"], 1, "G38.4 loses contact")
refused(BAD_EXEC, "Probe is already clear when starting G38.4 or G38.5 move", km.PROBE, pos=[70, 30, 30], vel=1, acc=1,
        motion_type=PROBING, probe_type=2)
m.send(km.ABORT)
s = probe(0, 70)
told("G38.2 move finished without making contact.")
s = probe(1, 65)
eq((s["probeTripped"], abs(s["probedPos"][0] - 65) < 1e-9), (0, True), "G38.3 without contact")
m.set("motion.probe-input", 1)
m.sleep(0.01)
s = probe(2, 60)
told("G38.4 move finished without breaking contact.")
m.set("motion.probe-input", 0)
m.sleep(0.01)
m.line(0, 30, 30, vel=50, kind=TRAVERSE)  # FP-072
m.sleep(0.3)
m.set("motion.probe-input", 1)
at = m.joints_at()[0]
m.rest(2)
eq(m.joints_at()[0] > at - 10, True, "a contact in a rapid stops it")
told("Probe tripped during non-probe move.")
m.set("motion.probe-input", 0)
for inhibit in (0, 1):
    m.send(km.SET_PROBE_ERR_INHIBIT, probe_jog_err_inhibit=inhibit, probe_home_err_inhibit=0)
    for code, text, fields in ((km.FREE, "Probe tripped during a joint jog.", dict(joint=0, axis=-1)),
                               (km.TELEOP, "Probe tripped during a coordinate jog.", dict(joint=-1, axis=0))):
        m.send(km.ABORT)
        m.mode(code)
        m.send(km.JOG_CONT, vel=-30, **fields)
        m.sleep(0.2)
        m.set("motion.probe-input", 1)
        m.sleep(0.5)
        eq(m.get("motion.jog-is-active"), bool(inhibit), "jog after a contact")
        told(*([] if inhibit else [text]))
        m.send(km.JOG_ABORT, **fields)
        m.set("motion.probe-input", 0)
        m.sleep(0.5)

eq(m.violations(), [], "limits")

# ---- planner type, spindle numbers, outputs
m.send(km.SET_JERK, jerk=0.5)
refused(OK, "S-curve planner refused: no usable jerk limit - set [TRAJ]MAX_LINEAR_JERK and per-axis [AXIS_*]MAX_JERK",
        km.SET_PLANNER_TYPE, planner_type=1)
m.send(km.SET_JERK, jerk=5000)
m.send(km.SET_SCURVE_PEAK_SCALE, scurve_peak_scale=7)
eq(m.status()["scurve_peak_scale"], 1.0, "peak scale")
m.mode(km.COORD)
m.line(0, 0, 0, vel=20)
m.send(km.SET_PLANNER_TYPE, planner_type=0)
told("planner switch deferred until queued motion completes (requested type 0)")
eq(m.status()["planner_type"], 1, "planner type while moving")
m.rest()
m.sleep(0.01)
eq(m.status()["planner_type"], 0, "planner type at rest")
for code, fields, text in (
        (km.SPINDLE_ON, {}, "Attempt to start non-existent spindle"),
        (km.SPINDLE_OFF, {}, "Attempt to stop non-existent spindle <5>"),
        (km.SPINDLE_ORIENT, {}, "Attempt to orient non-existent spindle <5>"),
        (km.SPINDLE_INCREASE, {}, "Attempt to increase non-existent spindle <5>"),
        (km.SPINDLE_DECREASE, {}, "Attempt to decrease non-existent spindle <5>."),
        (km.SPINDLE_BRAKE_ENGAGE, {}, "Attempt to engage brake of non-existent spindle <5>"),
        (km.SPINDLE_BRAKE_RELEASE, {}, "Attempt to release brake of non-existent spindle <5>"),
        (km.SET_SPINDLE_PARAMS, {}, "Attempt to configure non-existent spindle")):
    refused(INVALID_COMMAND, text, code, spindle=5, **fields)
refused(OK, "Problem:\n  motmod configured for 2 spindles\n  but command requests 3 spindles\n  Using: 2 spindles",
        km.SET_NUM_SPINDLES, spindle=3)
refused(OK, "ERROR: index out of range, 4 not in [0..4] (increase num_dio/EMCMOT_MAX_DIO=64)", km.SET_DOUT, out=4,
        now=1, start=1)
refused(OK, "ERROR: index out of range, 2 not in [0..2] (increase num_aio/EMCMOT_MAX_AIO=64)", km.SET_AOUT, out=2,
        now=1, minLimit=1)
m.send(km.SET_DOUT, out=3, now=1, start=1)
m.send(km.SET_AOUT, out=1, now=1, minLimit=2.5)
eq((m.get("motion.digital-out-03"), m.get("motion.analog-out-01")), (True, 2.5), "outputs at once")
m.send(km.SET_DOUT, out=3, now=0, start=0, end=0)
m.sleep(0.05)
eq(m.get("motion.digital-out-03"), True, "queued output waits for a move")
m.line(1, 0, 0)
m.rest()
eq(m.get("motion.digital-out-03"), False, "queued output with the move")
m.send(km.SET_OFFSET, tool_offset=[1, 2, 3, 4, 5, 6, 7, 8, 9])
m.sleep(0.002)
eq([m.get(f"motion.tooloffset.{a}") for a in "xyzabcuvw"], [1, 2, 3, 4, 5, 6, 7, 8, 9], "tool offset pins")
m.mode(km.FREE)
m.send(km.SET_JOINT_POSITION_LIMITS, joint=2, minLimit=-100, maxLimit=m.joints_at()[2] - 1)
m.sleep(0.01)
m.errors()
refused(OK, "Can't jog joint 2 further past max soft limit.", km.JOG_CONT, joint=2, axis=-1, vel=5)
eq(m.get("joint.2.error"), True, "joint error flag")
m.set("joint.2.amp-fault-in", 1)
m.sleep(0.01)
told("joint 2 amplifier fault")
eq(m.status()["enabled"], False, "off after a fault beside an error")
m.close()
lines = [x[8:].strip() for x in open(log.name) if x.startswith("motion: joint")]
eq(lines[:2], ["joint 1: negative limit switch at position 5.10000", "joint 2: amplifier fault at position 30.00000"],
   "log")
eq(lines[2].startswith("joint 0: following error 0.50000, limit 0.00000 at velocity"), True, f"log {lines[2]}")
print(f"{eq.checks} checks")
