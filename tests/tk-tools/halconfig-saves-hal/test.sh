#!/bin/bash
# halconfig: a command changes HAL, the whole or the nets are saved; at the end it asks what is to be kept.
export HOME=$PWD KERF_CLOCK=virtual PYTHONPATH="$TEST_DIR/../../lib:$PYTHONPATH"
realtime start 2> /dev/null
halcmd -f net.hal
timeout 60 ../../lib/with-display /usr/bin/python3 clicks.py
echo "== nets"; cat nets.hal
echo "== all"; grep "loadrt\|addf\|^net" all.hal; ls *.new 2> /dev/null
realtime stop 2> /dev/null
rm -f nets.hal all.hal
