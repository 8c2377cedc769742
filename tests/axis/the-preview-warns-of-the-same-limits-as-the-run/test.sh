#!/bin/bash
PYTHONPATH=../lib:$PYTHONPATH exec /usr/bin/python3 -B check.py
