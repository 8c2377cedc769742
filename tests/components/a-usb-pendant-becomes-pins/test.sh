#!/bin/bash
PENDANT=$(mktemp -d)
export PENDANT PYTHONPATH="$TEST_DIR/../../lib:$PYTHONPATH"
trap 'halrun -U >/dev/null 2>&1; rm -rf "$PENDANT"' EXIT
cc -shared -fPIC $(pkg-config --cflags libusb-1.0) -o "$PENDANT/usb.so" usb.c || exit
mkfifo "$PENDANT/in"
realtime start 2>/dev/null
timeout 100 /usr/bin/python3 check.py
