#!/bin/bash
unset KERF_CLOCK
PYTHONDONTWRITEBYTECODE=1 exec /usr/bin/python3 test.py
