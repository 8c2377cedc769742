#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# Components as people wrote them for 2.8 to 2.10: no one keyword, option or idiom is missing.
# They are built, installed and run (run.table), and a page is made of each.
set -eu
rtlib=$(dirname "$(command -v halcompile)")/../rtlib
folder=$(mktemp -d)
trap 'for c in *.comp; do rm -f "$rtlib/${c%.comp}.so"; done; rm -rf "$folder"' EXIT
cp ./*.comp ./*.h "$folder"
for c in *.comp; do
    case $c in readbutton.comp) continue;; esac
    halcompile --install "$folder/$c" 2>&1 | sed "s|$folder/||; s|Warning: \(.*\)$|Warning|" | grep -v '^Compiling \|^Linking ' || true
done
USER_MODULE_DIR=$folder halcompile --install "$folder/readbutton.comp" > /dev/null
for c in *.comp; do
    halcompile --document "$folder/$c" 2> /dev/null
    ls "$folder/${c%.comp}".[19] > /dev/null
done
/usr/bin/python3 -B ../../components/tables.py run.table
grep -A 1 'NAME\|AUTHOR' "$folder/lubricator.9"
cat > "$folder/user.hal" <<END
loadusr -W $folder/readbutton 16 names=first
setp first.quit 1
waitusr readbutton
END
halrun -f "$folder/user.hal" && echo "the program came and went"
