#!/bin/bash
# TURNS and SEED for more. The changer takes 0.3 s, so that stops come in the middle of changes.
for random in 0 1; do
    ../lib/machine-test script.py HAL.HALUI=halui EMCIO.RANDOM_TOOLCHANGER=$random -hal '!^net tool-change' -hal 'loadrt timedelay' \
        -hal 'addf timedelay.0 servo-thread' -hal 'setp timedelay.0.on-delay 0.3' -hal 'net change iocontrol.0.tool-change => timedelay.0.in' \
        -hal 'net changed timedelay.0.out => iocontrol.0.tool-changed'
done
