#!/bin/bash
glue=../the-glue-library-works-on-the-machine
for kind in 0 1; do
    echo "random changer: $kind"
    ../lib/machine-test script.py "EMCIO.RANDOM_TOOLCHANGER=$kind" -file ../random-changers-load-the-tool-that-was-called/mill.tbl -file $glue/toplevel.py -file $glue/remap.py \
        -file change.ngc -file prepare.ngc -file settool.ngc \
        PYTHON.TOPLEVEL=toplevel.py PYTHON.PATH_PREPEND=. "PYTHON.PATH_APPEND=$EMC2_HOME/nc_files/remap_lib/python-stdglue" \
        "RS274NGC.REMAP=T prolog=prepare_prolog ngc=prepare epilog=prepare_epilog
REMAP=M6 modalgroup=6 prolog=change_prolog ngc=change epilog=change_epilog
REMAP=M61 modalgroup=6 prolog=settool_prolog ngc=settool epilog=settool_epilog"
done
