#!/bin/bash
# Two instances at the same time, each with its own program; neither disturbs the other.
unset KERF_CLOCK
base=${KERF_INSTANCE:-two}
out=$(mktemp -d); trap 'rm -rf "$out"' EXIT
printf 'G21 G90 F2000\nG1 X10\nG1 Y20\nM2\n' > "$out/a.ngc"
printf 'G21 G90 F2000\nG1 X-30\nG1 Z-5\nM2\n' > "$out/b.ngc"
for n in a b; do
    KERF_INSTANCE=$base-$n kerf-run --picture "$out/$n.png" "$out/$n.ngc" > "$out/$n.txt" & pids="$pids $!"
done
for p in $pids; do wait "$p" || echo "run ended with $?"; done
grep -h Final "$out/a.txt" "$out/b.txt"
