#!/bin/bash
# Each command in each state of the machine, not homed and homed: y taken, n refused
# with the documented text and status ERROR. motion-logger stands in for the motion module.
export KERF_CLOCK=virtual
machine=$PWD/../motion-commands-are-the-recorded-ones
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
cp "$machine/tool.tbl" ./*.ngc "$out"
sed "s/^setp iocontrol.0.emc-enable-in 1/net chain iocontrol.0.user-enable-out iocontrol.0.emc-enable-in/" "$machine/logger.hal" > "$out/logger.hal"
printf '#!/bin/sh\nexec "%s/objects/test/task-command_table" > table\n' "$EMC2_HOME" > "$out/display"; chmod +x "$out/display"
sed 's|^DISPLAY = .*|DISPLAY = ./display|' "$machine/mill.ini" > "$out/mill.ini"
cd "$out" || exit 1
linuxcnc -r mill.ini > log 2>&1 < /dev/null || cat log
cat table
