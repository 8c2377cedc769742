#!/bin/bash
exec ../../task/lib/machine-test script.py "$@" -hal "loadusr -Wn bridge hal_bridge"
