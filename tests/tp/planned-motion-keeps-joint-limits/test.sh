#!/bin/bash
export KERF_CLOCK=virtual PYTHONPATH="$PWD/../../motion/lib:$PYTHONPATH" PYTHONDONTWRITEBYTECODE=1
exec /usr/bin/python3 test.py
