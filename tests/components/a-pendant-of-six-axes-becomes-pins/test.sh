#!/bin/bash
PENDANT=$(mktemp -d)
export PENDANT PYTHONPATH="$TEST_DIR/../../lib:$PYTHONPATH"
trap 'halrun -U >/dev/null 2>&1; rm -rf "$PENDANT"' EXIT
realtime start 2>/dev/null
timeout 60 /usr/bin/python3 check.py
