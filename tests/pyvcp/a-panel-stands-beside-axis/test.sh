#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# [DISPLAY]PYVCP: the panel's pins work in HAL files loaded behind the screen; Ctrl-E hides it.
. "$TEST_DIR/../../axis/lib/machine.sh"
cat > panel.xml <<'XML'
<pyvcp>
  <labelframe text="Panel">
    <button><halpin>"on"</halpin><text>"On"</text></button>
    <led><halpin>"lamp"</halpin></led>
    <spinbox><min_>0</min_><max_>2</max_><initval>1</initval><resolution>0.1</resolution></spinbox>
  </labelframe>
</pyvcp>
XML
cat > panel.hal <<'HAL'
net panel-on pyvcp.on => halui.machine.on
net panel-lamp halui.machine.is-on => pyvcp.lamp
HAL
ini_edit="/^\[DISPLAY\]/a PYVCP = $PWD/panel.xml"$'\n'"/^\[HAL\]/a POSTGUI_HALFILE = $PWD/panel.hal"
screen_test mill script.py
cat machine/transcript
grep -v -E '^(Note|task:)' screen.err | grep -i -A8 traceback
rm -rf machine home panel.xml panel.hal screen.log screen.err
