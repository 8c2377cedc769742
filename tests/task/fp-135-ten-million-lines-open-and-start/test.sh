#!/bin/bash
# FP-135: a program of 10,000,000 lines opens, starts and is read to its end in the memory of one of 1000 lines.
exec ../lib/machine-test script.py "$@"
