// SPDX-License-Identifier: GPL-2.0-or-later
component joint_axis_mapper "Names the axis whose joint has a fault";
modparam dummy coord = XYZABCUVWXYZABCUVW "Axis letters of the joints.";
pin out bit dummy "Not used.";
function _ "Watches the faults.";
option singleton;
option rtapi_app no;
option period no;
description """
For each letter of *coord* there is a pin jam.L-fault and a pin jam.L-fault-latched; the second joint of a letter has
jam.L2-fault, and so on. When a fault begins, a message names the axis.
""";
license "GPL";
author "Kerf developers";
include <rtapi_ctype.h>;
;;
#define MAX_JOINTS 16

static char *coord = "XYZABCUVWXYZABCUVW";
RTAPI_MP_STRING(coord, "axis letters of the joints");

static struct joint {
    hal_bool_t fault, latched;
    char letter;
} *joints;
static int count;

static int add_joint(char letter) {
    struct joint *j = &joints[count];
    char number[8] = "";
    int i, same = 1, r;
    if(count >= MAX_JOINTS) return 0;
    if(!strchr("XYZABCUVW", toupper((unsigned char)letter))) {
        rtapi_print_msg(RTAPI_MSG_ERR, "Joint Axis Mapper - %c axis not found in coord string\n", letter);
        return -EINVAL;
    }
    for(i = 0; i < count; i++)
        same += toupper((unsigned char)joints[i].letter) == toupper((unsigned char)letter);
    if(same > 1) rtapi_snprintf(number, sizeof number, "%d", same);
    j->letter = letter;
    r = hal_pin_new_bool(comp_id, HAL_IN, &j->fault, 0, "jam.%c%s-fault", letter, number);
    if(r) return r;
    r = hal_pin_new_bool(comp_id, HAL_OUT, &j->latched, 0, "jam.%c%s-fault-latched", letter, number);
    if(r) return r;
    count++;
    return 0;
}

int rtapi_app_main(void) {
    const char *at;
    char prefix[] = "joint_axis_mapper";
    int r;
    comp_id = hal_init("joint_axis_mapper");
    if(comp_id < 0) return comp_id;
    joints = hal_malloc((long)sizeof *joints * MAX_JOINTS);
    r = joints ? export(prefix, 0) : -ENOMEM;
    for(at = coord; !r && *at; at++)
        if(!strchr(" ;{},\n\t\"'", *at)) r = add_joint(*at);
    if(r) {
        hal_exit(comp_id);
        return r;
    }
    return hal_ready(comp_id);
}

void rtapi_app_exit(void) {
    hal_exit(comp_id);
}

FUNCTION(_) {
    int i;
    for(i = 0; i < count; i++) {
        struct joint *j = &joints[i];
        int fault = hal_get_bool(j->fault);
        if(fault && !hal_get_bool(j->latched))
            rtapi_print_msg(RTAPI_MSG_ERR, "%c Axis fault detected\n", j->letter);
        hal_set_bool(j->latched, fault);
    }
}
