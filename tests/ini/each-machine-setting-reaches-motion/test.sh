#!/bin/bash
# Every setting of [TRAJ], [AXIS_L], [JOINT_N] and [SPINDLE_N] reaches motion, and every pin ini.* changes its own.
export KERF_CLOCK=virtual
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
cp logged.ini logger.hal screw.txt change "$out"
cd "$out" || exit 1
touch tool.tbl
linuxcnc -r logged.ini > log 2>&1 < /dev/null || cat log
sed -n '/^SET_NUM_JOINTS/,$p; /^\[TASK\]IO_ERROR/p; /OFFSET_AV_RATIO=/p' log | grep -v "^Shutting\|^JOG_ABORT\|^task:\|^USRMOT"
wc -l < position.txt
