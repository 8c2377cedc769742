#!/bin/bash
# Without a controller: what each call raises, and the values before the first poll.
/usr/bin/python3 calls.py
mkdir folder && cd folder || exit 1
/usr/bin/python3 ../no_tools.py
rm -f .tool* && cd .. && rmdir folder
