#!/bin/bash
# Inputs that fuzzing found interesting, and past findings: lines of halstreamer and of halrmt's
# clients, INI files, requests to the realtime host and parameters of modules crash nothing.
top=$(cd ../../.. && pwd)
export KERF_INSTANCE=$KERF_INSTANCE-fuzz
for target in parsers host; do
    "$top/objects/test/$target-fuzz" "$top/tests/fuzz/$target"/corpus/* 2> errors.txt | grep 'no promise broken' |
        sed "s/^[0-9]* files/$target/"
    grep -c "Sanitizer" errors.txt
done
rm -f errors.txt
