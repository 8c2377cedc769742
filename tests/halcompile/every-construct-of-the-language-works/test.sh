#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# Pins and parameters of two instances as declared, then after one call of each
# function of instance 1.
set -eu
name=kerf_test_everything
hal=$(mktemp --suffix=.hal)
module=$(dirname "$(command -v halcompile)")/../rtlib/$name.so
trap 'rm -f "$module" "$hal"' EXIT
halcompile --install $name.comp > /dev/null
cat > "$hal" <<EOF
loadrt $name count=2 factor=40 other=1
show pin kerf-test-everything.1
show param kerf-test-everything.1
loadrt threads name1=t period1=1000000
loadrt sampler depth=10 cfg=s
initf kerf-test-everything.1 t
initf kerf-test-everything.1.second-function t
addf sampler.0 t
start
loadusr -w halsampler -n 1
show pin kerf-test-everything.1
show param kerf-test-everything.1
EOF
KERF_CLOCK=virtual halrun -s -f "$hal" | sed 's/^ *[0-9]* */ID /; s/  */ /g'
