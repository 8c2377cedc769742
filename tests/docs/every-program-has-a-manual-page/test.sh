#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# What `make install` puts into bin, and what loadrt loads, has a manual page that says what is true.
here=$PWD
cd ../../.. || exit 1
rule='print-names: ; @echo $(notdir $(PROGRAMS) $(SCRIPTS)) $(USER_SCRIPTS) -- $(notdir $(RTMODULES:.so=))'
names=$(make -s --no-print-directory --eval "$rule" print-names)
/usr/bin/python3 -B "$here/check.py" $names
if command -v groff > /dev/null; then
    cd docs/build/man && groff -man -Tutf8 -ww -z man1/*.1 man3/*.3 2>&1
else
    echo "groff is not installed: pages were not rendered" >&2
fi
echo done
