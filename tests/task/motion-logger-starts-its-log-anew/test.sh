#!/bin/bash
# motion-logger.reopen-log empties the log at once and becomes FALSE.
export KERF_CLOCK=virtual
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
cat > "$out/script.py" <<'END'
import sys
from pathlib import Path
import hal
import linuxcnc
from kerf import clock
clock.join("test", 900)
log = Path("log")
panel = hal.component("panel")
lines = lambda: len(log.read_text().splitlines())
print("logged:", lines() > 0)
hal.set_p("motion-logger.reopen-log", "1")
print("done:", clock.wait_until(lambda: not hal.get_value("motion-logger.reopen-log"), 1), "lines:", lines())
linuxcnc.command().feedrate(0.5)
print(log.read_text().strip())
END
machine=$PWD/../motion-commands-are-the-recorded-ones
cp "$machine/tool.tbl" "$out"
sed "s/motion-logger.*/motion-logger log/" "$machine/logger.hal" > "$out/logger.hal"
printf '#!/bin/sh\nexec /usr/bin/python3 script.py > told 2>&1\n' > "$out/display"
chmod +x "$out/display"
sed 's|^DISPLAY = .*|DISPLAY = ./display|' "$machine/mill.ini" > "$out/mill.ini"
cd "$out" || exit 1
linuxcnc -r mill.ini > output 2>&1 < /dev/null || cat output
cat told
