#!/bin/bash
# What is around a machine - display, ports, file system, home, paths, language - and files that HAL files name: each hindrance
# is told, whatever does not matter does not, and all that was started ends.
export KERF_CLOCK=virtual
rm -rf work; mkdir work; trap 'cd ..; rm -rf work' EXIT
cd work && /usr/bin/python3 ../../lib/failures.py around
