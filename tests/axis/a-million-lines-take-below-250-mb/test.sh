#!/bin/bash
# FP-136: the whole process of the screen with a million segments, with OpenGL, while it loads and after.
. "$TEST_DIR/../lib/machine.sh"
screen_test mill load.py
cat machine/transcript
rm -rf machine home screen.log screen.err
