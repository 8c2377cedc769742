#!/bin/bash
# Windows that hold something in HAL when the session ends (halrun -U), or the terminal that they were started from:
# they end, keep their settings, leave nothing in HAL.
export HOME=$PWD/home CONFIG_DIR= KERF_CLOCK=virtual
mkdir -p home
windows()
{
    halshow first.halshow & shown=$!
    halscope -o last.halscope 2000 & scope=$!
    xdotool search --sync --onlyvisible --name "^first.halshow - Halshow" > /dev/null
    xdotool search --sync --onlyvisible --name "Realtime function" > /dev/null
    halrun -U
    wait $shown; echo "halshow $?"
    wait $scope; echo "halscope $?"
}
realtime start 2> /dev/null
halcmd loadrt siggen 2>&1
echo pin+siggen.0.sine pin+siggen.0.cosine > first.halshow
export -f windows
timeout 60 ../../lib/with-display bash -c windows
grep watchlist home/.halshow_preferences
grep -c . last.halscope
realtime start 2> started; grep -i "removed\|left by" started
halcmd list comp | sed 's/halcmd[0-9]*//'
echo pin+a.b sig+c > second.halshow
terminal()
{
    halshow second.halshow & shown=$!
    xdotool search --sync --onlyvisible --name "^second.halshow - Halshow" > /dev/null
    kill -HUP $shown
    wait $shown; echo "halshow $?"
}
export -f terminal
timeout 60 ../../lib/with-display bash -c terminal
grep watchlist home/.halshow_preferences
realtime stop 2> /dev/null
rm -rf home first.halshow second.halshow last.halscope started .halshow_watchlist_backup
