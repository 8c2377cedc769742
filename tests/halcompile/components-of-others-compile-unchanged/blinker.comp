// SPDX-License-Identifier: GPL-2.0-or-later
component blinker """Toggles an output

Give the half period in seconds.""";
pin out bit out;
pin in float half-period = 0.5 "s";
param rw bit enable = true if personality & 1;
variable float elapsed;
variable int state = true;
option extra_setup yes;
option extra_cleanup;
function update;
see_also "siggen(9)";
notes "Uses \\fIfperiod\\fR.";
description "A blinker";
license "GPL";
include <rtapi_math.h>;
;;
static int setups;

EXTRA_SETUP() {
    setups++;
    personality = 1;
    return 0;
}

EXTRA_CLEANUP() {
    setups = 0;
}

FUNCTION(update) {
    if(!enable) return;
    elapsed += fperiod;
    if(elapsed + 1e-9 < half_period) return;
    elapsed = fmod(elapsed, half_period);
    state = !state;
    out = state ? TRUE : FALSE;
}
