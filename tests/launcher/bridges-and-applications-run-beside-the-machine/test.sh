#!/bin/bash
# [HAL]HALBRIDGE, [APPLICATIONS]APP and DELAY start programs; [DISPLAY]MIN_ and MAX_SPINDLE_OVERRIDE limit halui's override.
exec ../../task/lib/machine-test script.py "HAL.HALBRIDGE=./bridge.py one two" DISPLAY.MIN_SPINDLE_OVERRIDE=0.4 DISPLAY.MAX_SPINDLE_OVERRIDE=1.3 \
    "APPLICATIONS.APP=app three" APPLICATIONS.DELAY=0.2 -file bridge.py -file app -machine servo
