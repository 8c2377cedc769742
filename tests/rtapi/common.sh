# SPDX-License-Identifier: GPL-2.0-or-later
# Sourced by the tests of this folder (bash). Defines:
#   top             the tree under test
#   clock_test      the test program of the clock
#   small_tree M... makes $tree (bin/rtapi_app, scripts/realtime, rtlib/hal_lib.so and the
#                   modules M of modules/) and removes it at the end
#   start_host      starts it; host_log prints what it printed
#   host_pid        process id of this instance's host
top=$(cd ../../.. && pwd)
clock_test=$top/objects/test/clock-test
export KERF_INSTANCE=${KERF_INSTANCE:-}-rtapi RTAPI_FIFO_PATH=${RTAPI_FIFO_PATH:-/kerf-test}
# What the machine allows is not the subject: these notes differ from one to the next.
no_notes() { grep -v -e '^Note: ' -e '^  Process cap' -e '^  Falling back' -e '^  Fix: ' -e '^  Override' -e '^No isolated CPU'; }

small_tree() {
    tree=$(mktemp -d)
    trap 'realtime_stop >/dev/null 2>&1; rm -rf "$tree"' EXIT
    mkdir "$tree/bin" "$tree/rtlib" "$tree/scripts"
    cp "$top/bin/rtapi_app" "$tree/bin"
    cp "$top/scripts/realtime" "$top/scripts/rtapi.conf" "$tree/scripts"
    cp "$top/rtlib/hal_lib.so" "$tree/rtlib"
    chmod -R a+rX "$tree"
    for module in "$@"; do
        ${CC:-gcc} -O1 -std=gnu11 -fPIC -shared -DRTAPI -DUSPACE -I"$top/include" -o "$tree/rtlib/$module.so" \
            "../modules/$module.c" || exit 1
    done
    app=$tree/bin/rtapi_app
}
# The host keeps the standard output of whoever starts it: a file, else a pipe never ends.
start_host() { "$app" start >> "$tree/log" 2>&1; }
host_log() { sed "s|$tree|TREE|" "$tree/log" | no_notes || :; }
realtime_stop() { "$app" stop-and-clean; }
host_pid() {
    /usr/bin/python3 - "$RTAPI_FIFO_PATH${KERF_INSTANCE:+.$KERF_INSTANCE}" <<'END'
import socket, struct, sys
s = socket.socket(socket.AF_UNIX)
s.connect((b"\0" + sys.argv[1].encode()).ljust(108, b"\0"))
s.sendall(b"\x0a\0\1\0\4\0ping")
s.recv(8)
print(struct.unpack("3i", s.getsockopt(socket.SOL_SOCKET, socket.SO_PEERCRED, 12))[0])
END
}
