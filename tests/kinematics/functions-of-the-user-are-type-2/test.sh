#!/bin/bash
# `userkfuncs=FILE make` of the tree, and of switchkins.mk that an installed system has, put a user's functions
# into the switchable modules as type 2; switchkins.mk also builds a module of the user's own.
unset KERF_CLOCK EMC2_HOME
top=$(cd ../../.. && pwd)
tmp=$(mktemp -d); trap 'rm -rf "$tmp"' EXIT
PATH=$tmp/bin:$tmp/scripts:$PATH
try() { # MODULE: loads it from $tmp with type 2
    printf '%s\n' "loadrt $1" "show pin mine" "setp mine.scale 10" \
        "loadrt kinscheck type=2 ranges=1:1,2:2,3:3 points=1 show=1" > "$tmp/try.hal"
    echo "-- $1"
    "$tmp/bin/halrun" -f "$tmp/try.hal" 2>> "$tmp/log" | grep -o '[0-9.]*  mine.scale\|pose [0-9].*\|[0-9]* bad'
}
# a tree of its own, so that the modules of this one stay as they are
mkdir "$tmp"/{bin,scripts,user,rtlib} && ln -s "$top/lib" "$tmp/lib"
cp "$top"/bin/{rtapi_app,halcmd,halrun} "$tmp/bin"
cp "$top"/scripts/{realtime,rtapi.conf} "$tmp/scripts"
cp "$top/rtlib/hal_lib.so" "$tmp/rtlib"
build() { make -s -C "$top" T="$tmp" MAKEFLAGS= "$tmp/rtlib/scarakins.so" "$tmp/rtlib/kinscheck.so" >> "$tmp/log" 2>&1 || cat "$tmp/log"; }
export userkfuncs=$PWD/mine.c
build
try scarakins
userkfuncs=$PWD/absent.c make -s -C "$top" T="$tmp" "$tmp/rtlib/scarakins.so" 2>&1 | grep -o 'absent.c: no such file'

rm "$tmp/rtlib/scarakins.so"
make -s -C "$tmp/user" -f "$top/src/switchkins.mk" MODULES="scarakins genhexkins" >> "$tmp/log" 2>&1 || cat "$tmp/log"
cp "$tmp"/user/*.so "$tmp/rtlib"
try scarakins
try genhexkins
cp own.c "$tmp/user"
make -s -C "$tmp/user" -f "$top/src/switchkins.mk" MODULES=own >> "$tmp/log" 2>&1 || cat "$tmp/log"
cp "$tmp"/user/own.so "$tmp/rtlib"
try own

unset userkfuncs # and back: the template
build
printf '%s\n' "loadrt scarakins" "show pin userk" > "$tmp/try.hal"
"$tmp/bin/halrun" -f "$tmp/try.hal" 2>> "$tmp/log" | grep -o 'userk\..*'
