#!/bin/bash
# FP-136: while the view turns a drawing has the vertices that the driver draws in time, all over the path; then the
# exact picture comes in slices that keep nobody waiting, and is the one that is drawn at once.
/usr/bin/python3 "$TEST_DIR/paced.py" 2>&1
