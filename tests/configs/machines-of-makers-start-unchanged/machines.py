# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes machines as makers put them together, each with its program part.ngc."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "lib"))
from machine import machine  # noqa: E402

SIM = "HALFILE = LIB:basic_sim.tcl -no_use_hal_manualtoolchange\n"
MOVE = "G20 G90 G0 X1 Y1\nG1 F60 X2\nG0 X0 Y0\nM2\n"
CORE = ("loadrt [KINS]KINEMATICS\nloadrt [EMCMOT]EMCMOT base_period_nsec=[EMCMOT]BASE_PERIOD "
        "servo_period_nsec=[EMCMOT]SERVO_PERIOD "
        "num_joints=[KINS]JOINTS\naddf motion-command-handler servo-thread\naddf motion-controller servo-thread\n")
LOOPS = "net prepare iocontrol.0.tool-prepare iocontrol.0.tool-prepared\nnet change iocontrol.0.tool-change iocontrol.0.tool-changed\n"
ESTOP = "net estop-loop iocontrol.0.user-enable-out => iocontrol.0.emc-enable-in\n"


def feedback(joints):
    return "".join(f"net j{j} joint.{j}.motor-pos-cmd => joint.{j}.motor-pos-fb\n" for j in joints)


def rewrite(name, change):
    path = Path(name, f"{name}.ini")
    path.write_bytes(change(path.read_bytes()))


machine("text", 'HALFILE = ./hal/core.hal\nHALFILE = more.tcl one 3\nHALCMD = source hal/last.hal', files={
    "hal/core.hal": CORE + LOOPS + ESTOP + feedback((1, 2)) + """newsig j0 float
linkps joint.0.motor-pos-cmd => j0
linksp j0 => joint.0.motor-pos-fb
loadrt and2 \\
   count=2
addf and2.0 servo-thread -1
addf and2.1 servo-thread 3
alias pin and2.0.in0 door.closed
setp door.closed TRUE
net  sum\tand2.0.out  =>  and2.1.in0   # tabs, blanks
unlinkp and2.1.in0
loadrt mux2 names=a.b,c-d
setp a.b.in0 [AXIS_X](MAX_VELOCITY)
setp a.b.in1 -[AXIS_X]MAX_LIMIT
setp c-d.in0 $(HALVALUE)
lock tune
unlock all
""", "more.tcl": """puts "argv: $argv, $::AXIS_X(MAX_LIMIT) [lindex $::HAL(HALFILE) 0]"
setp and2.0.in1 [expr {[lindex $argv end] > 2}]
source [file join [file dirname [info script]] hal/inc.tcl]
puts "from a program: [exec halcmd getp and2.0.in1] [exec echo plain]"
exec halcmd -f << {
newsig by-text bit
sets by-text 1
}
if {![hal gets by-text]} { error "by-text is not set" }
if {![catch {exec halcmd getp nothing} text]} { error "no error: $text" }
package require Linuxcnc
if {[emc_ini JOINTS KINS] != 3} { error joints }
source $::env(HALLIB_DIR)/hal_procs_lib.tcl
""", "hal/inc.tcl": "proc connect {a b} { net $a $b }\nconnect on halui.machine.is-on\n", "hal/last.hal": "show sig sum\nsetp c-d.sel 1\n",
    "part.ngc": MOVE})
machine("rose", SIM, kins="rosekins", files={"part.ngc": "G20 G0 X3 Y0\nG1 F60 X2 Y2\nG1 X0 Y3\nM2\n"})
rewrite("rose", lambda b: b.replace(b"[JOINT_2]\nTYPE = LINEAR\nMIN_LIMIT = -10.001\nMAX_LIMIT = 10.001\n"
                                    b"MAX_VELOCITY = 5\nMAX_ACCELERATION = 50",
                                    b"[JOINT_2]\nTYPE = ANGULAR\nMIN_LIMIT = -36000\nMAX_LIMIT = 36000\n"
                                    b"MAX_VELOCITY = 360\nMAX_ACCELERATION = 3600"))
PROGRAM = """#!/usr/bin/env python3
from tooldb import tooldb_callbacks, tooldb_tools, tooldb_loop
pocket = {pockets}
def note(*words):
    pass
tooldb_tools(list(pocket))
tooldb_callbacks(lambda t: 'T%d P%d Z%.2f D.1' % (t, pocket[t], t / 100), note, note, note)
tooldb_loop()
"""
for name, random, pockets in (("tools", 0, {t: t for t in (1, 2, 10)}), ("arms", 1, {0: 0, 1: 3, 2: 2, 10: 1})):
    machine(name, SIM, sections=f"[EMCIO]\nDB_PROGRAM = ./tools.py\nRANDOM_TOOLCHANGER = {random}\n", files={
        "tools.py": PROGRAM.format(pockets=pockets),
        "part.ngc": "G20\nT10 M6\nG43\no1 if [#<_task>]\no2 if [#5403 NE 0.1]\n(abort,offset)\no2 endif\no1 endif\n"
                    "T2 M6\nG0 X1\nT1 M6\nG0 X0\nM2\n"})
machine("windows", "HALFILE = core.hal\nHALFILE = probe.tcl", files={
    "core.hal": (CORE + LOOPS + ESTOP + feedback(range(3))).replace(" ", "\t").replace("\n", "\r\n"),
    "probe.tcl": "if {$::KINS(JOINTS) == 3} {\r\n  net probe motion.probe-input\r\n}\r\n",
    "part.ngc": MOVE.replace("\n", "\r\n")})
rewrite("windows", lambda b: b.replace(b" = ", b"\t=\t").replace(b"[TRAJ]",
                                                                 b"  [ TRAJ ]  # trajectory").replace(b"\nMAX_", b"\n\tMAX_").replace(b"\n", b"\r\n"))
machine("pendant", SIM + "HALFILE = LIB:xhc-hb04.tcl", "XYZC", kins="trivkins coordinates=xyzc", sections="""[HALUI]
MDI_COMMAND = G0 X0 Y0
[XHC_HB04_CONFIG]
layout = 2
coords = x y z c
coefs = 1 1 1 1
scale = 1 1 1 1
threadname = servo-thread
sequence = 1
jogmode = normal
require_pendant = no
[XHC_HB04_BUTTONS]
name =
button-goto-zero = halui.mdi-command-00
button-start-pause = std_start_pause
button-step = xhc-hb04.stepsize-up
button-macro-1 = ""
""", files={"part.ngc": "G20 G0 X1 C5\nG0 X0 C0\nM2\n"})
machine("laser", SIM + "HALFILE = laser.hal", kins="corexykins", sections="""[RS274NGC]
SUBROUTINE_PATH = subs
REMAP = M10 modalgroup=10 argspec=P py=m10
REMAP = M11 modalgroup=10 py=m11
REMAP=M12 modalgroup=10 argspec=P ngc=m12
[PYTHON]
TOPLEVEL = python/toplevel.py
PATH_PREPEND = python
""", files={
    "laser.hal": "loadrt raster\nloadrt laserpower names=lp\naddf raster.0 servo-thread\naddf lp servo-thread\n"
                 "net vel motion.current-vel lp.cur-velocity\nnet req motion.requested-vel lp.req-velocity\n"
                 "setp lp.max-power 100\n",
    "python/toplevel.py": """import remap
def __init__(self):
    if self.task:
        remap.make_pins()
""", "python/remap.py": """from interpreter import *
import hal
def make_pins():
    global pins
    pins = hal.component('laser-codes')
    pins.newpin('power', hal.HAL_FLOAT, hal.HAL_OUT)
    pins.ready()
def m10(self, **words):
    if self.task:
        pins['power'] = words['p']
        print('P is', words['p'])
    return INTERP_OK
def m11(self, **words):
    self.execute('G91 G0 X1', 1)
    self.execute('G90')
    yield INTERP_EXECUTE_FINISH
    return INTERP_OK
""", "subs/m12.ngc": "o<m12> sub\nG4 P#<p>\nM68 E1 Q#<p>\no<m12> endsub\nM2\n",
    "part.ngc": "G20 G0 X1 Y1\nM10 P3\nM11\nM12 P.1\nG1 F60 X2\nG0 X0 Y0\nM2\n"})
machine("geared", "HALFILE = geared.hal", "XYZA", base=50000, kins="trivkins coordinates=XYZA",
        joint_extra="SCALE = 2000\nSTEPGEN_MAXACCEL = 60\n", files={
    "geared.hal": CORE + LOOPS + """loadrt hal_parport cfg="0x378"
loadrt stepgen step_type=0,0,0,0,0 ctrl_type=p,p,p,p,v
loadrt gearchange count=1
loadrt estop_latch
addf parport.0.read base-thread
addf stepgen.make-pulses base-thread
addf parport.0.write base-thread
addf parport.0.reset base-thread
addf stepgen.capture-position servo-thread
addf estop-latch.0 servo-thread
addf gearchange.0 servo-thread
addf stepgen.update-freq servo-thread
setp parport.0.reset-time 1000
setp parport.0.pin-02-out-reset 1
""" + "".join(f"setp stepgen.{i}.position-scale [JOINT_{i}]SCALE\nsetp stepgen.{i}.steplen 1\n"
              f"setp stepgen.{i}.stepspace 0\nsetp stepgen.{i}.maxaccel "
              f"[JOINT_{i}]STEPGEN_MAXACCEL\nnet cmd{i} joint.{i}.motor-pos-cmd => stepgen.{i}.position-cmd\n"
              f"net fb{i} stepgen.{i}.position-fb => "
              f"joint.{i}.motor-pos-fb\nnet on{i} joint.{i}.amp-enable-out => stepgen.{i}.enable\n"
              f"net step{i} <= stepgen.{i}.step\n" for i in range(4)) + """
net step0 => parport.0.pin-02-out
net speed spindle.0.speed-out-abs => gearchange.0.speed-in
net turned gearchange.0.speed-out => stepgen.4.velocity-cmd
net turning spindle.0.on => stepgen.4.enable
setp gearchange.0.max1 3000
setp stepgen.4.maxaccel 100
net reset iocontrol.0.user-request-enable estop-latch.0.reset
net ok estop-latch.0.ok-out iocontrol.0.emc-enable-in
setp estop-latch.0.ok-in 1
""", "part.ngc": "G20 G0 X.1 Y.1 A.5\nM3 S100\nG1 F30 X.2\nM5\nG0 X0 Y0 A0\nM2\n"})
rewrite("geared", lambda b: b.replace(b"MAX_VELOCITY = 5", b"MAX_VELOCITY = 1").replace(b"MAX_ACCELERATION = 50", b"MAX_ACCELERATION = 20"))
LETTERS = "XYZABCUVWXYZABCU"
machine("many", SIM, LETTERS, kins=f"trivkins coordinates={LETTERS} kinstype=both", sequences=[1] * 16,
        files={"part.ngc": "G20 G0 X1 A1 W1\nG0 X0\nM2\n"})
