#!/bin/bash
# Each test pattern of hm2_test but one is a firmware with one fault: the board is refused with a text that names it.
for pattern in {0..15}; do
    echo "pattern $pattern"
    printf 'loadrt hostmot2\nloadrt hm2_test test_pattern=%d\n' "$pattern" > t.hal
    halrun -f t.hal 2>&1 | grep -E '^hm2' | grep -vE 'loading|unloading|IO Pin'
done
rm -f t.hal
