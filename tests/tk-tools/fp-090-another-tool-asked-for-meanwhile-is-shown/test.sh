#!/bin/bash
# FP-090: a request that was withdrawn and made again for another tool between two looks is never shown, nor
# confirmed, as the old one; many requests one after the other each wait for their own answer.
export HOME=$PWD KERF_CLOCK=virtual PYTHONPATH="../../lib:$PYTHONPATH"
realtime start 2> /dev/null
LC_ALL=C.UTF-8 timeout 60 ../../lib/with-display /usr/bin/python3 requests.py
realtime stop 2> /dev/null
