#!/bin/bash
# FP-061, FP-133, FP-188: task, the screen itself or halui is killed (kill -9) while a jog key is held: motion ends or stays
# in the operator's hand, the reason is told, no traceback. The machine outlives the screen.
. "$TEST_DIR/../lib/machine.sh"
for victim in task display halui; do
    echo "== $victim"
    rm -f transcript seen seen.new
    if [ $victim = task ]; then
        screen_test mill killed.py
    else
        VICTIM=$victim screen_test mill gone.py
        for _ in $(seq 500); do [ -e seen ] && break; sleep 0.02; done
    fi
    cat transcript seen 2> /dev/null
    grep -h -o "milltask.*died[^:]*\|milltask.*ended[^:]*" screen.log screen.err | head -1 | sed 's/[0-9]\+/N/g'
    grep -i -A8 traceback screen.err screen.log
done
echo "== task, of a machine started from a desktop: a window tells it, names what died, and closes with Escape"
cat > desktop.sh <<'SH'
HOME=$PWD/home linuxcnc -D "$PWD/killed.py" machine/mill.ini > screen.log 2> screen.err < /dev/null
window=$(timeout 20 xdotool search --sync --onlyvisible --name '^milltask ' | head -1)
xdotool getwindowname "$window" | sed 's/[0-9]\+/N/g'
for _ in $(seq 100); do
    xdotool getwindowname "$window" > /dev/null 2>&1 || { echo closed; break; }
    xdotool windowfocus "$window" key Escape 2> /dev/null
    sleep 0.1
done
SH
rm -rf machine home; cp -r "$top/configs/sim/mill" machine; mkdir home
"$top/tests/lib/with-display" bash desktop.sh
rm -rf desktop.sh machine home transcript seen at screen.log screen.err
