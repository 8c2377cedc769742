#!/bin/bash
PYTHONDONTWRITEBYTECODE=1 exec /usr/bin/python3 test.py
