#!/bin/bash
# FP-082, FP-186 (edits are asked for at the end): what tooledit does not show stays in the file; the file is replaced whole; wrong cells are not saved.
export HOME=$PWD
export PYTHONPATH="$TEST_DIR/../../lib:$PYTHONPATH"
printf '%s\n' '; my tools' 'T1 P1 Z0.511 D0.125 ;1/8 end mill' '' 'T2 P2 X0.50 Z+0.1 D.0625 K3 ;1/16 end mill' 'T3 P3 Zabc D0.2 ;bad' 'T6 P6 Z1_0 ;odd' \
    'T4 P4 Z1.273 I95.000 J155 Q2 D1.123456789012 ;Fräser' > tool.tbl
LANGUAGE=en timeout 60 "$TEST_DIR/../../lib/with-comma-locale" "$TEST_DIR/../../lib/with-display" /usr/bin/python3 clicks.py
echo "== file"; cat tool.tbl; echo "== backup"; cat tool.tbl.bak
echo "== rc"; sed 's/[0-9]\+/N/g' .tooleditrc
echo "== no arguments"; tooledit; echo $?
echo "== words"; DISPLAY= tooledit x z x foo tool.tbl; echo $?
rm -rf {tool.tbl,.tooleditrc}{,.bak}
