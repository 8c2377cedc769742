#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# A PyVCP panel at the right or at the bottom, one in a tab and another program in a tab, all larger than a low screen
# has room for: scroll bars, the wheel and the keyboard's focus reach everything, and the rest of the screen keeps its room.
# LOOKS="SCREEN LOOK...[,SCREEN LOOK...]": other ones; one language for each screen.
. "$TEST_DIR/../lib/machine.sh"
buttons=$(for n in {0..29}; do echo "<button><halpin>'b$n'</halpin><text>'Button $n'</text></button>"; done)
wide=$(for n in {0..19}; do echo "<button><halpin>'c$n'</halpin><text>'Button $n'</text></button>"; done)
echo "<pyvcp><vbox>$buttons<spinbox><halpin>'number'</halpin></spinbox></vbox></pyvcp>" > panel.xml
echo "<pyvcp><vbox>$buttons<hbox>$wide</hbox></vbox></pyvcp>" > tab.xml
cat > guest.py <<'PY'
import sys
import tkinter as tk
root = tk.Tk(use=sys.argv[1])
tk.Label(root, text="guest").pack(side="left")
tk.Frame(root, width=900, height=800).pack()
root.mainloop()
PY
export LANG=C.UTF-8
all=${LOOKS:-1024x600 en:1:dark en:2:dark,3840x2160 fr:3:dark}
tabs="EMBED_TAB_NAME = Lamps\nEMBED_TAB_COMMAND = pyvcp $PWD/tab.xml\nEMBED_TAB_NAME = Guest\nEMBED_TAB_COMMAND = /usr/bin/python3 $PWD/guest.py {XID}"
while read -rd, size looks; do
    language=${looks%%:*}
    for position in RIGHT BOTTOM; do
        echo "== $size, $language, $position"
        ini_edit="s|^DISPLAY = .*|&\nPYVCP = $PWD/panel.xml\nPYVCP_POSITION = $position\n$tabs|"
        LOOKS=$looks TONGUE=$language LANGUAGE=$language screen_size=$size screen_test mill look.py
        cat machine/transcript
        grep -i -A8 traceback screen.err
    done
done <<< "$all,"
rm -rf machine home screen.log screen.err panel.xml tab.xml guest.py
