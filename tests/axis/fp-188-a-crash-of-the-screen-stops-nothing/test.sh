#!/bin/bash
# FP-188: the screen's process is killed, and then crashes, while a program runs: the program goes on as if nothing had been; a new screen
# shows the machine as it is, sets nothing, has its pins in the same nets, is told of what happened. Nothing that POSTGUI loaded is loaded twice.
# What was held on the panel falls, its numbers stay.
. "$TEST_DIR/../lib/machine.sh"
export KERF_CLOCK=virtual:20     # while nobody takes part in it the clock runs on: the last line takes hours of it
printf 'G21 G90 G64\nM52 P1\nM3 S1000 M8\nG1 X1 F600\nG1 X300 F2.4\nM9 M5\nM2\n' > part.ngc
ini_edit='s|^\[HAL\]|[HAL]\nPOSTGUI_HALFILE = ../post.hal|; s|^\[DISPLAY\]|[DISPLAY]\nPYVCP = ../panel.xml\nEMBED_TAB_NAME = Tab\nEMBED_TAB_COMMAND = ../tab.sh {XID}|'
rm -f tabs others
screen_test mill living.py "$PWD/part.ngc"
cat machine/transcript
grep -h "DISPLAY program\|started again" screen.err | sed 's|program [^ ]*/|program |; s|^/.*/||'
grep -h "the screen before" screen.err screen.log
grep -i -A12 traceback screen.err screen.log
ls home/.axis_reports | wc -l
for pid in $(cat tabs); do grep -qs "^State:.[^ZX]" /proc/$pid/status && echo "tab is left"; done
rm -rf machine home part.ngc tabs others screen.log screen.err
