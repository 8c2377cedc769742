#!/bin/bash
# With a locale whose decimal sign is a comma, where the machine has one.
locale=$(mktemp -d)
trap 'rm -rf "$locale"' EXIT
with=()
if localedef -i de_DE -f UTF-8 "$locale/de_DE.UTF-8" 2> /dev/null; then with=(env LOCPATH="$locale" LC_ALL=de_DE.UTF-8); fi
"${with[@]}" ../../task/lib/machine-test script.py -file mill.tbl
