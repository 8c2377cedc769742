// SPDX-License-Identifier: GPL-2.0-or-later
component message "Shows a message when a bit changes";
modparam dummy messages "Texts, one per instance, at most 16, separated by commas.";
pin in bit trigger = FALSE "Shows the message at the edge that *edge* says.";
pin in bit force = FALSE "Rising: shows the message again if *trigger* is as after its edge.";
param rw bit edge = TRUE "TRUE: rising edge; FALSE: falling edge.";
variable int index;
variable int last_trigger;
variable int last_force;
variable int last_edge;
function _ "Watches the trigger.";
option extra_setup;
option post_export;
option period no;
description """
The message is printed as an error message of the realtime system, so user interfaces show it.

This component is deprecated in favour of pushmsg.
""";
examples """
----
loadrt message names=oil,air messages="Oil level is low,Air pressure is low"
addf oil servo-thread
----
""";
see_also "pushmsg(9)";
license "GPL";
author "Kerf developers";
;;
#define MAX_MESSAGES 16
static char *messages[MAX_MESSAGES];
RTAPI_MP_ARRAY_STRING(messages, MAX_MESSAGES, "texts of the messages");

EXTRA_SETUP() {
    if(extra_arg < 0 || extra_arg >= MAX_MESSAGES) {
        rtapi_print_msg(RTAPI_MSG_ERR, "Count of names= is outside the allowable range 0..%d\n", MAX_MESSAGES - 1);
        return -EINVAL;
    }
    if(!messages[extra_arg]) {
        rtapi_print_msg(RTAPI_MSG_ERR, "Message string for index %ld missing\n", extra_arg);
        return -EINVAL;
    }
    return 0;
}

POST_EXPORT() {
    index = (int)extra_arg;
    last_force = 1;
    last_edge = 1;
    return 0;
}

FUNCTION(_) {
    int trig = trigger != 0, forced = force != 0, rising = edge != 0, show = 0;
    if(rising != last_edge) {
        last_edge = rising;
        last_trigger = !rising;
    }
    if(forced != last_force) {
        last_force = forced;
        if(forced && trig == rising) show = 1;
    }
    if(trig != last_trigger) {
        last_trigger = trig;
        if(trig == rising) show = 1;
    }
    if(show) rtapi_print_msg(RTAPI_MSG_ERR, "%s\n", messages[index]);
}
