#!/bin/bash
# 26 panels as people write them: each loads, with the pins (name, type, direction, value at start) that the reference gives.
printf 'loadusr -w /usr/bin/python3 -B load.py\n' > load.hal
../../lib/with-display halrun -f load.hal
rm -f load.hal
