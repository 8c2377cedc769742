#!/bin/bash
# See test.py.
exec /usr/bin/python3 test.py
