#!/bin/bash
# Controls of the charts of the latency tools; the picker by hand: OK only on a file, Return, double click, Escape.
export HOME=$PWD/home KERF_CLOCK=virtual PYTHONPATH="$TEST_DIR/../../lib:$PYTHONPATH"
mkdir home
LC_ALL=C.UTF-8 timeout 80 ../../lib/with-display /usr/bin/python3 clicks.py
rm -rf home
