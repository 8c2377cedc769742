#!/bin/bash
# halreport: signals with their pins, each with component and place of its function; what is
# left open; the same text into a file.
export KERF_CLOCK=virtual
realtime start 2> /dev/null
cat > t.hal <<'HAL'
loadrt threads name1=fast period1=1000000 name2=slow period2=10000000
loadrt and2 count=2
loadrt or2
addf and2.0 fast
addf or2.0 slow
net made and2.0.out => or2.0.in0 and2.1.in0
net unwritten or2.0.in1
newsig unused bit
net unread or2.0.out
HAL
halcmd -f t.hal
halreport | sed '/^HAL report/d; /^Version/d; /^Machine/d'
halreport report.txt | sed "s|$PWD|.|"
diff <(halreport | tail -n +2) <(tail -n +2 report.txt) && echo same
halreport /no/such/folder/report.txt; echo "=> $?"
unread() { /usr/bin/python3 -c 'import os, subprocess, sys; r, w = os.pipe(); os.close(r); print(sys.argv[1], subprocess.run(sys.argv[1:], stdout=w, stderr=subprocess.PIPE, text=True).stderr)' "$@"; }
unread halreport
unread hal-histogram --nox and2.0.time
halcmd list funct 'histobin*'
halreport a b; echo "=> $?"
rm -f t.hal report.txt
halrun -U 2> /dev/null
