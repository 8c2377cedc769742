#!/bin/bash
exec ../lib/machine-test script.py PYTHON.TOPLEVEL=toplevel.py PYTHON.PATH_PREPEND=. -file toplevel.py -file remap.py -file oword.py \
    $'RS274NGC.REMAP=M6 modalgroup=6 python=m6\nREMAP=M400 modalgroup=10 python=m400'
