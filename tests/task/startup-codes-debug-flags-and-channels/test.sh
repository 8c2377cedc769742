#!/bin/bash
log=$(mktemp)
trap 'rm -f "$log"' EXIT
SHOW_LOG=1 ../lib/machine-test script.py "RS274NGC.RS274NGC_STARTUP_CODE=G20 G91 G61 G18 F12 S300 M8" 2> "$log"
grep -E "Issuing EMC_(TASK_PLAN_EXECUTE|TRAJ_LINEAR_MOVE|COOLANT)|^printed|^Motion id 12" "$log" | sed 's/([0-9]*)$/(N)/; s/took .*/took/' | sort | uniq -c
echo "-- codes that fail"
../lib/machine-test failing.py "RS274NGC.RS274NGC_STARTUP_CODE=G999" | grep -E "did not start|out of range|can't initialize"
../lib/machine-test tolerance.py
