#!/bin/bash
# What the sample machines add to a mill does its work: the torch keeps its gap over a warped sheet and
# lets go where it must, the external offset follows the map, wheel and buttons move the machine.
set -e
for m in torch offsets panel; do
    echo "= $m"
    ../../task/lib/machine-test $m.py -machine $m
done
