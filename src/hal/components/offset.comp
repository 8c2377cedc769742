// SPDX-License-Identifier: GPL-2.0-or-later
component offset "Adds an offset to a command and takes it from the feedback";
pin in float offset_ "The offset.";
pin in float in_ "Command.";
pin out float out "in + offset.";
pin in float fb_in "Feedback.";
pin out float fb_out "fb-in - offset.";
function update_output "Updates *out*.";
function update_feedback "Updates *fb-out*.";
option period no;
see_also "scale(9)";
license "GPL";
author "Kerf developers";
;;
FUNCTION(update_output) {
    out = in_ + offset_;
}
FUNCTION(update_feedback) {
    fb_out = fb_in - offset_;
}
