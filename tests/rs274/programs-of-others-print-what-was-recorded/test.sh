#!/bin/bash
# Real programs of other people, read where they are: KERF_CONFORMANCE, else shared/conformance
# beside the repository.
folder=${KERF_CONFORMANCE:-../../../../shared/conformance}/rs274
exec /usr/bin/python3 ../compare.py -v "$folder/tool.tbl" "$folder/programs"
