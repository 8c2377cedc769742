#!/bin/bash
exec ../../lib/with-display ../../task/lib/machine-test script.py
