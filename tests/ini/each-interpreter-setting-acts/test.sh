#!/bin/bash
# Every setting of the INI file that the interpreter reads changes what it says it changes.
rm -rf work; mkdir work; trap 'cd ..; rm -rf work' EXIT
cd work && /usr/bin/python3 ../settings.py
