#!/bin/bash
# FP-136: while the view turns a drawing has the vertices that the driver draws in time, all over the path; then the
# exact picture comes in slices that keep nobody waiting, and is the one that is drawn at once.
/usr/bin/python3 -c 'from kerf import gl; gl.OffScreen(16, 16)' 2>/dev/null || { echo "PyOpenGL with OSMesa is not installed" > skip; exit 0; }
/usr/bin/python3 "$TEST_DIR/paced.py" 2>&1
