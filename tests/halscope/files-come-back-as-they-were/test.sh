#!/bin/bash
# FP-173: configurations and logs of the oscilloscope are written in the documented formats, read
# again, and every mistake in them is named by its line; logs are fit for other programs.
exec /usr/bin/python3 test.py
