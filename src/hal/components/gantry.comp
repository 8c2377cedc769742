// SPDX-License-Identifier: GPL-2.0-or-later
component gantry "Joints that together move one axis, homed one by one";
pin out float joint.##.pos_cmd[7 : personality] "Command of each joint.";
pin in float joint.##.pos_fb[7 : personality] "Feedback of each joint.";
pin in bit joint.##.home[7 : personality] "Home switch of each joint.";
pin out float joint.##.offset[7 : personality] "Offset of each joint, found by homing.";
pin in float position_cmd "Command of the axis.";
pin out float position_fb "Feedback of the axis.";
pin out bit home "All joints are on their switches; while leaving them, at least one is.";
pin out bit limit "At least one joint is on its switch.";
pin in float search_vel "Search velocity of homing; its sign tells the direction.";
variable int latching;
variable int fb_joint;
variable double last_cmd;
function read "Updates *position-fb*, *home* and *limit*.";
function write "Updates the commands.";
option extra_setup;
option period no;
description """
The personality is the number of joints, 1 to 7.

This component is deprecated: the motion controller homes gantries itself.
""";
license "GPL";
author "Kerf developers";
;;
EXTRA_SETUP() {
    if(personality < 1) {
        rtapi_print_msg(RTAPI_MSG_ERR, "gantry: personality must be >= 1 (the number of joints)\n");
        return -EINVAL;
    }
    return 0;
}

FUNCTION(read) {
    int i, all = joint_home(0), any = joint_home(0);
    for(i = 1; i < personality; i++) {
        all = latching ? all || joint_home(i) : all && joint_home(i);
        latching = all;
        any = any || joint_home(i);
    }
    home = all;
    limit = any;
    if(joint_home(fb_joint) && !all) {
        for(i = 0; i < personality; i++) {
            if(joint_home(i)) continue;
            position_fb = joint_pos_fb(i) + joint_offset(i);
            fb_joint = i;
            break;
        }
    } else {
        position_fb = joint_pos_fb(fb_joint) + joint_offset(fb_joint);
    }
}

FUNCTION(write) {
    int i;
    double delta = position_cmd - last_cmd;
    last_cmd = position_cmd;
    if(delta * search_vel > 0 && !home)
        for(i = 0; i < personality; i++) if(joint_home(i)) joint_offset(i) += delta;
    for(i = 0; i < personality; i++) joint_pos_cmd(i) = position_cmd - joint_offset(i);
}
