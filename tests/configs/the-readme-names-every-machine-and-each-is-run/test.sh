#!/bin/bash
# configs/README names each INI file once, with the program that the tests run on it; each has a text
# for the picker, and each folder a README whose signals, pins and files are there; linuxcnc_check_ini has nothing to say against any of them.
top=$(cd ../../.. && pwd)
sed -nE 's/^  (\S+\.ini) .* (\S+\.(ngc|calls))$/\1 \2/p' "$top/configs/README" | sort > readme.tmp
sed 's/#.*//' ../*/machines | awk 'NF == 2 { print $1, $2 }' | sort > machines.tmp
(cd "$top/configs/sim" && find . -name '*.ini' | sed 's,^\./,,' | sort) > files.tmp
trap 'rm -f readme.tmp machines.tmp files.tmp check.tmp' EXIT
echo "differences of README and tests:"; diff readme.tmp machines.tmp
echo "differences of README and files:"; diff <(cut -d' ' -f1 readme.tmp) files.tmp
while read -r ini program; do
    [ -r "$top/nc_files/$program" ] || echo "$program does not exist"
    [ -s "$top/configs/sim/${ini%.ini}.txt" ] || echo "$ini has no text for the picker"
    linuxcnc_check_ini -e "$top/configs/sim/$ini" > check.tmp 2>&1 || cat check.tmp
done < readme.tmp
for folder in "$top"/configs/sim/*/; do
    (cd "$folder" && grep -o '`[^` ]*`' README | tr -d '`' | sort -u | while read -r name; do grep -rqF --include=*.hal --include=*.ini --include=*.xml -e "$name" . || echo "$folder has no $name"; done
    grep -oE '[A-Za-z_-]+\.(hal|ini|xml|py|txt)\b' README | sort -u | while read -r name; do [ -e "$name" ] || echo "$folder has no $name"; done
    for ini in *.ini; do grep -qF "$ini" README || echo "$folder: README does not name $ini"; done)
done
[ "$(wc -l < files.tmp)" -ge 24 ] && echo "all are there"
