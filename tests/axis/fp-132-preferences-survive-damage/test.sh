#!/bin/bash
PYTHONPATH="../../../lib/python:$PYTHONPATH" /usr/bin/python3 -B damage.py
