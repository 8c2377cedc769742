#!/bin/bash
# A PyVCP panel at the right, tabs: one of PyVCP, one of another program by its X window;
# a panel of GladeVCP's arguments right of all; a panel that is broken is told.
. "$TEST_DIR/../lib/machine.sh"
cat > panel.xml <<'X'
<pyvcp><vbox><label><text>"Coolant"</text></label><button><halpin>"pump"</halpin><text>"Pump"</text></button><led><halpin>"level"</halpin></led></vbox></pyvcp>
X
cat > tab.xml <<'X'
<pyvcp><led><halpin>"lamp"</halpin></led></pyvcp>
X
printf '<pyvcp><label><text>1/0</text></label></pyvcp>\n' > broken.xml
printf 'net level <= pyvcp.pump => pyvcp.level side.level\n' > post.hal
printf '#!/bin/sh\necho "$1" > "%s/xid"\nexec sleep 1000\n' "$PWD" > guest.sh
cat > gladevcp <<PY
#!/usr/bin/python3
import signal, sys, hal
print(*sys.argv[1:], file=open("$PWD/words", "w"))
component = hal.component(sys.argv[2])
component.newpin("level", hal.HAL_BIT, hal.HAL_IN)
component.ready()
signal.signal(signal.SIGTERM, lambda *_: sys.exit())
signal.pause()
PY
chmod +x guest.sh gladevcp; export PATH="$PWD:$PATH"
common="EMBED_TAB_NAME = My Lamp\nEMBED_TAB_COMMAND = pyvcp $PWD/tab.xml\nEMBED_TAB_NAME = Guest\nEMBED_TAB_COMMAND = $PWD/guest.sh {XID}"
ini_edit="s|^DISPLAY = .*|&\nPYVCP = $PWD/panel.xml\nGLADEVCP = -u \"my handlers.py\" -c side panel.ui\n$common|; s|^HALFILE = spindle.hal|&\nPOSTGUI_HALFILE = $PWD/post.hal|"
screen_test mill panels.py
cat machine/transcript
grep -i -A8 traceback screen.err
echo "== broken, at the bottom, and an uneven list of tabs"
ini_edit="s|^DISPLAY = .*|&\nPYVCP = $PWD/broken.xml\nPYVCP_POSITION = BOTTOM\nEMBED_TAB_NAME = Alone|"
screen_test mill panels.py
cat machine/transcript
grep -h -o "Invalid tab configuration" screen.log screen.err
rm -rf machine home screen.log screen.err ./*.xml post.hal guest.sh gladevcp words xid
