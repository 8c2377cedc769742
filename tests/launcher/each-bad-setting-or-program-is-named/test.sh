#!/bin/bash
# Each mistake in the INI file, and each program that can not be started, is told with its place; all that was started ends.
export KERF_CLOCK=virtual
rm -rf work; mkdir work; trap 'cd ..; rm -rf work' EXIT
cd work && /usr/bin/python3 ../../lib/failures.py settings,programs
