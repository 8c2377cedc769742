#!/bin/bash
# FP-191: every language has every text; on small and large screens, in both themes, with large touch targets and at
# every scale each widget, menu and dialog has the room that it asks for; letters give way where the screen has none.
# LOOKS="SCREEN LOOK...[,SCREEN LOOK...]": other ones (scripts/fit-matrix has all).
. "$TEST_DIR/../lib/machine.sh"
"$top/scripts/message-strings" --check "$top"/src/po/*.po && echo "catalogues are complete: $(cd "$top/src/po" && echo *.po)"
export LANG=C.UTF-8
all=${LOOKS:-1024x600 long:1:light long:2:dark:touch,1366x768 de:1.5:light de::dark:touch,1920x1080 en:2:light en:1.5:light en:1.5:light:touch,3840x2160 fr::light:touch fr:2:dark}
while read -rd, size looks; do
    for language in $(tr ' ' '\n' <<< "$looks" | sed 's/:.*//' | uniq); do
        echo "== $size, $language"
        LOOKS=$(tr ' ' '\n' <<< "$looks" | grep "^$language:") TONGUE=$language LANGUAGE=$language screen_size=$size screen_test mill sizes.py
        cat machine/transcript
        grep -i -A8 traceback screen.err
    done
done <<< "$all,"
rm -rf machine home screen.log screen.err
