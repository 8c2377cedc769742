#!/bin/bash
# Every setting that the table of settings says our programs read is named by a source file that reads
# settings, with its section where it stands in a list of its own. What belongs to screens that are not
# here yet is listed.
cd ../../.. && PYTHONPATH=lib/python exec /usr/bin/python3 "$OLDPWD/readers.py"
