#!/bin/bash
# FP-054: two joints of one axis without a common negative HOME_SEQUENCE, and the group "minus zero".
ini=$(mktemp --suffix=.ini); trap 'rm -f "$ini"' EXIT
try() { # SED-EXPRESSION: what the check says of the sample gantry, changed so
    echo "-- $1"
    sed "$1" ../../../configs/sim/gantry/gantry.ini > "$ini"
    linuxcnc_check_ini "$ini" 2>&1 | grep -i 'sequence\|drive' | sed -E 's,^[^ ]*ini(:[0-9]+)?: ,,'
    echo "status ${PIPESTATUS[0]}"
}
try ''
try 's/HOME_SEQUENCE = -2/HOME_SEQUENCE = 2/'
try '/JOINT_2/,/HOME_SEQ/s/HOME_SEQUENCE = -2/HOME_SEQUENCE = 2/'
try '/JOINT_2/,/HOME_SEQ/s/HOME_SEQUENCE = -2/HOME_SEQUENCE = -3/'
try '/JOINT_2/,/HOME_SEQ/{/HOME_SEQUENCE/d}'
try 's/HOME_SEQUENCE = -2/HOME_SEQUENCE = -0/'
