#!/bin/bash
exec ../lib/machine-test script.py "RS274NGC.USER_M_PATH=$PWD/codes" "RS274NGC.ON_ABORT_COMMAND=O <on_abort> call" RS274NGC.SUBROUTINE_PATH=. -file on_abort.ngc
