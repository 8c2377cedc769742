#!/bin/bash
# Four threads change and look at the same signals and pins while two read and write through
# them as a cycle does: ThreadSanitizer reports no race, and no value is torn.
top=$(cd ../../.. && pwd)
KERF_INSTANCE=$KERF_INSTANCE-tsan "$top/objects/test/hal-tsan" "${CHANGES:-10000}" 2>&1
