#!/bin/bash
exec ../../task/lib/machine-test script.py "$@" EMCIO.DB_PROGRAM=./db EMCIO.RANDOM_TOOLCHANGER=1 -file db -file db.txt
