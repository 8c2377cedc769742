#!/bin/bash
# Each mistake ends with a message that names the place, a status that is not 0, and nothing left running.
export KERF_CLOCK=virtual
top=$(cd ../../.. && pwd)
try() { # name, sed expression on mill.ini
    rm -rf machine; cp -r "$top/configs/sim/mill" machine
    sed -i "$2" machine/mill.ini
    echo "# $1"
    linuxcnc -r -D true machine/mill.ini > out.txt 2>&1 < /dev/null
    echo "status $?"
    grep -h -i -E "$3" out.txt | sed "s|$PWD/||g; s|$top/||g" | head -n 2
}
try "missing realtime module" 's/^EMCMOT = motmod/EMCMOT = nomod/' 'nomod' 
try "missing HAL file" 's/^HALFILE = spindle.hal/HALFILE = nowhere.hal/' 'nowhere'

try "bad INI line" 's/^JOINTS = 3/JOINTS 3/' 'error:'
try "bad number of joints" 's/^JOINTS = 3/JOINTS = 30/' 'error:'
try "missing task" 's/^TASK = milltask/TASK = notask/' 'notask'
try "interpreter that can not begin" 's/^PARAMETER_FILE.*/&\nREMAP = M400 modalgroup=10 python=nofunction/' 'TASK program|nofunction'
linuxcnc -r nowhere.ini < /dev/null 2>&1; echo "status $?"
rm -rf machine out.txt
