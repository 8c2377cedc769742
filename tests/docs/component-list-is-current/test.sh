#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# docs/components.md is what `make component-list` writes, and every page is good troff.
set -eu
top=$(cd ../../.. && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$top"
/usr/bin/python3 -B src/hal/components/conv_gen.py "$folder/conv"
export PYTHONPATH=src/hal/utils
pages="$folder/conv/*.comp src/hal/components/*.comp src/hal/components/man/*.adoc"
/usr/bin/python3 -B src/hal/components/manuals.py list $pages > "$folder/list"
diff docs/components.md "$folder/list" && echo "list is current"
/usr/bin/python3 -B src/hal/components/manuals.py man "$folder" $pages
if command -v groff > /dev/null; then
    (cd "$folder" && groff -man -Tutf8 -ww -z man?/* 2>&1)
fi
# Every module has a page.
for source in src/hal/components/*.c src/hal/components/*.comp; do
    name=$(basename "$source"); name=${name%.*}
    case $name in classicladder*) continue;; esac
    test -f "$folder/man9/$name.9" || test -f "$folder/man1/$name.1" || echo "no page: $name"
done
echo "done"
