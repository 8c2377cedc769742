#!/bin/bash
# The template tpcomp under another name, compiled by halcompile, runs a machine through task.
modules=$(dirname "$(dirname "$(command -v rtapi_app)")")/rtlib
trap 'rm -f "$modules"/kerf_test_planner.so kerf_test_planner.comp' EXIT
sed 's/^component tpcomp/component kerf_test_planner/' ../../../src/emc/tp/tpcomp.comp > kerf_test_planner.comp
halcompile --install kerf_test_planner.comp >&2 || exit 1
../../task/lib/machine-test script.py TRAJ.TPMOD=kerf_test_planner -hal "loadrt limitcheck count=3" \
    -hal "net x-pos => limitcheck.0.pos-cmd" -hal "net y-pos => limitcheck.1.pos-cmd" -hal "addf limitcheck.0 servo-thread" \
    -hal "addf limitcheck.1 servo-thread" -hal "setp limitcheck.0.max-vel 100" -hal "setp limitcheck.0.max-acc 1000" \
    -hal "setp limitcheck.1.max-vel 100" -hal "setp limitcheck.1.max-acc 1000"
