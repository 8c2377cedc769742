#!/bin/bash
# FP-132: every program that keeps a file writes a new one, syncs it and renames it, the old one stays. Each call of the write in turn fails
# (no room, read only, broken disk) or is the last of the process: the old text or the new one is there. Damaged files are named, programs
# start with what is kept or with their defaults, and the damaged text is still there after the next write. SEED, ROUNDS: of the damages.
scratch=$(mktemp -d); trap 'rm -rf "$scratch"' EXIT
gcc -shared -fPIC -O1 -o "$scratch/failing_writes.so" "$EMC2_HOME/tests/lib/failing_writes.c" || exit 1
export HOME=$scratch/home PYTHONDONTWRITEBYTECODE=1; mkdir "$HOME"
export LD_PRELOAD=$scratch/failing_writes.so
/usr/bin/python3 run.py "$scratch" 2>&1
/usr/bin/python3 writers.py
unset LD_PRELOAD
cd "$scratch"
echo "# mine" > keep.hal
for type in nonsense all; do
    printf "loadrt and2\nsave $type keep.hal\n" > t.hal
    halrun t.hal 2>&1 | grep -o "Unknown 'save' type.*"
    head -1 keep.hal keep.hal.bak 2> /dev/null
done
