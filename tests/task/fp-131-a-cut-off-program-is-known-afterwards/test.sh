#!/bin/bash
# FP-131: task is killed in the middle of a program; then everything at once, in a subroutine's file, as by a power cut. The next start names program, line, position, offsets, tool
# and modes; a start at that line shows each item first, and nothing moves before it is confirmed.
export KERF_CLOCK=virtual
out=$(mktemp -d); trap 'rm -rf "$out"' EXIT
export HOME=$out PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$PWD/../lib:$PWD/../../lib:$PYTHONPATH
cp -r "$EMC2_HOME/configs/sim/mill" "$out/machine"
for part in cut again end change unsure power changed; do
    if [ $part = changed ]; then
        echo '; a comment' >> "$out/machine/mill.tbl"
        sed -i 's/^T2 .*/T2 P2 D6 Z99/' "$out/machine/mill.tbl"
        echo '# a comment' >> "$out/machine/mill.ini"
        sed -i 's/X10 Y5/X11 Y5/' "$out/machine/caller.ngc"
    fi
    printf '#!/bin/sh\nexec /usr/bin/python3 %s/script.py %s > %s/out 2>&1\n' "$PWD" $part "$out" > "$out/display"; chmod +x "$out/display"
    linuxcnc -r -D "$out/display" "$out/machine/mill.ini" > "$out/log" 2>&1 < /dev/null
    echo "$part: status $([ $? -ne 0 ] && echo not 0 || echo 0)"
    sed "s|$out|OUT|g" "$out/out"
    ls "$out"/machine | grep journal || :
done
