#!/bin/bash
../lib/machine-test script.py "$@"
echo "with an abort handler:"
STOPS=60 PAUSES=0 ../lib/machine-test script.py "RS274NGC.ON_ABORT_COMMAND=O <on_abort> call" RS274NGC.SUBROUTINE_PATH=. -file on_abort.ngc
