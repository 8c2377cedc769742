#!/bin/bash
# A screen of somebody else, without Tk: GlCanonDraw in a context of OSMesa.
export PYOPENGL_PLATFORM=osmesa
exec /usr/bin/python3 -B screen.py
