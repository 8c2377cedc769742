#!/bin/bash
# Components are compiled, and HAL files run, in folders with spaces and letters of any language;
# flags and libraries of a program come from its source or from the command line.
set -u
mkdir -p 'my wörk ж'; cd 'my wörk ж' || exit 1
cat > fp172.comp <<'COMP'
component fp172;
pin out float root;
function _;
license "GPL";
;;
#include <rtapi_math.h>
FUNCTION(_) { root = sqrt(4); }
COMP
program() { # name, its options
    cat > "$1.comp" <<COMP
component $1;
pin out s32 n;
option userspace;
option singleton;
$2
license "GPL";
;;
#include <math.h>
#include <stdio.h>
void user_mainloop(void) { volatile double x = FP172_N; printf("%g\n", cbrt(x)); }
COMP
}
program fp172_own 'option extra_compile_args "-DFP172_N=27"; option extra_link_args "-lm";'
program fp172_line ''
halcompile --compile fp172.comp > log 2>&1 || cat log
ls fp172.so
halcompile --compile fp172_own.comp > log 2>&1 || cat log
./fp172_own
halcompile --compile --extra-compile-args=-DFP172_N=8 --extra-link-args=-lm fp172_line.comp > log 2>&1 || cat log
./fp172_line
cat > 'a file.hal' <<'HAL'
newsig süß float
sets süß 4
gets süß
HAL
printf '[S]\nV = süß\n' > 'ein ini.ini'
printf 'newsig [S]V bit\nstype [S]V\n' > 'use it.hal'
echo 'puts "tcl [hal newsig t bit] [hal stype t]"' > 'a script.tcl'
halcmd -f 'a file.hal'
halcmd -i 'ein ini.ini' -f 'use it.hal' 2>&1
halrun -f 'a file.hal' 2> /dev/null; echo "=> $?"
halrun 'a file.hal' 2> /dev/null; echo "=> $?"
halrun 'a script.tcl' 2> /dev/null; echo "=> $?"
haltcl 'a script.tcl'
halreport 'a report.txt' | sed "s|.*/||"
cd ..; rm -rf 'my wörk ж'
