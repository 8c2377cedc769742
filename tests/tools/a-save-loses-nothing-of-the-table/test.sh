#!/bin/bash
../../lib/with-comma-locale ../../task/lib/machine-test script.py -file mill.tbl
