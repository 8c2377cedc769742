#!/bin/bash
# See test.py.
export KERF_CLOCK=real
realtime="$EMC2_HOME/scripts/realtime"; trap '$realtime stop 2>/dev/null' EXIT
$realtime start 2>/dev/null
/usr/bin/python3 test.py 2>stderr-of-hal
status=$?
# What the dead left is named each time.
grep -c 'the realtime host (process [0-9]*) ended without unloading; removed 1 threads and 3 components' stderr-of-hal
[ $status = 0 ] || grep -v 'ended without unloading' stderr-of-hal >&2
rm -f stderr-of-hal
exit $status
