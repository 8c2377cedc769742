// SPDX-License-Identifier: GPL-2.0-or-later
component newstyle "Types of 2.10";
pin in real in_ = 2.5;
pin in bool on = true;
pin out real out;
pin out sint count;
pin out ui32 bits-#[2];
pin io si32 both;
param rw real k = 2.0 "Gain";
param r uint n;
function _;
option period no;
license "GPL";
;;
if(on) out_set(in_ * k);
count_set(count + 1);
bits_set(1, bits(1) | 6);
both_set(both - 1);
n_set(n + 1);
