# SPDX-License-Identifier: GPL-2.0-or-later
# The status of a running machine as a client of LinuxCNC 2.10 decodes it: every field by its documented place, against
# what the Python module says.
import os
import struct
import sys

from mill import *

sys.path.insert(0, str(Path(os.environ["EMC2_HOME"]) / "tests/nml/lib"))
import wire

SIZES = {"i": 4, "q": 8, "Q": 8, "d": 8}


class Decoder:
    def __init__(self, data):
        self.data, self.at = data, 0

    def take(self, code, count=None):
        """Numbers in network order: i int, bool and char, q and Q 64 bits, d double."""
        n = 1 if count is None else count
        values = struct.unpack_from(f">{n}{code}", self.data, self.at)
        self.at += n * SIZES[code]
        return values[0] if count is None else values

    def text(self):
        length = self.take("i")
        value = self.data[self.at:self.at + length].split(b"\0")[0].decode()
        self.at += length + -length % 4
        return value

    def struct(self, fields):
        """Fields "name:code", "name:code*count", "name:text"."""
        self.take("i", 4)  # command_type, echo_serial_number, status, _state
        got = {}
        for field in fields.split():
            name, code = field.split(":")
            count = int(code[2:]) if "*" in code else None
            got[name] = self.text() if code == "text" else self.take(code[0], count)
        return got


TASK = ("taskbeat:Q task_mode:i task_state:i exec_state:i interp_state:i call_level:i motion_line:i current_line:i "
        "read_line:i optional_stop:i block_delete:i"
        " input_timeout:i file:text command:text ini_filename:text g5x_offset:d*9 g5x_index:i g92_offset:d*9 "
        "rotation_xy:d tool_offset:d*9 gcodes:i*17 mcodes:i*10"
        " settings:d*5 program_units:i interpreter_errcode:i task_paused:i delay_left:d queued_mdi_commands:i")
TRAJ = ("linear_units:d angular_units:d cycle_time:d joints:i spindles:i axis_mask:i motion_mode:i enabled:i inpos:i "
        "queue:i active_queue:i queue_full:i motion_id:i"
        " paused:i single_stepping:i feedrate:d rapidrate:d position:d*9 actual_position:d*9 velocity:d "
        "acceleration:d max_velocity:d max_acceleration:d"
        " probed_position:d*9 probe_tripped:i probing:i probe_val:i kinematics_type:i motion_type:i distance_to_go:d "
        "dtg:d*9 current_vel:d"
        " feed_override_enabled:i adaptive_feed_enabled:i feed_hold_enabled:i")
JOINT = ("number:i jointType:i units:d backlash:d min_position_limit:d max_position_limit:d max_ferror:d min_ferror:d "
         "ferror_current:d ferror_highmark:d output:d input:d"
         " velocity:d inpos:i homing:i homed:i fault:i enabled:i min_soft_limit:i max_soft_limit:i min_hard_limit:i "
         "max_hard_limit:i override_limits:i")
AXIS = "number:i min_position_limit:d max_position_limit:d velocity:d"
SPINDLE = ("speed:d override:d css_maximum:d css_factor:d state:i direction:i brake:i increasing:i enabled:i "
           "orient_state:i orient_fault:i override_enabled:i homed:i")
OWN = {"number", "css_maximum", "css_factor", "state", "increasing"}


def compare(got, want):
    return [(n, v, want[n]) for n, v in got.items() if n not in OWN and v != want[n]]


def status():
    """The differences between the wire and the module at one moment."""
    poll()
    data = client.read(wire.STATUS, 3)[2]
    d = Decoder(data)
    kind, _ = d.take("i"), d.take("q")
    d.take("i", 4)
    wrong = compare(d.struct(TASK), {n: getattr(s, n) for n in dir(s) if not n.startswith("__")})
    d.take("i", 4)
    wrong += compare(d.struct(TRAJ), {n: getattr(s, n) for n in dir(s) if not n.startswith("__")})
    for n in range(16):
        wrong += compare(d.struct(JOINT), s.joint[n])
    for n in range(9):
        wrong += compare(d.struct(AXIS), s.axis[n])
    for n in range(8):
        wrong += compare(d.struct(SPINDLE), s.spindle[n])
    rest = {"din": d.take("i", 64), "dout": d.take("i", 64), "ain": d.take("d", 64), "aout": d.take("d", 64),
            "misc_error": d.take("i", 64)}
    d.take("i", 3)
    d.take("d", 9)
    rest |= {"num_extrajoints": d.take("i"), "jogging": d.take("i"), "heartbeat": d.take("Q")}
    jogging = rest.pop("jogging")
    d.take("i", 4)
    d.take("i", 3)
    rest |= (d.struct("pocket_prepped:i tool_in_spindle:i tool_from_pocket:i") | d.struct("mist:i flood:i")
             | d.struct("estop:i"))
    rest["debug"] = d.take("i")
    wrong += compare(rest, {n: getattr(s, n) for n in rest})
    return kind, wrong, d.at <= len(data), jogging


on()
client = wire.Client()
print("idle:", status())
for line in ("G10 L2 P2 X1 Y2 Z3 R10", "G55 G92 X5", "T2 M6", "G43", "M3 S700", "M7 M8", "M64 P1", "M68 E2 Q3.5", "T1"):
    mdi(line)
c.debug(0x10)
c.feedrate(0.7)
c.rapidrate(0.6)
c.spindleoverride(0.8)
mode(MODE_MDI)
c.mdi("G1 F300 X40 Z70")
need(lambda s: s.current_vel > 1, "motion")
print("moving:", status())
c.abort()
idle()
setp("motion.digital-in-03", 1)
setp("joint.1.pos-lim-sw-in", 1)
sleep(0.2)
print("on a switch:", status())
setp("joint.1.pos-lim-sw-in", 0)
on(home=False)
mode(MODE_MANUAL)
c.teleop_enable(1)
need(lambda s: s.motion_mode == TRAJ_MODE_TELEOP, "teleop")
c.jog(JOG_CONTINUOUS, 0, 0, 3)
need(lambda s: s.axis[0]["velocity"] > 2, "jog")
print("jogging:", status())
