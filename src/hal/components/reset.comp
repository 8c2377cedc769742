// SPDX-License-Identifier: GPL-2.0-or-later
component reset "Sets signals to given values at an edge";
pin in bit trigger "Trigger.";
pin io unsigned out_u32 = 0 "Set to *reset-u32*.";
pin in unsigned reset_u32 = 0 "Value for *out-u32*.";
pin io signed out_s32 = 0 "Set to *reset-s32*.";
pin in signed reset_s32 = 0 "Value for *out-s32*.";
pin io float out_float = 0 "Set to *reset-float*.";
pin in float reset_float = 0 "Value for *out-float*.";
pin io bit out_bit = FALSE "Set to *reset-bit*.";
pin in bit reset_bit = FALSE "Value for *out-bit*.";
pin in bit retriggerable = TRUE "Without effect; here for compatibility.";
pin in bit rising = TRUE "Act at a rising edge of *trigger*.";
pin in bit falling = FALSE "Act at a falling edge of *trigger*.";
variable int last;
function _ "Watches the trigger.";
option period no;
license "GPL";
author "Kerf developers";
;;
int now = trigger;
if(now != last && ((now && rising) || (!now && falling))) {
    out_u32 = reset_u32;
    out_s32 = reset_s32;
    out_float = reset_float;
    out_bit = reset_bit;
}
last = now;
