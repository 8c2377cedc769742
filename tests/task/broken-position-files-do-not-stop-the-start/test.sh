#!/bin/bash
# FP-132: an empty, cut or foreign position file gives a warning and is not used; a good one is.
TMPDIR=$(mktemp -d)
trap 'rm -rf "$TMPDIR"' EXIT
for text in "" "1.5\n2" "nonsense\n" "nan\ninf\n$(printf '0\\n%.0s' {1..14})" "$(printf '1.25\\n%.0s' {1..16})"; do
    printf "$text" > "$TMPDIR/pos.txt"
    SHOW_LOG=1 ../lib/machine-test script.py TRAJ.POSITION_FILE=pos.txt -file "$TMPDIR/pos.txt" 2> "$TMPDIR/log"
    grep -o "position file.*\|emcPositionLoad.*" "$TMPDIR/log"
done
exit 0
