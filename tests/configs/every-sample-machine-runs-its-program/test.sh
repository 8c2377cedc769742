#!/bin/bash
# Each configuration starts, homes, runs a program within its limits and stops.
unset KERF_CLOCK
top=$(cd ../../.. && pwd)
out=$(mktemp -d); trap 'rm -rf "$out"' EXIT
sed 's/#.*//' machines | while read -r ini program; do
    [ -n "$ini" ] || continue
    kerf-run --ini "$top/configs/sim/$ini" --picture "$out/p.png" "$top/nc_files/$program" > "$out/text" 2> "$out/errors"
    status=$?
    echo "$ini: status $status, limits: $(sed -n 's/^Limits *//p' "$out/text")"
    [ $status = 0 ] || tail -n 5 "$out/errors" >&2
done
