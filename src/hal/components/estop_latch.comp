// SPDX-License-Identifier: GPL-2.0-or-later
component estop_latch "Latch for an emergency stop chain";
pin in bit ok_in = TRUE "The chain before this one is ok.";
pin in bit fault_in = FALSE "A fault that trips the latch.";
pin in bit reset "A rising edge closes the latch when there is no fault.";
pin out bit ok_out = FALSE "TRUE while the latch is closed.";
pin out bit fault_out = TRUE "TRUE while the latch is open.";
pin out bit watchdog "Toggles in every cycle while *ok-out* is TRUE.";
variable int was_reset;
function _ "Updates the latch.";
option period no;
description """
The latch closes at a rising edge of *reset* while *ok-in* is TRUE and *fault-in* is FALSE, and opens as
soon as one of these changes. A reset that was TRUE before the fault went away has no effect: it must
rise again.
""";
examples """
Several latches are chained by connecting *ok-out* of one to *ok-in* of the next.
""";
license "GPL";
author "Kerf developers";
;;
int edge = reset && !was_reset;
was_reset = reset;
if(ok_in && !fault_in) {
    if(edge) {
        ok_out = 1;
        fault_out = 0;
    }
    if(ok_out) watchdog = !watchdog;
} else {
    ok_out = 0;
    fault_out = 1;
}
