#!/bin/bash
# Each mistake in HAL files, tables and files of the interpreter is told with file and line; all that was started ends.
export KERF_CLOCK=virtual
rm -rf work; mkdir work; trap 'cd ..; rm -rf work' EXIT
cd work && /usr/bin/python3 ../../lib/failures.py hal,files
