#!/bin/bash
# xhc-whb04b-6 with a pendant in place of libusb, connected to a machine by halui: on, home, jogs, overrides, a program,
# the spindle; a pendant that goes and comes back. The pendant lives in real time, so does the machine.
here=$PWD; rm -rf work; cp -r pendant work
PENDANT=$(mktemp -d)
trap 'rm -rf "$here/work" "$PENDANT"' EXIT
cd work || exit
PROGRAM=$(command -v xhc-whb04b-6)
export PENDANT PROGRAM PYTHONPATH=$here/../../task/lib:$here/../../lib:$PYTHONPATH
/usr/bin/python3 -c 'from usb_pendant import Pendant; Pendant("xhc-whb04b-6", "whb", 0xEB93, 8, 24).appear()' || exit
linuxcnc -r -D ./operate machine.ini < /dev/null > log 2>&1 || { echo "status $?"; tail -n 30 log; }
cat out
grep 'xhc-whb04b-6\|^hal ' log
