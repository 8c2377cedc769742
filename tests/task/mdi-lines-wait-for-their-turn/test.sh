#!/bin/bash
exec ../lib/machine-test script.py RS274NGC.SUBROUTINE_PATH=. -file waits.ngc
