// SPDX-License-Identifier: GPL-2.0-or-later
component lincurve "Curve of straight lines between points";
pin in float in_ "Input.";
param rw float x_val-##[16 : personality] "X of each point, ascending.";
param rw float y_val-##[16 : personality] "Y of each point.";
pin out float out "Y of the curve at the input; beyond the ends the Y of the end.";
pin io float out_io "The same as *out*, to drive an I/O pin.";
variable int segment;
function _ "Updates the outputs.";
option extra_setup;
option period no;
description """
The personality is the number of points, 2 to 16. Their X values must ascend.
""";
license "GPL";
author "Kerf developers";
;;
EXTRA_SETUP() {
    if(personality < 2) personality = 2;
    if(personality > 16) personality = 16;
    return 0;
}
FUNCTION(_) {
    int last = personality - 1;
    double x = in_, y;
    if(x >= x_val(last)) {
        y = y_val(last);
    } else if(x <= x_val(0)) {
        y = y_val(0);
    } else {
        /* Bounded also for points that do not ascend. */
        while(segment < last - 1 && x > x_val(segment + 1)) segment++;
        while(segment > 0 && x < x_val(segment)) segment--;
        y = y_val(segment) + (x - x_val(segment)) / (x_val(segment + 1) - x_val(segment))
            * (y_val(segment + 1) - y_val(segment));
    }
    out = y;
    out_io = y;
}
