// SPDX-License-Identifier: GPL-2.0-or-later
component threadtest "Counter to see which thread runs when";
pin out unsigned count "The count.";
function increment "Adds one to the count.";
function reset "Makes the count zero.";
option period no;
license "GPL";
author "Kerf developers";
;;
FUNCTION(increment) {
    count = count + 1;
}
FUNCTION(reset) {
    count = 0;
}
