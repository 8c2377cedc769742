#!/bin/bash
# A kinematics component of a user is compiled, loaded and switched; then what coordinates= may say.
modules=$(dirname "$(dirname "$(command -v rtapi_app)")")/rtlib
trap 'rm -f "$modules"/kerf_test_kins.so "$modules"/kerf_test_{userkins,tower}.so kerf_test_userkins.comp *.tmp.hal' EXIT
sed 's/^component userkins/component kerf_test_userkins/' ../../../src/emc/kinematics/userkins.comp > kerf_test_userkins.comp
halcompile --install kerf_test_kins.comp kerf_test_userkins.comp kerf_test_tower.c >&2 || exit 1
../lib/run.sh || exit 1
try() { # LOADRT-WORDS: what is printed, and the pose of joints 1 2 3 ... where it loads
    echo "-- $*"
    printf '%s\n' "loadrt $*" "loadrt kinscheck ranges=1:1,2:2,3:3,4:4,5:5 points=1 show=1" > c.tmp.hal
    halrun -f c.tmp.hal 2>&1 | sed '/^Note/d; /Process capabilities/d; /Falling\|Override/d; /^kinscheck/d; /insmod\|rtapi_app\|c.tmp.hal/d; /^$/d; s/^joints.*pose/pose/'
}
try trivkins
try trivkins coordinates=xz
try trivkins coordinates=XyZ
try trivkins coordinates=xyyz kinstype=BOTH
try trivkins coordinates=xyyz
try trivkins coordinates=zyx
try trivkins 'coordinates="x y z"'
try trivkins coordinates=xyq
try trivkins coordinates=xyzabcuvwxyzabcuv
try trivkins coordinates=abcuvwxyzabcuvwxyzabcuvwxyzabcuvwxyz
try 5axiskins coordinates=xyzbw
try 5axiskins coordinates=xyzbcwy
try xyzac-trt-kins coordinates=xyzab
try scarakins coordinates=xyzabcc
