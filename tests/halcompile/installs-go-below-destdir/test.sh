#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# --install puts modules, programs, scripts and pages below DESTDIR (as packages are made), with
# their modes, and nothing beside the sources; flags for linking reach the program, from the
# command line or from the file, but not from both; homemod and tpmod make singletons whose
# pages tell the INI setting.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
top=$EMC2_HOME
module() { printf 'component %s "Text"; pin in bit a; %s license "GPL";\n;;\n%s\n' "$1" "$2" "$3" > "$1.comp"; }
module kerf_test_rt 'function _;' 'FUNCTION(_) { (void)a; }'
module kerf_test_user 'option userspace; option singleton;' \
    '#include <stdio.h>
double kerf_test_twice(double); void user_mainloop(void) { printf("twice %g\n", kerf_test_twice(a + 4)); }'
printf 'print("script runs")\n' > kerf_test_py.py
echo 'double kerf_test_twice(double x) { return 2 * x; }' > twice.c
cc -c twice.c && ar rc libtwice.a twice.o
export DESTDIR="$folder/dest dir"
before=$(ls)
halcompile --install kerf_test_rt.comp > log
halcompile -i kerf_test_py.py >> log
halcompile --install --extra-link-args="-L$folder -ltwice" kerf_test_user.comp >> log
halcompile --install-doc kerf_test_rt.comp
unset DESTDIR
echo "-- installed"
(cd "dest dir$top" && find . -type f -printf '%m %P\n' | sort)
[ "$(ls | grep -v '^log$\|^dest dir$')" = "$before" ] && echo "-- nothing beside the sources"
ls "$top/rtlib" "$top/bin" | grep kerf_test_rt || echo "-- nothing outside of DESTDIR"
"dest dir$top/bin/kerf_test_user"
"dest dir$top/bin/kerf_test_py"

echo "-- link flags"
halcompile --compile kerf_test_user.comp > log 2>&1 || echo "status $?: $(grep -o 'undefined reference to .kerf_test_twice' log)"
module kerf_test_user "option userspace; option singleton; option extra_link_args \"-L$folder -ltwice\";" \
    "$(sed '1,/^;;$/d' kerf_test_user.comp)"
halcompile --compile kerf_test_user.comp > log 2>&1 && ./kerf_test_user
halcompile --compile --extra-link-args=-ltwice kerf_test_user.comp 2>&1 | head -n 1

echo "-- homemod and tpmod"
for kind in homemod tpmod; do
    module kerf_test_$kind "option $kind;" 'FUNCTION_OF_MOTION'
    halcompile --adoc kerf_test_$kind.comp
    sed -n '/^== SYNOPSIS/,/^== [^S]/ { /^\*\|^Custom/p }' kerf_test_$kind.9.adoc
    grep '^\*\*.*\*\* bit in' kerf_test_$kind.9.adoc
    halcompile kerf_test_$kind.comp
    grep -c 'RTAPI_MP.*\(count\|names\)' kerf_test_$kind.c || true
done
