#!/bin/bash
# Runs the test.py of the present folder in virtual time, with the bench of tests/motion/lib.
export KERF_CLOCK=virtual PYTHONPATH="$PWD/../../motion/lib:$PYTHONPATH" PYTHONDONTWRITEBYTECODE=1
exec /usr/bin/python3 test.py
