// SPDX-License-Identifier: GPL-2.0-or-later
component multiclick "Counts clicks of a button";
pin in bit in_ "Button.";
pin out bit single_click "Pulse at the end of the first click.";
pin out bit single_click_only "Pulse after the first click when no second followed.";
pin out bit double_click "Pulse at the end of the second click.";
pin out bit double_click_only "Pulse after the second click when no third followed.";
pin out bit triple_click "Pulse at the end of the third click.";
pin out bit triple_click_only "Pulse after the third click when no fourth followed.";
pin out bit quadruple_click "Pulse at the end of the fourth click.";
pin out bit quadruple_click_only "Pulse after the fourth click when no fifth followed.";
pin out s32 state "State, see below.";
param rw bit invert_input = FALSE "TRUE: the button is pressed when the input is FALSE.";
param rw u32 max_hold_ns = 250000000 "Longest press that is a click.";
param rw u32 max_space_ns = 250000000 "Longest time between clicks of a series.";
param rw u32 output_hold_ns = 100000000 "Length of the pulses.";
variable rtapi_s64 timer;
variable rtapi_s64 timeout;
variable rtapi_s64 hold[8];
variable int at;
function _ "Updates the outputs.";
description """
A click is a press and release of the button. The state is 0 while idle, 2 * n - 1 while the button is
pressed for the nth time, 2 * n after it was released, and 9 while it is held too long.
""";
license "GPL";
author "Kerf developers";
;;
/* Number k of an output: click n is 2 * (n - 1), its "only" twin follows. */
static hal_bit_t *output(struct __comp_state *__comp_inst, int k) {
    hal_bit_t *pins[8] = {
        single_click_ptr, single_click_only_ptr, double_click_ptr, double_click_only_ptr,
        triple_click_ptr, triple_click_only_ptr, quadruple_click_ptr, quadruple_click_only_ptr,
    };
    return pins[k];
}
FUNCTION(_) {
    enum { IDLE = 0, RELEASED_LAST = 8, HELD = 9 };
    int pressed = (in_ != 0) != (invert_input != 0), k;
    if(at != IDLE) timer += period;
    for(k = 0; k < 8; k++) {
        if(hold[k] > period) {
            hold[k] -= period;
        } else {
            hold[k] = 0;
            *output(__comp_inst, k) = 0;
        }
    }
    if(at == HELD) {
        if(!pressed) at = IDLE;
    } else if(at % 2) {
        if(!pressed) {
            k = at - 1;
            *output(__comp_inst, k) = 1;
            hold[k] = output_hold_ns;
            at++;
            timer = 0;
            timeout = max_space_ns;
        }
    } else if(pressed) {
        at = at == RELEASED_LAST ? HELD : at + 1;
        timer = 0;
        timeout = max_hold_ns;
    }
    if(at != IDLE && at != HELD && timer > timeout) {
        if(pressed) {
            at = HELD;
        } else {
            if(at % 2 == 0) {
                k = at - 1;
                *output(__comp_inst, k) = 1;
                hold[k] = output_hold_ns;
            }
            at = IDLE;
        }
    }
    state = at;
}
