#!/bin/bash
exec ../lib/machine-test script.py "$@" "RS274NGC.ON_ABORT_COMMAND=O <on_abort> call" -file on_abort.ngc
