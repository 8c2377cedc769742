#!/bin/bash
# A screen of somebody else, without Tk: GlCanonDraw in a context of OSMesa.
export PYOPENGL_PLATFORM=osmesa
/usr/bin/python3 -c 'from kerf import gl; gl.OffScreen(16, 16)' 2>/dev/null || { echo "PyOpenGL with OSMesa is not installed" > skip; exit 0; }
exec /usr/bin/python3 -B screen.py
