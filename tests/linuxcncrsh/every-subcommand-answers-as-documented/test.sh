#!/bin/bash
exec ../../task/lib/machine-test script.py DISPLAY.LINEAR_UNITS=CM DISPLAY.ANGULAR_UNITS=grad
