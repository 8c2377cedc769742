#!/bin/bash
# mdro: positions in inch and mm, zeroing, halving, typing, the keypad, systems from a file, the index, the INI file.
export PYTHONPATH="$TEST_DIR/../../lib:$PYTHONPATH"
printf '5221\t1.5\n5222\t-2\n5243\t10.0\n' > cs.var
printf '[DISPLAY]\nGEOMETRY = XZ\nMDRO_VAR_FILE = cs.var\nPOINT_SIZE = 14\nMM = 1\n' > mdro.ini
timeout 100 ../../lib/with-display /usr/bin/python3 clicks.py
DISPLAY= KERF_INSTANCE=nobody mdro -ini mdro.ini 2>&1 | sed -n 1p
rm -f cs.var mdro.ini
