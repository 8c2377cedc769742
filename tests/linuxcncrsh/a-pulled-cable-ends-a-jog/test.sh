#!/bin/bash
exec unshare -n ../../task/lib/machine-test script.py
