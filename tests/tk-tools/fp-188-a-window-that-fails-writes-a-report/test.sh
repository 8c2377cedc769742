#!/bin/bash
# FP-188: a fault in the code of a small window ends nothing; a report has the stack, the hash of the configuration and
# what was done before.
export HOME=$PWD INI_FILE_NAME=$PWD/machine.ini PYTHONPATH="$TEST_DIR/../../lib:$PYTHONPATH"
echo "[EMC]" > machine.ini
../../lib/with-display /usr/bin/python3 - 2> told <<'PY'
from kerf import tkstyle
from tk_hand import Hand
import tkinter

root = tkstyle.open_display("halmeter", "Halmeter")
trouble = root.report_callback_exception
button = tkinter.Button(root, text="fails", command=lambda: {}["missing"])
button.pack()
hand = Hand(root)
root.report_callback_exception = trouble        # the program's own
for key in range(1200):
    root.event_generate("<KeyPress-a>")
hand.click(button)
hand.click(button)
print("goes on:", bool(root.winfo_exists()))
PY
grep -c "^KeyError: 'missing'" told
report=$(ls -t .halmeter_reports/report-* | head -1)
grep -c "$PWD/$report" told | sed 's/^[12]$/told/'
sed "s/^halmeter .*/halmeter VERSION/; s/^20..-.*/TIME/; s|$PWD/||; s/^..:..:......./TIME/; s/$(sha256sum < machine.ini | cut -d' ' -f1)/HASH/" "$report" | uniq -c | sed 's/^ *//' | grep -v "File\|\^"
rm -rf .halmeter_reports machine.ini told
