#!/bin/bash
exec ../lib/machine-test script.py "RS274NGC.REMAP=M400 modalgroup=10 ngc=broken
REMAP = M401 modalgroup=10 python=raises
REMAP = M402 modalgroup=10 argspec=P ngc=needs" "RS274NGC.USER_M_PATH=." "PYTHON.TOPLEVEL=top.py" "PYTHON.PATH_PREPEND=." -file broken.ngc -file needs.ngc -file top.py -file remap.py -file M120
