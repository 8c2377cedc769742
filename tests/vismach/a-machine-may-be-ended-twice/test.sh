#!/bin/bash
# A machine view owns two components, each of which is told to end, at any moment of a redraw: no word on standard error.
realtime start 2> /dev/null
../../lib/with-display bash -c 'for try in 1 2 3 4 5 6; do
        hexagui > out 2> err & view=$!
        for i in $(seq 200); do halcmd list comp | grep -q vismach && break; sleep 0.05; done
        sleep 0.1$try; while kill $view 2> /dev/null; do :; done; wait $view; cat out err
    done'
echo "six times"
realtime stop 2> /dev/null
rm -f out err
