#!/bin/bash
# FP-191: letters, and lengths in points, follow the screen: its density (100 to 300 %), its size, what the desktop is set to (Xft.dpi).
export HOME=$PWD/home PYTHONPATH="$TEST_DIR/../../../lib/python:$PYTHONPATH"
unset KERF_SCALE
mkdir home
look() { # size dpi [command before]
    echo "$*"
    XVFB_OPTIONS="-dpi $2" ../../lib/with-display "$1" bash -c "${3:-:}; /usr/bin/python3 -B scale.py"
}
for screen in "1024x600 72" "1024x600 96" "1920x1080 96" "1920x1080 120" "1920x1080 144" "2560x1440 109" "3840x2160 96" "3840x2160 192" "3840x2160 288" "1920x1080 400"; do
    look $screen
done
for dpi in 192 288 nonsense; do
    look 1920x1080 96 "xprop -root -f RESOURCE_MANAGER 8s -set RESOURCE_MANAGER \$'Xft.dpi:\t$dpi\n'"
done
KERF_SCALE=1.75 look 1920x1080 96
printf '[DEFAULT]\ninterface_scale = 1.25\n' > home/.axis_preferences
look 3840x2160 288
rm -rf home
