#!/bin/bash
# Each test pattern of hm2_test but one is a firmware with one fault: the board is refused with a text that names it.
for pattern in {0..15}; do
    echo "pattern $pattern"
    printf 'loadrt hostmot2\nloadrt hm2_test test_pattern=%d\n' "$pattern" > t.hal
    halrun -f t.hal 2>&1 | grep -E '^hm2' | grep -vE 'loading|unloading|IO Pin'
done
echo "the good one, in full"
all="debug_idrom=1 debug_module_descriptors=1 debug_pin_descriptors=1 debug_modules=1"
printf 'loadrt hostmot2 %s\nloadrt hm2_test test_pattern=12\n' "$all" > t.hal
halrun -f t.hal 2>&1 | grep -E '^hm2/' | grep -vE '(pin|Pin) 0?(0[2-9]|[2-9]|1[0-9]|2[0-9])'
echo "a simulated board's modules and their registers"
printf 'setp %%.raw.dump_state 1\nwait 0.01\nget %%.raw.dump_state\n' | ../../lib/with-hm2-board > t.out
grep -v dump_state t.out; grep dump_state t.out     # two streams: in an order that does not depend on them
rm -f t.hal t.out
