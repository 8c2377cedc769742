#!/bin/bash
glue=$EMC2_HOME/nc_files/remap_lib/python-stdglue
machine() {
    ../lib/machine-test "$1" "PYTHON.TOPLEVEL=toplevel.py" "PYTHON.PATH_PREPEND=." "PYTHON.PATH_APPEND=$glue" \
        "EMCIO.TOOL_TABLE=tools.tbl" "RS274NGC.REMAP=$2" -file toplevel.py -file remap.py -file tools.tbl "${@:3}"
}
machine probe.py "M6 modalgroup=6 python=tool_probe_m6" \
    "TOOLSENSOR.X=10"$'\nY=20\nZ=0\nMAXPROBE=-90\nSEARCH_VEL=600\nPROBE_VEL=60\nPROBEHEIGHT=4' \
    -hal "loadrt wcomp names=sensor" -hal "addf sensor servo-thread" -hal "setp sensor.min -1000" -hal "setp sensor.max -500" \
    -hal "net z-pos => sensor.in" -hal "net touch sensor.out => motion.probe-input"
machine wear.py "T python=index_lathe_tool_with_wear"
