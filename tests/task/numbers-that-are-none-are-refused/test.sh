#!/bin/bash
exec ../lib/machine-test script.py
