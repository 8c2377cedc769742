#!/bin/bash
unset DISPLAY
exec xvfb-run -a /usr/bin/python3 -B script.py
