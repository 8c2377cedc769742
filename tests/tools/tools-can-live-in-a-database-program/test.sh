#!/bin/bash
exec ../../task/lib/machine-test script.py "$@" EMCIO.DB_PROGRAM=./db -file db -file db.txt
