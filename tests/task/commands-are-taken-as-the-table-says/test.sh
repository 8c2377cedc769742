#!/bin/bash
# Each command in each situation: off, manual, auto idle/reading/paused/waiting, MDI; y taken, n refused
# with the documented text and status ERROR. motion-logger stands in for the motion module.
export KERF_CLOCK=virtual
machine=$PWD/../motion-commands-are-the-recorded-ones
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
cp "$machine/logger.hal" "$machine/tool.tbl" ./*.ngc "$out"
printf '#!/bin/sh\nexec "%s/objects/test/task-command_table" > table\n' "$EMC2_HOME" > "$out/display"; chmod +x "$out/display"
sed 's|^DISPLAY = .*|DISPLAY = ./display|' "$machine/mill.ini" > "$out/mill.ini"
cd "$out" || exit 1
linuxcnc -r mill.ini > log 2>&1 < /dev/null || cat log
cat table
