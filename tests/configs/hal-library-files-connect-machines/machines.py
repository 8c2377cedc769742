# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes small machines, one folder each, that are put together from files of the HAL library."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "lib"))
from machine import machine  # noqa: E402

SERVO = """INPUT_SCALE = 4000
DRIVE_RATIO = 1
MOTOR_PPR = 1000
PGAIN = 40
IGAIN = 0
DGAIN = 0
BIAS = 0
FF0 = 0
FF1 = 1
FF2 = 0
DEADBAND = 0
MIN_HARD_LIMIT = -11
MIN_HARD_LIMIT_RELEASE = -12
MAX_HARD_LIMIT = 11
MAX_HARD_LIMIT_RELEASE = 12
HOME_SW_MIN = 0.5
HOME_SW_MAX = 0.7
"""

SIM = "HALFILE = LIB:basic_sim.tcl\n"
machine("plain", SIM)
machine("nine", SIM + "HALFILE = LIB:locking_indexer.hal", "XYZABCUVW", motmod=" unlock_joints_mask=0x10")
machine("pass2", "TWOPASS = verbose\n" + SIM + "HALFILE = LIB:halcheck.tcl nopopup")
machine("wheel", SIM + "HALFILE = LIB:wheeljogpins.tcl 0.25\nHALCMD = getp axis.y.jog-scale\n"
                       "HALCMD = getp joint.2.jog-enable")
for twopass in ("", "TWOPASS = on\n"):
    machine("moveoff" + ("2" if twopass else ""), twopass + SIM +
            "HALFILE = LIB:hookup_moveoff.tcl\nHALFILE = LIB:moveoff_external.hal\n"
            "HALCMD = getp mv.offset-vel-1\nHALCMD = getp mv.offset-max-2\nHALCMD = getp mv.epsilon",
            extra="[MOVEOFF]\nEPSILON = 0.002\n[MOVEOFF_2]\nMAX_LIMIT = 3\nMAX_VELOCITY = 2\nMAX_ACCELERATION = "
                  "20\nMIN_LIMIT = -3")
for twopass in ("", "TWOPASS = on\n"):
    machine("plasma" + ("2" if twopass else ""), twopass + SIM +
            "HALFILE = LIB:plasmac.tcl\nHALCMD = getp plasmac.axis-y-max-limit\nHALCMD = getp plasmac.units-per-mm",
            "XYYZ", kins="trivkins coordinates=xyyz kinstype=both", spindles=3, motmod=" num_spindles=3")
machine("qtplasma", SIM + "HALFILE = LIB:qtplasmac_comp.hal", "XYYZ", kins="trivkins coordinates=xyyz kinstype=both",
        spindles=3, motmod=" num_spindles=3")
machine("servo", "HALFILE = LIB:servo_sim.hal", joint_extra=SERVO, home=(0.5, 1, -0.1), base=50000, kins="trivkins")
machine("gantry", "HALFILE = LIB:gantrysim.hal\nHALFILE = LIB:simulated-gantry-home.hal", "XYZY",
        kins="trivkins coordinates=xyzy kinstype=both",
        home=((-0.1, -1, 0.1), (-0.1, -1, 0.1), (0.1, 1, -0.1), (-0.1, -1, 0.1)), sequences=(2, -3, 1, -3))
machine("tripod", "HALFILE = LIB:tripodsim.hal", kins="tripodkins")
Path("tripod/connect-only").touch()      # their kinematics can not reach the part
machine("lathe", "HALFILE = LIB:core_sim.hal\nHALFILE = LIB:lathe.hal\nHALFILE = LIB:simulated_home.hal\n"
                 "HALFILE = LIB:check_xyz_constraints.hal",
        kins="trivkins", base=50000, home=(0, 2, -0.2))
machine("ldelta", "HALFILE = LIB:sim_ldelta.hal\nHALFILE = LIB:axis_manualtoolchange.hal", "XYZA",
        kins="lineardeltakins")
Path("ldelta/connect-only").touch()
machine("rdelta", "HALFILE = LIB:sim_rdelta.hal", "XYZABCUVW", kins="rotarydeltakins")
Path("rdelta/connect-only").touch()
machine("show", SIM + "HALFILE = LIB:var_show.tcl")
machine("check", "HALFILE = LIB:core_sim.hal\nHALFILE = LIB:simulated_home.hal\nHALFILE = loose.hal\n"
                 "HALFILE = LIB:halcheck.tcl nopopup",
        kins="trivkins", base=50000)
Path("check/loose.hal").write_text("loadrt and2\nnet alone and2.0.in0\nnet silent <= and2.0.out\n")
machine("sampled", SIM + "HALFILE = s.hal")
Path("sampled/s.hal").write_text("loadrt sampler depth=100 cfg=f\naddf sampler.0 servo-thread\n")
sys.exit(0)
