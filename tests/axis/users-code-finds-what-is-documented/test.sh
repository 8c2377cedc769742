#!/bin/bash
# Names, widgets, commands and paths that a user's file may rely on; pins of axisui; files behind the screen.
. "$TEST_DIR/../lib/machine.sh"
printf 'loadrt or2 names=behind,behind2\n' > before.hal
printf 'setp behind.in0 1\nalias pin behind.in0 behind.in\n' > post.hal
ini_edit="s|^DISPLAY = .*|&\nUSER_COMMAND_FILE = $PWD/hooks.py|; s|^HALFILE = spindle.hal|&\nHALFILE = $PWD/before.hal\nPOSTGUI_HALFILE = $PWD/post.hal\nPOSTGUI_HALCMD = alias pin behind2.in0 behind2.in|"
screen_test mill screen.py
cat machine/transcript
grep -i -A8 traceback screen.err
rm -rf machine home before.hal post.hal screen.log screen.err
