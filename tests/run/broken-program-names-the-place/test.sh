#!/bin/bash
# A mistake in a program: file, line, column, the text and the reason; status 1; nothing moves.
unset KERF_CLOCK
printf 'G21 G90\nG1 X10 F100\nG1 X[1 + ] Y2\nM2\n' > bad.ngc
kerf-run --picture /dev/null bad.ngc 2>&1 | sed "s|$PWD/||"; status=${PIPESTATUS[0]}
echo "status $status"
printf 'G21 G90\nG1 X10 F100\nG2 X20 Y0 I0 J0\nM2\n' > bad.ngc
kerf-run --picture /dev/null bad.ngc 2>&1 | sed "s|$PWD/||"; status=${PIPESTATUS[0]}
echo "status $status"
kerf-run nowhere.ngc 2>&1
echo "status $?"
rm -f bad.ngc
