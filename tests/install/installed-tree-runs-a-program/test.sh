#!/bin/bash
# `make install DESTDIR=...` gives a tree that works from where it stands: a program runs there.
top=$(cd ../../.. && pwd)
root=$(mktemp -d); trap 'rm -rf "$root"' EXIT
make -C "$top" -s install DESTDIR="$root" prefix=/usr >&2 || exit 1
for f in usr/bin/linuxcnc usr/bin/halcmd usr/bin/rtapi_app usr/bin/rs274 usr/lib/linuxcnc/modules/motmod.so \
    usr/lib/linuxcnc/realtime usr/include/linuxcnc/hal.h usr/lib/python3/dist-packages/linuxcnc.so \
    usr/share/linuxcnc/linuxcnc.nml usr/share/linuxcnc/ncfiles usr/share/doc/linuxcnc/examples/sample-configs/sim/mill/mill.ini; do
    [ -e "$root/$f" ] || echo "missing: $f"
done
# Nothing of this tree may help: only the installed one is on the paths.
env -i HOME="$HOME" PATH="$root/usr/bin:/usr/bin:/bin" PYTHONPATH="$root/usr/lib/python3/dist-packages" \
    LD_LIBRARY_PATH="$root/usr/lib" KERF_INSTANCE="${KERF_INSTANCE:-inst}" \
    "$root/usr/bin/kerf-run" --picture "$root/p.png" "$root/usr/share/linuxcnc/ncfiles/bracket.ngc" > "$root/text"
echo "status $?"
cat "$root/text" >&2
grep -o 'none exceeded' "$root/text"
