#!/bin/bash
exec ../lib/machine-test script.py "$@" EMCIO.RANDOM_TOOLCHANGER=1 -file mill.tbl
