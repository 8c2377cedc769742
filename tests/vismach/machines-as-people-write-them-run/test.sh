#!/bin/bash
# Machines as people write them (own classes, own OpenGL, files of a CAD program, texts with pins) start unchanged, follow their pins
# and end quietly.
top=$(cd "$TEST_DIR/../../.." && pwd)
for machine in "$TEST_DIR"/machines/*.py; do
    name=$(basename "$machine" .py)
    "$top/tests/lib/with-display" 640x480 /usr/bin/python3 "$TEST_DIR/look.py" "$machine" 2> errors
    grep -v '^$' errors | sed "s/^/$name: /"
done
rm -f errors part.stl
