#!/bin/bash
# Virtual time: every joint's command of every servo cycle is the same, bit for bit, in two runs,
# also when the machine is busy with something else.
unset KERF_CLOCK
base=${KERF_INSTANCE:-det}
out=$(mktemp -d)
trap 'kill $busy 2>/dev/null; rm -rf "$out"' EXIT
one() { KERF_INSTANCE=$base-$1 kerf-run --samples "$out/$1" --picture "$out/p.png" part.ngc > "$out/text.$1" || cat "$out/text.$1"; }
one a
(while :; do :; done) & busy=$!
one b
kill $busy
rows=$(($(stat -c %s "$out/a") / 24))
[ "$rows" -gt 5000 ] && echo "thousands of cycles recorded"
cmp "$out/a" "$out/b" && echo identical
