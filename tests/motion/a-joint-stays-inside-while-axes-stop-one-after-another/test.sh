#!/bin/bash
exec ../lib/bench-test script.py
