// SPDX-License-Identifier: GPL-2.0-or-later
component spindlehours """Counts the hours of a spindle

Second paragraph of the summary's place.""";
/* written for 2.8:
   pin out s32 not_here; */
pin in bit run;
pin in bit reset-total;
pin out u32 hours;
pin out u32 minutes;
pin out float total.seconds = 0.0 "All of them";
param rw float tick = 1e-3 "Length of a call, s";
param r s32 starts = 0;
variable double total;
variable hal_bit_t was_run;
variable char text[8];
function _ fp "Once a cycle";
see_also """timedelay(9)""";
notes r"""Raw \n text stays.""";
license "GPL v2 or later";
author "Somebody Else";
;;
// all of this is the body
if(reset_total) total = 0;
if(run) total += tick;
if(run && !was_run) starts++;
was_run = run;
hours = (rtapi_u32)(total / 3600);
minutes = (rtapi_u32)(total / 60) % 60;
total_seconds = total;
text[0] = 'x';
