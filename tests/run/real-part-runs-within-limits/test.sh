#!/bin/bash
# A real part of 4,700 lines runs to its end with no joint over a limit.
unset KERF_CLOCK
part=${KERF_CONFORMANCE:-../../../../shared/conformance}/rs274/programs/3D_Chips.ngc
out=$(mktemp -d); trap 'rm -rf "$out"' EXIT
kerf-run --picture "$out/p.png" "$part" > "$out/text"
echo "status $?"
cat "$out/text" >&2
grep Limits "$out/text"
