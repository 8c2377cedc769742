#!/bin/bash
../lib/machine-test script.py DISPLAY.ARCDIVISION=256 "$@"
../lib/machine-test wrapped.py -machine xyza AXIS_A.WRAPPED_ROTARY=1
