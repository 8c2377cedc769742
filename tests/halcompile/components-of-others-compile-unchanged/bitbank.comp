// SPDX-License-Identifier: GPL-2.0-or-later
component bitbank "Bits by personality: low 5 bits how many, 0x100 with parity, 0x200 with sum";
pin in bit in-##[16 : personality & 0x1f] "Inputs";
pin out bit parity if personality & 0x100;
pin out s32 sum = -1 if (personality & 0x200) != 0 && personality > 3;
param rw bit invert-#[2 : (personality & 0x400) ? 2 : 1];
pin out unsigned mask;
option extra_setup;
option extra_cleanup yes;
option default_personality 4;
function update;
function clear;
license "GPL";
include <rtapi_string.h>;
;;
static int instances;

EXTRA_SETUP() {
    (void)extra_arg;
    if(strlen(prefix) > 40) return -EINVAL;
    if((personality & 0x1f) > 16) return -EINVAL;
    instances++;
    return 0;
}

EXTRA_CLEANUP() { instances = 0; }

FUNCTION(update) {
    int i, n = 0;
    unsigned m = 0;
    for(i = 0; i < (personality & 0x1f); i++) {
        if(in(i) != invert(0)) {
            n++;
            m |= 1u << i;
        }
    }
    mask = m;
    if(personality & 0x100) parity = n & 1;
    if(personality & 0x200) sum = n;
}

FUNCTION(clear) { mask = 0; }
