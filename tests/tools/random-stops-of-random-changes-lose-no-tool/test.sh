#!/bin/bash
# SEED=n STEPS=n for other and longer runs; the seed is printed when something is wrong.
for random in 0 1; do
    ../../task/lib/machine-test script.py EMCIO.RANDOM_TOOLCHANGER=$random -hal '!^net tool-'
done
