#!/bin/bash
# FP-132: task is killed, or the disk is full, at each call with which it writes the position of the machine and the journal of a run: the
# file that is there afterwards is the old one or a new one that is whole, and the next start knows it.
scratch=$(mktemp -d); trap 'rm -rf "$scratch"' EXIT
gcc -shared -fPIC -O1 -o "$scratch/failing_writes.so" "$EMC2_HOME/tests/lib/failing_writes.c" || exit 1
export KERF_CLOCK=virtual HOME=$scratch PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$PWD/../lib:$PWD/../../lib:$PYTHONPATH
/usr/bin/python3 cuts.py "$scratch"
