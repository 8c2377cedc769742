#!/bin/bash
# At a terminal: -d shows what is run, -v is told, a failed start says where the logs are. Without any standard stream it starts, too.
export KERF_CLOCK=virtual
unset DISPLAY
out=$(mktemp -d); trap 'rm -rf "$out"' EXIT
export HOME=$out
top=$EMC2_HOME; cp "$top"/configs/sim/mill/* "$out"; ini=$out/mill.ini
sed -i 's,^PROGRAM_PREFIX.*,PROGRAM_PREFIX = .,' "$ini"
clean() { sed -E "s,$out,HOME,g; s,$top,TOP,g; s,LINUXCNC - .*,LINUXCNC - VERSION,; s,\.$KERF_INSTANCE,,; /^Note|^task:/d"; }
for options in -d "-v -r"; do
    echo "== $options"
    python3 ../lib/terminal.py "" linuxcnc $options -D "echo shown" "$ini" | clean
done
echo "== a failed start"
echo 'net x none' >> "$out/spindle.hal"
python3 ../lib/terminal.py "" linuxcnc "$ini" | clean | tail -n 7
cat "$out"/linuxcnc_debug.txt* "$out"/linuxcnc_print.txt*
echo "== no streams"
sed -i '$d' "$out/spindle.hal"
linuxcnc -D true "$ini" <&- >&- 2>&-
echo "status $?"
