#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# Userspace components, plain C programs and Python programs; the folder's name has a blank.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/a folder" "$folder/installed"
cp ./*.comp ./*.c ./*.py "$folder/a folder"
cd "$folder/a folder"
halcompile --compile kerf_test_program.comp kerf_test_single.comp > build.log
halcompile --userspace --compile kerf_test_plain.c >> build.log
halcompile --compile kerf_test_module.c >> build.log
echo "-- default"; ./kerf_test_program
echo "-- count"; ./kerf_test_program first count=2 second
echo "-- names"; ./kerf_test_program names=a,,b
echo "-- both"; ./kerf_test_program names=a count=1 2>&1 || echo "status $?"
echo "-- single"; ./kerf_test_single
echo "-- plain"; ./kerf_test_plain
test -f kerf_test_module.so && test ! -x kerf_test_module.so && echo "-- module built"
USER_MODULE_DIR="$folder/installed" halcompile --install kerf_test_script.py kerf_test_program.comp >> build.log
ls -l "$folder/installed" | awk 'NR > 1 { print $1, $NF }'
head -c 2 "$folder/installed/kerf_test_script"; echo
"$folder/installed/kerf_test_script"
"$folder/installed/kerf_test_program" installed
# Scripts as editors wrote them: an encoding of their own, a byte order mark, other line ends.
printf '#!/usr/bin/python\n# -*- coding: latin-1 -*-\nprint(ascii("\374"))\n' > latin.py
printf '\357\273\277print("marked")\r\n' > marked.py
USER_MODULE_DIR="$folder/installed" halcompile --install latin.py marked.py
"$folder/installed/latin"; "$folder/installed/marked"
