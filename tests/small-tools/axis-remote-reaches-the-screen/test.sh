#!/bin/bash
# A display of our own, guarded by a cookie as Tk's send wants it.
folder=$(mktemp -d)
cookie=$(od -An -N16 -tx1 /dev/urandom | tr -d ' \n')
xauth -f "$folder/server" -q add :0 . "$cookie"
mkfifo "$folder/number"
Xvfb -screen 0 320x240x8 -nolisten tcp -auth "$folder/server" -displayfd 3 3> "$folder/number" 2> /dev/null &
server=$!
read -r number < "$folder/number"
xauth -f "$folder/client" -q add ":$number" . "$cookie"
DISPLAY=:$number XAUTHORITY=$folder/client /usr/bin/python3 -B script.py
kill $server
wait $server
rm -r "$folder"
