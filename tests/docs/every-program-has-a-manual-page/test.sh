#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# What `make install` puts into bin has a manual page that says what is true.
here=$PWD
cd ../../.. || exit 1
rule='print-programs: ; @echo $(notdir $(PROGRAMS) $(SCRIPTS)) $(USER_SCRIPTS)'
programs=$(make -s --no-print-directory --eval "$rule" print-programs)
/usr/bin/python3 -B "$here/check.py" $programs
if command -v groff > /dev/null; then
    cd docs/build/man && groff -man -Tutf8 -ww -z man1/*.1 man3/*.3 2>&1
else
    echo "groff is not installed: pages were not rendered" >&2
fi
echo done
