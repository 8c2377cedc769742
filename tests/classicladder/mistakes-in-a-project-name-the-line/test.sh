#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# Projects with one mistake each; the ladder stays stopped. Then options and a missing module.
set -u
folder=$(mktemp -d)
trap 'realtime stop > /dev/null 2>&1; rm -rf "$folder"' EXIT
export KERF_CLOCK=virtual
realtime start > /dev/null 2>&1
halcmd loadrt classicladder_rt numRungs=2 numArithmExpr=2
try() {
    printf '_FILES_CLASSICLADDER\n_FILE-%s\n%b_/FILE-%s\n_/FILES_CLASSICLADDER\n' "$1" "$2" "$1" > "$folder/x.clp"
    classicladder --nogui "$folder/x.clp" 2>&1 | sed "s|$folder/||"
}
try timers.csv 'one,two\n'
try rung_0.csv '#VER=2.0\n1-0-50/0 , 0-0-0/0\n'
try rung_5.csv '#VER=2.0\n'
try arithmetic_expressions.csv '#VER=2.0\n0007,1>2\n'
try sections.csv '#VER=1.0\n0,0,-1\n'
try sequential.csv 'S0,1\n'
try sequential.csv 'T0,1\n'
try modbusioconf.csv '#VER=1.0\n1,2,3\n'
cells='0-0-0/0 , 0-0-0/0 , 0-0-0/0 , 0-0-0/0 , 0-0-0/0 , 0-0-0/0 , 0-0-0/0 , 0-0-0/0 , 0-0-0/0 , '
try rung_0.csv "$cells""20-0-0/0\\n_/FILE-rung_0.csv\\n_FILE-arithmetic_expressions.csv\\n0000,1 + 2\\n"
try rung_0.csv "$cells""60-0-0/0\\n_/FILE-rung_0.csv\\n_FILE-arithmetic_expressions.csv\\n0000,1 > 2\\n"
printf 'nonsense\n' > "$folder/x.clp"
classicladder --nogui "$folder/x.clp" 2>&1 | sed "s|$folder/||"
: > "$folder/x.clp"
classicladder --nogui "$folder/x.clp" 2>&1 | sed "s|$folder/||"
classicladder --nogui "$folder/none.clp" 2>&1 | sed "s|$folder/||"
halcmd loadrt threads
halcmd addf classicladder.0.refresh thread1
halcmd start
halcmd loadrt sampler depth=10 cfg=b
halcmd addf sampler.0 thread1
halsampler -n 2 > /dev/null
halcmd getp classicladder.ladder-state
mkdir "$folder/parts"
printf '#VER=2.0\n' > "$folder/parts/rung_0.csv"
classicladder --nogui "$folder/parts"
halsampler -n 2 > /dev/null
halcmd getp classicladder.ladder-state
realtime stop > /dev/null 2>&1
classicladder --nogui 2>&1
echo "status $?"
classicladder --help | head -n 1
