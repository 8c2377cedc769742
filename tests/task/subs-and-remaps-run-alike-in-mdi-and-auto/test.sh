#!/bin/bash
exec ../lib/machine-test script.py "RS274NGC.REMAP=M6 modalgroup=6 ngc=change" -file change.ngc
