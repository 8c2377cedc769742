#!/bin/bash
../lib/machine-test script.py "-hal" "!emc-enable-in" -hal "setp iocontrol.0.emc-enable-in 1"
for n in 2 0; do echo "MDI_QUEUE = $n"; ../lib/machine-test limited.py TASK.MDI_QUEUE=$n; done
