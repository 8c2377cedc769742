// SPDX-License-Identifier: GPL-2.0-or-later
component wideio "Types of 2.10 beside the old ones";
pin in sint count_in;
pin out uint count_out = 7;
pin out si32 small;
pin in ui32 bits_in;
pin out bool any_bit = true;
pin out real share;
pin in s64 old_wide;
pin out u64 old_unsigned;
pin io bool toggle;
param rw real factor = 0.5;
param r ui32 calls = 0;
pin in real list-#[3];
function _;
option period no;
license "GPL";
;;
FUNCTION(_) {
    count_out_set((rtapi_u64)count_in + 1);
    small_set((rtapi_s32)count_in * 2);
    any_bit_set(bits_in != 0);
    share_set((list(0) + list(1) + list(2)) * factor);
    old_unsigned = (rtapi_u64)old_wide;
    toggle_set(!toggle);
    calls_set(calls + 1);
}
