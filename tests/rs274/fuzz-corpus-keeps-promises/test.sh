#!/bin/bash
# Programs that fuzzing found interesting, and past findings: the interpreter survives them
# and keeps the promises of src/emc/rs274ngc/rs274_fuzz.cc.
top=$(cd ../../.. && pwd)
"$top/objects/test/rs274-fuzz" "$top"/tests/fuzz/rs274/corpus/* 2>/dev/null | sed 's/^[0-9]* files/programs/'
KERF_FUZZ_LINES=1 "$top/objects/test/rs274-fuzz" "$top"/tests/fuzz/rs274/lines/* 2>/dev/null | sed 's/^[0-9]* files/lines/'
