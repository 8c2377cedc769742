#!/bin/bash
# A display of our own, guarded by a cookie as Tk's send wants it.
folder=$(mktemp -d)
export folder cookie=$(od -An -N16 -tx1 /dev/urandom | tr -d ' \n')
xauth -f "$folder/server" -q add :0 . "$cookie"
XVFB_OPTIONS="-auth $folder/server" ../../lib/with-display 320x240 bash -c '
    xauth -f "$folder/client" -q add "$DISPLAY" . "$cookie"
    XAUTHORITY=$folder/client /usr/bin/python3 -B script.py'
rm -r "$folder"
