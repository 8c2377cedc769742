#!/bin/bash
# #<_hal[pin]> in a program: the preview of a process that is in HAL reads it, kerf-run lets the machine read it.
printf '[EMC]\nVERSION=1.1\n' > pin.ini
printf 'G21 G90\nG0 X0\nG1 X#<_hal[sum2.0.gain0]> F100\nM2\n' > pin.ngc
halrun -f pins.hal 2>/dev/null
printf 'G21 G90\nG0 X[#<_hal[motion.digital-out-00]> + 5]\nM2\n' > pin.ngc
kerf-run --picture pin.png pin.ngc 2>&1 | grep -io "not defined\|cycle time"
rm -f pin.ngc pin.ini pin.png
