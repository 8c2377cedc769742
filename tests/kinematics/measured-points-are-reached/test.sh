#!/bin/bash
unset KERF_CLOCK
exec /usr/bin/python3 -B test.py
