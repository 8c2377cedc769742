#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
set -eu
name=kerf_test_everything
module=$(dirname "$(command -v halcompile)")/../rtlib/$name.so
trap 'rm -f "$module"' EXIT
halcompile --install $name.comp > /dev/null
cat > "${TMPDIR:-/tmp}/$name.$$.hal" <<EOF
loadrt $name count=2 factor=40 other=1
show pin kerf-test-everything.1
show param kerf-test-everything.1
loadrt threads name1=t period1=1000000
addf kerf-test-everything.1 t
addf kerf-test-everything.1.second-function t
initf kerf-test-everything.0 t
start
EOF
KERF_CLOCK=virtual halrun -s -f "${TMPDIR:-/tmp}/$name.$$.hal" | sed 's/^ *[0-9]* */ID /; s/  */ /g'
rm -f "${TMPDIR:-/tmp}/$name.$$.hal"
