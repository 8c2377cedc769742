// SPDX-License-Identifier: GPL-2.0-or-later
component mux16 "Selects one of sixteen floats, with debounce";
pin in bit use_graycode "The selection bits are Gray code.";
pin in bit suppress_no_input "Nothing changes while all selection bits are FALSE.";
pin in float debounce_time "Seconds that a new selection must last.";
pin in bit sel#[4] "Bits of the selection.";
pin in float in##[16] "Inputs.";
pin out float out_f "The selected input.";
pin out s32 out_s "The selected input, truncated.";
param r float elapsed "Seconds that the present change lasts.";
param r s32 selected "Selection that the bits say.";
variable int last;
variable int running;
variable double waited;
function _ "Updates the outputs.";
see_also "mux2(9), mux4(9), mux8(9), mux_generic(9)";
license "GPL";
author "Kerf developers";
include "components/real_to_int.h";
;;
int number = sel(0) + 2 * sel(1) + 4 * sel(2) + 8 * sel(3);
if(suppress_no_input && number == 0) return;
if(use_graycode) {
    number ^= number >> 2;
    number ^= number >> 1;
}
selected = number;
if(debounce_time != 0 && number != last) {
    if(!running) {
        running = 1;
        waited = 0;
    }
    if(waited < debounce_time) {
        waited += fperiod;
        elapsed = waited;
        return;
    }
    running = 0;
    last = number;
}
out_f = in(number);
out_s = real_to_s32(out_f);
