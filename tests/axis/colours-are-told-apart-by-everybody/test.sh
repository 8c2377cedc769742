#!/bin/bash
# The colours of the preview for eyes that tell some colours not apart, and the contrast of texts in both themes.
PYTHONPATH="../../../lib/python:$PYTHONPATH" /usr/bin/python3 -B colours.py
