#!/bin/bash
# FP-061, FP-133, FP-188: task, the screen itself or halui is killed (kill -9) while a jog key is held: motion ends or stays
# in the operator's hand, the reason is told, no traceback.
. "$TEST_DIR/../lib/machine.sh"
for victim in task display halui; do
    echo "== $victim"
    rm -f transcript seen seen.new
    if [ $victim = task ]; then
        screen_test mill killed.py
    else
        VICTIM=$victim screen_test mill gone.py | sed 's/status [1-9].*/status not 0/'
        for _ in $(seq 500); do [ -e seen ] && break; sleep 0.02; done
    fi
    cat transcript seen 2> /dev/null
    grep -h -o "milltask.*died[^:]*\|milltask.*ended[^:]*" screen.log screen.err | head -1 | sed 's/[0-9]\+/N/g'
    grep -i -A8 traceback screen.err screen.log
done
rm -rf machine home transcript seen screen.log screen.err
