#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp kerf_test_page.comp "$folder"
cd "$folder"
halcompile --adoc kerf_test_page.comp
cat kerf_test_page.9.adoc
echo "-----"
halcompile --document --keep-adoc=kept.adoc kerf_test_page.comp
cmp kept.adoc kerf_test_page.9.adoc
cat kerf_test_page.9
printf 'component x; pin in bit a; option homemod; license "GPL";\n;;\n' > x.comp
halcompile --document --outfile=out.9 x.comp
grep HOMEMOD out.9
printf 'component x; pin in bit a; option userspace; license "GPL";\n;;\n' > x.comp
halcompile --document x.comp
grep '^\.TH' x.1
