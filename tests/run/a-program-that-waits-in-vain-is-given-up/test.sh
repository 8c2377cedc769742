#!/bin/bash
# Nobody is in front of a machine that kerf-run runs: M0, M1 and the question for a tool are answered, and what waits
# for anything else is given up and named. A program may end at once.
unset KERF_CLOCK DISPLAY
rm -rf work; mkdir work; trap 'cd ..; rm -rf work' EXIT
cd work
/usr/bin/python3 - <<'END'
import sys
sys.path.insert(0, "../../../configs/lib")
from machine import machine
HAND = ("HALFILE = LIB:basic_sim.tcl -no_use_hal_manualtoolchange -no_sim_spindle\nHALCMD = unlinkp iocontrol.0.tool-prepared\n"
        "HALCMD = unlinkp iocontrol.0.tool-changed\nHALCMD = setp iocontrol.0.tool-prepared 1\nHALCMD = setp spindle.0.at-speed 0")
machine("asks", "HALFILE = LIB:basic_sim.tcl", files={"part.ngc": "G20 G90\nT1 M6\nM0\nM1\nG0 X1\nM2\n", "end.ngc": "M2\n"})
machine("waits", HAND, files={"tool.ngc": "G20 G90\nG4 P20\nT1 M6\nM2\n", "spindle.ngc": "G20 G90\nM3 S100\nG1 F10 X1\nM2\n"})
END
for run in asks/part asks/end waits/tool waits/spindle; do
    echo "== $run"
    m=${run%/*}
    kerf-run --ini $m/$m.ini --patience 10 --picture p.png $run.ngc > out 2> err
    echo "status $?"
    grep -h '^Limits\|^line.*no progress' out err
done
