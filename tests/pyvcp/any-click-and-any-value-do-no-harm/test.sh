#!/bin/bash
printf 'loadusr -w /usr/bin/python3 -B press.py\n' > load.hal
../../lib/with-display halrun -f load.hal
rm -f load.hal
