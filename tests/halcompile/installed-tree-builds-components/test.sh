#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# halcompile of an installed system, which may lie anywhere, builds and installs a module, a
# program and a manual page; the installed HAL loads the module.
set -eu
top=$(cd ../../.. && pwd)
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
make -C "$top" -s install DESTDIR="$root" prefix=/usr >&2
mkdir "$root/work"
printf 'component kerf_test_there "Is there"; pin out s32 n = 42; function _; license "GPL";\n;;\nn++;\n' \
    > "$root/work/kerf_test_there.comp"
printf 'component kerf_test_run; pin out s32 n; option userspace; option singleton; license "GPL";\n;;\n#include <stdio.h>\nvoid user_mainloop(void) { puts("program runs"); }\n' \
    > "$root/work/kerf_test_run.comp"
cat > "$root/work/show.hal" <<EOF
loadrt kerf_test_there
show pin kerf-test-there.0.n
EOF
cd "$root/work"
run() {
    env -i HOME="$HOME" PATH="$root/usr/bin:/usr/bin:/bin" KERF_INSTANCE="${KERF_INSTANCE:-inst}" \
        LD_LIBRARY_PATH="$root/usr/lib" "$@"
}
run halcompile --print-modinc | sed "s|$root||"
run halcompile --install kerf_test_there.comp kerf_test_run.comp >&2
ls "$root/usr/lib/linuxcnc/modules/kerf_test_there.so" | sed "s|$root||"
for t in homecomp tpcomp userkins; do # templates of modules for motion; homecomp on the default homing
    sed "s/^component $t/component kerf_test_$t/; s,^// #define CUSTOM,#define CUSTOM," \
        "$root/usr/share/doc/linuxcnc/examples/templates/$t.comp" > kerf_test_$t.comp
done
run halcompile --install kerf_test_homecomp.comp kerf_test_tpcomp.comp kerf_test_userkins.comp >&2
ls "$root/usr/lib/linuxcnc/modules/" | grep 'kerf_test_.*\(comp\|kins\)'
run kerf_test_run
mkdir -p "$root/usr/share/man/man9"
run halcompile --install-doc kerf_test_there.comp
grep -c 'Is there' "$root/usr/share/man/man9/kerf_test_there.9"
run halrun -s -f show.hal | sed 's/^ *[0-9]* *//; s/  */ /g'
