#!/bin/bash
# A firmware with one of each kind of module: whose each pin is, and all names, types and values. They are those of
# the peer (2.9) for the same simulated board, but for what 2.10 added and names that 2.9 cuts.
printf 'show pin\nshow param\n' | ../../lib/with-hm2-board -l -b 7I80HD-16 -f full |
    grep -vE 'gpio|[.]time|tmax|packet|inmux.00.*input-(0[2-9]|1)|resolver.0[1-4]|raw[.]|watchdog[.]' |
    sed -E 's/^ *[0-9]+ +//; s/ +/ /g' | grep -E '^(bit|s32|u32|float) |IO Pin'
