#!/bin/bash
# FP-137: the tools that watch HAL for days keep their size. LOOKS: how often each looks (864000: a day of 100 ms).
export HOME=$PWD/home KERF_CLOCK=virtual PYTHONPATH="../../lib:$PYTHONPATH"
mkdir -p home
realtime start 2> /dev/null
halcmd -f net.hal
LC_ALL=C.UTF-8 ../../lib/with-display /usr/bin/python3 looks.py "$@"
realtime stop 2> /dev/null
rm -rf home tool.tbl prefs scope.halscope
