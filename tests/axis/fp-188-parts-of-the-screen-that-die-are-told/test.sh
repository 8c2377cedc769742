#!/bin/bash
# FP-188, FP-140: programs that show something beside or inside the screen are killed: the operator is told, bits fall, the screen goes on. Whoever
# closes it is told what turns and runs.
. "$TEST_DIR/../lib/machine.sh"
printf 'G21 G90\nG1 X20 F60\nM2\n' > part.ngc
ini_edit='s|^\[HAL\]|[HAL]\nPOSTGUI_HALFILE = ../post.hal|; s|^\[DISPLAY\]|[DISPLAY]\nEMBED_TAB_NAME = Tab\nEMBED_TAB_COMMAND = ../tab.sh {XID}|'
screen_test mill parts.py "$PWD/part.ngc"
cat machine/transcript
grep -i -A12 traceback screen.err screen.log
rm -rf machine home part.ngc tab screen.log screen.err
