#!/bin/bash
# The commands that task gives to motion for each program are those that were recorded.
# Names in n and r are random programs, x- one kind of command each (threads, G5.2, compensation in each plane, offsets...).
# (No program has a mistake or M61 right after feed moves: LinuxCNC drops those, here they are made.)
export KERF_CLOCK=virtual
here=$PWD
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
cp mill.ini logger.hal tool.tbl record "$out"
cd "$out" || exit 1
PROGRAMS=$here/recorded linuxcnc -r mill.ini > log 2>&1 < /dev/null || cat log
"$here/compare" "$here/recorded" .
