#!/bin/bash
# FP-188: windows that are killed while a program runs stop neither the program nor the next window.
exec ../../lib/with-display ../../task/lib/machine-test script.py
