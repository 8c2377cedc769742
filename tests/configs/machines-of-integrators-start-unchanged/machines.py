# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes machines as integrators build them, each with its program part.ngc."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "lib"))
from machine import machine  # noqa: E402

SIM = "HALFILE = LIB:basic_sim.tcl -no_use_hal_manualtoolchange\n"
STDGLUE = sys.argv[1]
PYTHON = f"[PYTHON]\nPATH_PREPEND = ./python\nPATH_APPEND = {STDGLUE}\nTOPLEVEL = ./python/toplevel.py\nLOG_LEVEL = 0\n"
GLUE = {"python/toplevel.py": "import remap\n", "python/remap.py": "from stdglue import *\n"}
MOVE = "G20 G90 G0 X1 Y1\nG1 F60 X2\nG0 X0 Y0\nM2\n"
XZ = "G20 G18 G0 X1 Z1\nG0 X0\nM2\n"


def sub(name, body="", result=" [1]"):
    return f"o<{name}> sub\n{body}o<{name}> endsub{result}\nM2\n"


# Kinematics, motion and loops by hand, as most small machines have them.
def loops(joints, base=False):
    return (f"loadrt [KINS]KINEMATICS\nloadrt [EMCMOT]EMCMOT "
            f"{'base_period_nsec=[EMCMOT](BASE_PERIOD) ' if base else ''}"
            "servo_period_nsec=[EMCMOT]SERVO_PERIOD num_joints=[KINS](JOINTS)\n"
            "addf motion-command-handler servo-thread\naddf motion-controller servo-thread\n"
            + "".join(f"net J{j}pos joint.{j}.motor-pos-cmd => joint.{j}.motor-pos-fb\n" for j in range(joints))
            + "net estop-loop iocontrol.0.user-enable-out iocontrol.0.emc-enable-in\n"
              "net tool-prep-loop iocontrol.0.tool-prepare iocontrol.0.tool-prepared\n"
              "net tool-change-loop iocontrol.0.tool-change iocontrol.0.tool-changed\n")


machine("builtins", SIM, sections="""[RS274NGC]
SUBROUTINE_PATH = subs:nowhere
ON_ABORT_COMMAND = O <on_abort> call
REMAP = T prolog=prepare_prolog ngc=prepare epilog=prepare_epilog
REMAP = M6 modalgroup=6 prolog=change_prolog ngc=change epilog=change_epilog
REMAP = M61 modalgroup=6 prolog=settool_prolog ngc=settool epilog=settool_epilog
REMAP = S prolog=setspeed_prolog ngc=setspeed epilog=setspeed_epilog
REMAP = F prolog=setfeed_prolog ngc=setfeed epilog=setfeed_epilog
REMAP = M7 modalgroup=8 ngc=mist
""" + PYTHON, files=GLUE | {
    "subs/prepare.ngc": sub("prepare"), "subs/change.ngc": sub("change"), "subs/settool.ngc": sub("settool"),
    "subs/setspeed.ngc": sub("setspeed"), "subs/setfeed.ngc": sub("setfeed"), "subs/mist.ngc": sub("mist", "M7\n", ""),
    "subs/on_abort.ngc": sub("on_abort", "M65 P0\n", ""),
    "part.ngc": "G20 G90\nT1 M6\nM61 Q1\nS300 F30\nM7\nG1 X.5\nM9\nM2\n"})
machine("codes", SIM, sections="""[RS274NGC]
SUBROUTINE_PATH = subs
REMAP = M400 modalgroup=10 argspec=Pq ngc=withwords
REMAP = M410 modalgroup=10 argspec=P py=m410
REMAP = G88.6 modalgroup=1 argspec=xyz py=g886
REMAP = G13 modalgroup=1 py=g13
""" + PYTHON, files={
    "python/toplevel.py": "import oword\nimport remap\n",
    "python/oword.py": "from interpreter import *\ndef multiply(self, *args):\n"
                       "    self.return_value = args[0] * args[1]\n    return INTERP_OK\n",
    "python/util.py": "import inspect\ndef lineno():\n    return inspect.currentframe().f_back.f_lineno\n",
    "python/remap.py": """from interpreter import *
from emccanon import MESSAGE
from util import lineno
def m410(self, p):
    self.execute('G0 X%f' % p, lineno())
    return INTERP_OK
def g886(self, **words):
    for name, value in words.items():
        MESSAGE('%s=%s' % (name, value))
    return INTERP_OK
def g13(self, **words):
    yield INTERP_EXECUTE_FINISH
    return INTERP_OK
""",
    "subs/withwords.ngc": sub("withwords", "(debug, P is #<p>)\n", ""),
    "part.ngc": "G20 G90\nM400 P1\nM410 P.5\nG88.6 X1 Y2\nG13\no<multiply> call [2] [3]\nG0 X[#<_value>/6]\nG80\nM2\n"})
machine("wear", SIM, "XZ", kins="trivkins coordinates=xz", sections="""[RS274NGC]
REMAP = T python=index_lathe_tool_with_wear
""" + PYTHON, files=GLUE | {"part.ngc": "G20 G18\nT0101\nG0 X1 Z1\nG0 X0.5\nM2\n",
                            "tool.tbl": "T1 P1 X1 Z1 D0.1 Q2\nT10001 P10001 Z0.01\n"})
machine("twopass", "TWOPASS = verbose\nHALFILE = core_sim.hal\nHALFILE = sim_spindle_encoder.hal\n"
                   "HALFILE = simulated_home.hal\n"
        "HALFILE = first.hal\nHALFILE = second.hal\nHALFILE = kept.hal", kins="trivkins", base=50000,
        home=(0, 2, -0.2), files={
            "first.hal": "loadrt hypot names=spare\nloadrt flipflop count=2 # two of them\naddf spare servo-thread\n",
            "second.hal": "loadrt hypot names=more\naddf more servo-thread\nnet probe-in => motion.probe-input\n",
            "kept.hal": "# NOTWOPASS\nshow comp hypot\n", "part.ngc": MOVE})
machine("extra", "TWOPASS = on\n" + SIM + "HALFILE = ./extra.tcl", "XYYZ",
        kins="trivkins coordinates=XYYZ kinstype=both", motmod=" num_extrajoints=2", files={
            "extra.tcl": "for {set j 4} {$j < 6} {incr j} {\n  loadrt limit3 names=j${j}_lim\n"
                         "  addf j${j}_lim servo-thread\n"
                         "  setp j${j}_lim.maxv 1\n  setp j${j}_lim.maxa 10\n"
                         "  net j${j}:out j${j}_lim.out joint.$j.posthome-cmd\n}\n",
            "part.ngc": MOVE}, sequences=(1, -2, -2, 0), joints=6)
machine("indexer", SIM + "HALFILE = LIB:wheeljogpins.tcl 0.1\nHALCMD = loadrt timedelay\n"
                         "HALCMD = addf timedelay.0 servo-thread\n"
        "HALCMD = net unlock joint.3.unlock timedelay.0.in\nHALCMD = net unlocked timedelay.0.out joint.3.is-unlocked\n"
        "HALCMD = setp timedelay.0.on-delay 0.75", "XYZB", kins="trivkins coordinates=xyzb",
        motmod=" unlock_joints_mask=0x08",
        sections="[AXIS_B]\nLOCKING_INDEXER_JOINT = 3\nWRAPPED_ROTARY = 1\n[JOINT_3]\nLOCKING_INDEXER = 1\n",
        files={"part.ngc": "G20 G90 G0 B4\nG0 X1\nM2\n"})
machine("shared", "HALFILE = core_sim.hal\nHALFILE = switch.hal", kins="trivkins", base=50000, home=(1, 2, -0.2),
        joint_extra="HOME_IS_SHARED = 1\n", files={
            "switch.hal": "loadrt comp names=cx,cy,cz\nloadrt or2 names=oxy,oxyz\n"
                          + "".join(f"addf {f} servo-thread\n" for f in ("cx", "cy", "cz", "oxy", "oxyz"))
                          + "".join(f"setp c{a}.hyst .02\nsetp c{a}.in0 1\nnet {a.upper()}pos c{a}.in1\n"
                                    for a in "xyz")
                          + "net a cx.out oxy.in0\nnet b cy.out oxy.in1\nnet ab oxy.out oxyz.in0\n"
                            "net c cz.out oxyz.in1\n"
                            "net all oxyz.out joint.0.home-sw-in joint.1.home-sw-in joint.2.home-sw-in\n",
            "part.ngc": MOVE})
machine("table", SIM + "HALCMD = net :select <= motion.analog-out-03\nHALCMD = net :select => motion.switchkins-type\n"
        "HALCMD = net offset motion.tooloffset.z xyzac-trt-kins.tool-offset", "XYZAC",
        kins="xyzac-trt-kins sparm=identityfirst", sections="""[RS274NGC]
SUBROUTINE_PATH = ./remap_subs
HAL_PIN_VARS = 1
REMAP = M428 modalgroup=10 ngc=428remap
REMAP = M429 modalgroup=10 ngc=429remap
""", files={f"remap_subs/{m}remap.ngc": f"o<{m}remap> sub\nM68 E3 Q{q}\nM66 E0 L0\no2 if [#<_task>]\n"
                                        f"o1 if [#<_hal[motion.switchkins-type]> NE {q}]\n"
                                        f"(abort,no switch)\no1 endif\no2 endif\no<{m}remap> endsub\nM2\n"
                                        for m, q in (("428", 0), ("429", 1))}
        | {"part.ngc": "G20 G90\nM429\nG1 F60 X1 A5\nM428\nG0 X0 A0\nM2\n"})
machine("random", SIM, sections="[EMCIO]\nRANDOM_TOOLCHANGER = 1\n[SPINDLE_0]\nMAX_FORWARD_VELOCITY = 3000\n"
                                "INCREMENT = 50\n", files={
    "tool.tbl": "T1 P0 Z0.1\nT2 P1 Z0.2\nT3 P2 Z0.3\n", "part.ngc": "G20 G90\nT3 M6 G43\nG0 X1\nT1 M6\nG0 X0\nM2\n"})
machine("two-spindles", "HALFILE = hand.hal", "XZ", kins="trivkins coordinates=xz", spindles=2,
        motmod=" num_spindles=2", base=100000,
        files={"hand.hal": loops(2, base=True)
               + "net at0 spindle.0.on => spindle.0.at-speed\nnet at1 spindle.1.on => spindle.1.at-speed\n",
               "part.ngc": "M3 S200 $0\nM4 S100 $1\nG20 F10 G1 X.02\nM5 $-1\n" + XZ})
machine("cutter", "TWOPASS = ON\nHALFILE = sim.tcl\nHALFILE = qtplasmac_comp.hal\nHALFILE = custom.hal", "XYYZ",
        kins="trivkins coordinates=xyyz kinstype=both", spindles=3, motmod=" num_spindles=3",
        sequences=(1, -2, -2, 0), files={
            "sim.tcl": "loadrt {*}[join $::KINS(KINEMATICS)]\n"
                       "loadrt {*}[join $::EMCMOT(EMCMOT)] servo_period_nsec=$::EMCMOT(SERVO_PERIOD) "
                       "num_joints=$::KINS(JOINTS)\naddf motion-command-handler servo-thread\n"
                       "addf motion-controller servo-thread\n"
                       "for {set i 0} {$i < 4} {incr i} {\n  net pos-$i joint.$i.motor-pos-cmd "
                       "joint.$i.motor-pos-fb\n}\n"
                       "net sim:estop iocontrol.0.user-enable-out iocontrol.0.emc-enable-in\n"
                       "net plasmac:tool-prepare iocontrol.0.tool-prepare iocontrol.0.tool-prepared\n"
                       "net plasmac:tool-change iocontrol.0.tool-change iocontrol.0.tool-changed\n",
            "custom.hal": "# mine\nnet plasmac:arc-voltage-raw plasmac.arc-voltage-in\n", "part.ngc": MOVE})
machine("old-version", "HALFILE = hand.hal\n#INCLUDE more.inc\n", kins="trivkins", files={
    "hand.hal": loops(3) + "net speed motion.spindle-speed-out\nnet on motion.spindle-on\n",
    "more.inc": "HALCMD = getp spindle.0.on\n", "part.ngc": MOVE})
ini = Path("old-version/old-version.ini")
ini.write_text(ini.read_text().replace("VERSION = 1.1", "VERSION = 1.0"))
