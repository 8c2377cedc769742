#!/bin/bash
# FP-131: after a power cut the program is opened with the line marked; the start there shows each item beside what was in force, and nothing
# moves or starts before it is confirmed. The journal is as task wrote it (tests/task/fp-131-a-cut-off-program-is-known-afterwards).
. "$TEST_DIR/../lib/machine.sh"
printf 'G21 G90 F3000\nM3 S500\nG1 X10\nG1 Y20\nG1 X0\nM2\n' > part.ngc
cat > journal <<JOURNAL
program $PWD/part.ngc
hash $(sha256sum part.ngc | cut -d' ' -f1)
line 4
time 2026-11-01 12:00:00
position X10.000000 Y7.500000 Z0.000000
system 1 X25.000000 Y0.000000 Z0.000000
g92 X0.000000 Y0.000000 Z0.000000
rotation 0.000000
tool T2 X0.000000 Y0.000000 Z0.000000
settings F3000.000000 S500.000000
JOURNAL
ini_edit="s|^\[TASK\]|[TASK]\nJOURNAL = $PWD/journal|"
screen_test mill operator_script.py "$PWD/part.ngc"
sed "s|$PWD|HERE|g" machine/transcript
grep -i -A8 traceback screen.err
rm -rf machine home part.ngc journal screen.log screen.err
