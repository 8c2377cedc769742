#!/bin/bash
# FP-130: what runs is the text that was opened, with its hash, whatever is done to the file meanwhile; a change is told and
# needs the program to be opened again. The hash decides: not a new time, nor an old one. The same for files that it calls.
exec ../lib/machine-test script.py "$@"
