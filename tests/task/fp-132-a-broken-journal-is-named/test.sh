#!/bin/bash
# FP-132: a journal that is empty, cut or garbage is named at the start; the one before it is used where it is whole. Nothing else changes.
scratch=$(mktemp -d); trap 'rm -rf "$scratch"' EXIT
whole=$'program /nc/part.ngc\nline 7\ntime 2026-11-01 12:00:00\nposition X1.000000\n'
journal=$scratch/mill.var.journal
start() { # name
    echo "== $1"
    ../lib/machine-test script.py -file "$journal" ${2:+-file "$2"}
}
printf '%s' "$whole" > "$journal.bak"
head -c 300 /dev/zero > "$journal"; start "NULs, with the one before" "$journal.bak"
printf '%s' "${whole:0:30}" > "$journal"; start "cut, with the one before" "$journal.bak"
: > "$journal"; start empty
printf 'line 99999999999\nprogram \200\377\nposition' > "$journal"; start garbage
