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

# What the C compiler finds, also in declarations, and what else may define a function.
cat > bad.comp <<'END'
component bad;
pin in bit a;
pin out float b = NO_START;
variable no_type_t v;
variable int n = NO_VALUE;
modparam int m = NO_DEFAULT;
option data no_data_t;
function calc;
license "GPL";
;;
FUNCTION(calc) { a = 1; }
END
LC_ALL=C halcompile --compile bad.comp 2>&1 | sed 's/; did you mean.*//' | grep -A 1 error
printf 'component bad; pin in bit a; license "GPL";\ninclude <no_header.h>;\n;;\n' > bad.comp
LC_ALL=C halcompile --compile bad.comp 2>&1 | sed 's/; did you mean.*//' | grep -A 1 error
printf 'static void calc(struct __comp_state *__comp_inst, long period);\n' > calc.h
printf 'component bad; pin in bit a; function calc; license "GPL";\n;;\n/* FUNCTION */\n#include "calc.h"\n' > bad.comp
halcompile bad.comp; echo "status $?"
printf 'component bad; pin in bit a; function f1; license "GPL";\n;;\n#define F(n) FUNCTION(f##n)\nF(1) {}\n' > bad.comp
halcompile bad.comp; echo "status $?"
