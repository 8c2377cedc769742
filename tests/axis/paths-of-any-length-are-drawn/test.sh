#!/bin/bash
# FP-135, FP-136: levels of detail stay within their tolerance and budget; picking; thinned paths; endless programs.
/usr/bin/python3 "$TEST_DIR/levels.py" 2>&1 | grep -v 'parameter file is empty'
rm -f *.ngc var*
