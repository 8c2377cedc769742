#!/bin/bash
# The dialogs themselves: what they say, which button has the keyboard, what Return, space, Escape, Alt with a digit and the
# window's close button answer, what is checked while it is typed. Nothing is faked here.
. "$TEST_DIR/../lib/machine.sh"
printf 'G21 G90\nG1 X900 F600\nM2\n' > part.ngc
screen_test mill windows.py "$PWD/part.ngc"
sed "s#$PWD/##g; s#/tmp/axis-[^/]*/##" machine/transcript || cat screen.log screen.err >&2
grep -i -A8 traceback screen.err
rm -rf machine home part.ngc screen.log screen.err
