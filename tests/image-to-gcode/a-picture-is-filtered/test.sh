#!/bin/bash
# As a filter without a display, then with its window: settings are asked for, checked and remembered.
export PYTHONPATH="$TEST_DIR/../../lib:$PYTHONPATH" HOME=$(mktemp -d)
trap 'rm -rf "$HOME"' EXIT
cd "$HOME" || exit
/usr/bin/python3 - <<P
import numpy
from PIL import Image
grey = numpy.linspace(0, 255, 20 * 30).reshape(20, 30).astype("uint8")
Image.fromarray(grey).save("a.png")
Image.fromarray(grey.astype("int32") * 257).save("deep.png")
Image.fromarray(numpy.dstack([grey] * 3)).save("b c.jpg")
P
echo "== without a display"
unset DISPLAY
AXIS_PROGRESS_BAR=1 image-to-gcode a.png > a.ngc 2> told; echo "status $?"
grep -v FILTER_PROGRESS told; grep FILTER_PROGRESS told | sed -n '1p;$p'
head -12 a.ngc; tail -3 a.ngc
rs274 -g a.ngc > canon; echo "runs: $?"
for file in deep.png "b c.jpg"; do image-to-gcode "$file" 2>/dev/null | tail -1; done
image-to-gcode none.png 2>&1; echo "status $?"
echo "no picture" > text.png; image-to-gcode text.png 2>&1 | sed 's/ .*//'
printf 'cos\nsystem\n(S"touch hacked"\ntR.' > .image2gcoderc; image-to-gcode a.png 2>/dev/null | cmp - a.ngc && ls hacked 2>/dev/null; rm .image2gcoderc
echo "== with its window"
timeout 100 "$TEST_DIR/../../lib/with-display" /usr/bin/python3 "$TEST_DIR/clicks.py"
echo "== remembered"
image-to-gcode a.png 2>/dev/null | sed -n '1p;4,5p;$p'
