#!/bin/bash
rtlib=$(dirname "$(dirname "$(command -v rtapi_app)")")/rtlib
trap 'rm -f "$rtlib/kerf_test_stall.so"' EXIT
halcompile --install kerf_test_stall.c >&2 || exit 1
../../task/lib/machine-test script.py 'EMCMOT.EMCMOT=motmod stall_hold=20' -hal 'loadrt kerf_test_stall' \
    -hal 'addf stall servo-thread' -file remap.py -file toplevel.py PYTHON.PATH_PREPEND=. \
    PYTHON.TOPLEVEL=toplevel.py 'RS274NGC.REMAP=M400 modalgroup=10 python=stall'
