#!/bin/bash
# Runs the test.py of the present folder in virtual time: exec ../lib/run.sh
export KERF_CLOCK=virtual PYTHONPATH="$PWD/../lib:$PYTHONPATH" PYTHONDONTWRITEBYTECODE=1
exec /usr/bin/python3 test.py
