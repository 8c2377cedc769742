#!/bin/bash
# FP-061, FP-188: the task is killed while a jog key is held: the machine stops, the session ends, no traceback.
. "$TEST_DIR/../lib/machine.sh"
screen_test mill killed.py
cat transcript
grep -h -o "milltask.*died[^:]*\|milltask.*ended[^:]*" screen.log screen.err | head -1 | sed 's/[0-9]\+/N/g'
grep -i -A8 traceback screen.err screen.log
rm -rf machine home transcript screen.log screen.err
