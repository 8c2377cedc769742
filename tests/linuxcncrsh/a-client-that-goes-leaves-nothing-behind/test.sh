#!/bin/bash
exec ../../task/lib/machine-test script.py
