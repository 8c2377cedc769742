#!/bin/bash
../lib/machine-test script.py
../lib/machine-test retained.py RS274NGC.FEATURES=1
