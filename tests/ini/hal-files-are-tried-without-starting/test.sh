#!/bin/bash
# linuxcnc_check_ini -n loads the HAL files of a machine and names every line that fails; no thread is
# started, nothing stays, and the folder is as it was.
rm -rf work; trap 'rm -rf work' EXIT
top=$(cd ../../.. && pwd)
cp -r "$top/configs/sim/stepper" work; mkdir work/sub
ls work > before.txt
try() { # file, sed expression
    echo "# $1 $2"
    cp work/$1 saved.txt; sed -i "$2" work/$1
    linuxcnc_check_ini -n work/stepper.ini 2>&1 | grep -v PROGRAM_PREFIX | sed "s,$PWD/,,g; s,$top/,,g"
    echo "=> ${PIPESTATUS[0]}"
    mv saved.txt work/$1
}
try stepper.ini ''
try stepper.hal 's/^net x-step .*/net x-step stepgen.0.stepp/; s/STEPLEN$/STEPLEM/'
try sim.hal 's/^loadrt.*/loadrt no_such_component/; /^[anst]/d'
try stepper.ini 's/^HALFILE = sim.hal/&\nHALFILE = own.tcl\nHALCMD = setp nothing 1/'
printf 'hal setp nothing.else 2\n' > work/own.tcl
try stepper.ini 's/^HALFILE = sim.hal/&\nHALFILE = own.tcl/'
rm work/own.tcl
try stepper.ini 's/^\[HAL\]/&\nTWOPASS = on/'
try stepper.ini 's/^JOINTS.*/JOINTS = 30/'
# The functions of the threads do not run: a component that counts cycles stays at zero.
printf 'loadrt time names=clock\naddf clock servo-thread\nsetp clock.start 1\nloadusr -w ./look\n' > work/own.hal
printf '#!/bin/sh\nhalcmd show thread | grep -c clock; halcmd getp clock.seconds; halcmd list thread\n' > work/look; chmod +x work/look
sed -i 's/^HALFILE = sim.hal/&\nHALFILE = own.hal/' work/stepper.ini
linuxcnc -r -n work/stepper.ini < /dev/null 2>&1 | sed -n '/^[0-9]/p; /thread/p'
rm work/own.hal work/look
ls work | diff before.txt - && echo "the folder is as it was"
rm -f before.txt
