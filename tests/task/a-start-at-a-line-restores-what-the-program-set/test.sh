#!/bin/bash
../lib/machine-test script.py "$@"
../lib/machine-test remapped.py TASK.RUN_FROM_LINE=restore "RS274NGC.REMAP=M6 modalgroup=6 ngc=change" RS274NGC.SUBROUTINE_PATH=. -file change.ngc
../lib/machine-test in_python.py PYTHON.TOPLEVEL=toplevel.py PYTHON.PATH_PREPEND=. "RS274NGC.REMAP=M6 modalgroup=6 python=change" -file toplevel.py -file remap.py
