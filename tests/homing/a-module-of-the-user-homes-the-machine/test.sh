#!/bin/bash
# The template homecomp as it is, under another name, and as a custom module on the default homing.
modules=$(dirname "$(dirname "$(command -v rtapi_app)")")/rtlib
trap 'rm -f *.tmp "$modules"/kerf_test_home_*.so kerf_test_home_*' EXIT
source=../../../src/emc/motion/homecomp.comp
sed 's/^component homecomp/component kerf_test_home_plain/' $source > kerf_test_home_plain.comp
sed 's/^component homecomp/component kerf_test_home_custom/; s,^// #define CUSTOM_HOMEMODULE,#define CUSTOM_HOMEMODULE,' $source > kerf_test_home_custom.comp
halcompile --install kerf_test_home_plain.comp kerf_test_home_custom.comp >&2 || exit 1
../lib/run.sh
