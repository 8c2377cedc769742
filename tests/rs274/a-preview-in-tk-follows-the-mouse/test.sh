#!/bin/bash
exec ../../lib/with-display /usr/bin/python3 -B screen.py
