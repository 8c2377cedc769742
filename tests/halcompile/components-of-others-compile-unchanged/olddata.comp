// SPDX-License-Identifier: GPL-2.0-or-later
component olddata "Per-instance data block of the old style";
pin in float in_;
pin out float out;
param rw float gain = 1.;
function _ fp "Filters";
option data filter_state;
option extra_setup;
license "GPL";
;;
typedef struct {
    double last;
    int calls;
} filter_state;

EXTRA_SETUP()
{
    data.last = 0;
    data.calls = 0;
    return 0;
}

FUNCTION(_)
{
    data.last += (in_ - data.last) * gain;
    data.calls++;
    out = data.last;
}
