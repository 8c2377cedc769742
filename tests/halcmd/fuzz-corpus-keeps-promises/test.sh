#!/bin/bash
# Inputs that fuzzing found interesting, and past findings: the parser and the commands
# survive them and keep the promises of src/hal/utils/halcmd/fuzz.cc.
top=$(cd ../../.. && pwd)
KERF_INSTANCE=$KERF_INSTANCE-fuzz KERF_FUZZ_HAL=1 "$top/objects/test/halcmd-fuzz" "$top"/tests/fuzz/halcmd/corpus/* |
    sed 's/^[0-9]* files/all files/'
