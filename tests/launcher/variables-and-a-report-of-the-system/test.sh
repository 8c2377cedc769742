#!/bin/bash
# linuxcnc_var tells each variable, linuxcnc_info writes a report of named lines, realtime tells its state.
top=$(cd ../../.. && pwd)
linuxcnc_var all | sed "s,$top,TOP,; s/=[0-9].*/=VERSION/"
for n in $(linuxcnc_var all | cut -d= -f1); do [ "$(linuxcnc_var $n)" = "$(linuxcnc_var all | sed -n "s/^$n=//p")" ] || echo "$n differs"; done
linuxcnc_var NOPE; echo "status $?"
linuxcnc_var > /dev/null 2>&1; echo "status $?"
linuxcnc_info -h > /dev/null; echo "status $?"
linuxcnc_info -x > /dev/null 2>&1; echo "status $?"
linuxcnc_info -s > told; cat told | sed 's/linuxcnc_info.txt.*/linuxcnc_info.txt/'; file=$(sed 's/.* //' told); rm told
for n in date uptime lsb_release python gcc git LINUXCNCVERSION HALLIB_DIR; do grep -qE "^ *$n: " "$file" || echo "no line: $n"; done
for n in tcl tk; do grep -qE "^ *$n: [0-9]+\.[0-9]" "$file" || echo "no version: $n"; done
awk -F: 'length($1) < 20 && /^ *[a-z]+: / { n++ } END { print (n ? "lines not aligned" : "aligned") }' "$file"
realtime status; echo "status $?"
realtime start > /dev/null 2>&1; realtime status; echo "status $?"
realtime stop; realtime status; echo "status $?"
realtime nonsense > /dev/null 2>&1; echo "status $?"
rm -f "$file"
