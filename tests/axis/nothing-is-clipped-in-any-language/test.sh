#!/bin/bash
# FP-191: every language has every text; on small and large screens, in both themes, with large touch targets and at
# every scale that the screen has room for, each widget has the room that it asks for.
. "$TEST_DIR/../lib/machine.sh"
"$top/scripts/message-strings" --check "$top"/src/po/*.po && echo "catalogues are complete: $(cd "$top/src/po" && echo *.po)"
run() { # size language
    screen_size=$1 LANGUAGE=$2 LANG=C.UTF-8 screen_test mill sizes.py
    cat machine/transcript
    grep -i -A8 traceback screen.err
}
ini_edit='s|^\[DISPLAY\]|&\nOPEN_FILE = ""|'
run 1024x600 de
run 3840x2160 fr
rm -rf machine home screen.log screen.err
