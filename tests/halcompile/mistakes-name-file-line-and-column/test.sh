#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# Each line of mistakes.txt is the declaration part of a component named bad; a
# backslash-n in it begins a new line.
set -u
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
here=$PWD
cd "$folder" || exit 1
while IFS= read -r text; do
    printf "$text"'\n;;\nFUNCTION(_) { }\n' > bad.comp
    halcompile bad.comp 2>&1
    echo "status $?"
done < "$here/mistakes.txt"
printf 'component bad; pin in bit a; license "GPL";\n' > bad.comp
halcompile bad.comp 2>&1; echo "status $?"
halcompile --compile bad.txt 2>&1; echo "status $?"
halcompile -o x.c bad.comp other.comp 2>&1; echo "status $?"
halcompile --compile -o x.c bad.comp 2>&1; echo "status $?"
halcompile -d -k x.adoc bad.comp other.comp 2>&1; echo "status $?"
halcompile --print-modinc bad.comp 2>&1; echo "status $?"
halcompile missing.comp 2>&1; echo "status $?"
halcompile --nonsense bad.comp 2>&1 >/dev/null | tail -n 1
