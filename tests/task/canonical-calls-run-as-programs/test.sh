#!/bin/bash
# A machine with [TASK]INTERPRETER = canterp.so runs canonical calls: a program, MDI lines, from a line on, after an
# abort; mistakes stop it with their place. Nothing of it needs or writes a parameter file.
exec ../lib/machine-test script.py TASK.INTERPRETER=canterp.so "RS274NGC.RS274NGC_STARTUP_CODE=G17 G21" RS274NGC.PARAMETER_FILE=none.var
