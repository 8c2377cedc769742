#!/bin/bash
# The screen of a machine that begins with `#!/usr/bin/env python3` runs where the first python3 on PATH is another
# one, which lacks what our modules need; in a virtual environment the user's choice stays.
export KERF_CLOCK=virtual
unset DISPLAY VIRTUAL_ENV
rm -rf work; mkdir -p work/other; trap 'cd ..; rm -rf work' EXIT
cd work
printf '#!/bin/sh\necho "the other python: $1"\n' > other/python3; chmod +x other/python3
/usr/bin/python3 - <<'END'
import sys
sys.path.insert(0, "../../../configs/lib")
from machine import machine
machine("m", "HALFILE = LIB:basic_sim.tcl", files={"screen": "#!/usr/bin/env python3\nimport linuxcnc, numpy\ns = linuxcnc.stat()\ns.poll()\nprint('joints', s.joints)\n"})
END
PATH=$(pwd)/other:$PATH
linuxcnc -r -D ./screen m/m.ini 2> err | grep 'joints\|other'
VIRTUAL_ENV=$(pwd) linuxcnc -r -D ./screen m/m.ini 2>> err | grep 'joints\|other'
