#!/bin/bash
PYTHONPATH=.. exec /usr/bin/python3 -B run.py
