#!/bin/bash
# Every type, lists, any-section queries, ranges, listing; exit statuses.
q() { inivalue "$@" sample.ini 2>&1; echo "=> $?"; }
q --var=VERSION --sec=EMC
q -V A -y i
q -V B -y i
q -V C
q -a -V HALFILE
q -V HALFILE -N 2
q -V FLAG -y b
q -V FLAG -y b -b
q -V FLAG -y b -B
q -e
q -o -c -p
q -V NO -S EMC
q -V NO -S EMC -q
q -V A -y r -m 1 -M 5000
q -V A -y i -M 5
inivar -var HALFILE -num 2 -ini sample.ini; echo "=> $?"
inivar -sec EMC 2>&1; echo "=> $?"
