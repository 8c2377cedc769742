#!/bin/bash
# The realtime host dies while it loads a module: halcmd says so, and of what.
export KERF_CLOCK=real
realtime start 2> /dev/null
host=$(for p in $(pgrep -x rtapi_app); do grep -qszx "RUNTESTS_MARK=$RUNTESTS_MARK" "/proc/$p/environ" && echo "$p"; done)
kill -STOP "$host"
halcmd loadrt and2 count=2 2> told & asking=$!
# It waits for the answer when it holds a connection and sleeps.
until ls -l /proc/$asking/fd 2> /dev/null | grep -q socket && grep -q '^State:.S' /proc/$asking/status; do sleep 0.02; done
sleep 0.2
kill -KILL "$host"
wait $asking; echo "status $?"
sed "s,$EMC2_HOME/,," told; rm told
realtime stop 2> /dev/null
