#!/bin/bash
# What rs274 prints of a program is a program of canterp.so, which prints it again, byte by byte; a line that is no
# call is named with its place and what would be right; the preview reads such programs too.
exec /usr/bin/python3 run.py
