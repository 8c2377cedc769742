#!/bin/bash
# halshow by hand: tree, filter, watch list, setting with type checks, unlinking, files, settings, commands.
export HOME=$PWD/home CONFIG_DIR= KERF_CLOCK=virtual
export PYTHONPATH="$TEST_DIR/../../lib:$PYTHONPATH"
mkdir -p home
realtime start 2> /dev/null
halcmd -f net.hal
LC_ALL=C.UTF-8 timeout 60 "$TEST_DIR/../../lib/with-display" /usr/bin/python3 clicks.py
realtime stop 2> /dev/null
echo "== preferences"; sed -E 's/[0-9]+x[0-9]+\+[0-9]+\+[0-9]+/GEOMETRY/; s/(ratio|placeFrames) 0\.[0-9]+/\1 R/; s/(old_w_leftf) [0-9]+/\1 N/' home/.halshow_preferences
echo "== files"; sed 's/created .*/created DATE/' one.halshow many.halshow .halshow_watchlist_backup
halshow --help | sed -n 1p; halshow --fformat; echo $?; halshow --fformat %z; echo $?; DISPLAY= halshow; echo $?
rm -rf home {one,many,other}.halshow{,.bak} .halshow_watchlist_backup{,.bak}
