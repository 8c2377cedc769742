#!/bin/bash
exec ../lib/machine-test script.py TASK.CYCLE_TIME=0.010
