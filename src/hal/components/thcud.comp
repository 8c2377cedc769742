// SPDX-License-Identifier: GPL-2.0-or-later
component thcud "Torch height control from up and down inputs";
pin in bit torch_up "Raise the torch.";
pin in bit torch_down "Lower the torch.";
pin in float current_vel "Present velocity.";
pin in float requested_vel "Requested velocity.";
pin in bit torch_on "The torch is on.";
pin in bit arc_ok "The arc burns.";
pin in bit enable "TRUE: the height is controlled.";
pin in float z_pos_in "Commanded position of Z.";
pin out float z_pos_out "Corrected position of Z.";
pin out float z_fb_out "Position for the controller's feedback.";
pin out float cur_offset "Present correction.";
pin out bit vel_status "Velocity is near the requested one.";
pin out bit removing_offset "The correction is being taken away.";
param rw float velocity_tol "Tolerance of the velocity, percent.";
pin in float correction_vel "Correction in a cycle.";
variable double offset;
variable double last_z;
function _ "Updates the height.";
option singleton;
option period no;
see_also "thc(9), plasmac(9)";
license "GPL";
author "Kerf developers";
include <rtapi_math.h>;
;;
if(enable) {
    vel_status = current_vel > 0 && current_vel >= requested_vel * (1 - velocity_tol / 100);
    if(torch_on && arc_ok && vel_status) {
        if(torch_down) offset -= correction_vel;
        if(torch_up) offset += correction_vel;
        last_z = 0;
    }
    if(!torch_on) {
        double dz = z_pos_in - last_z;
        removing_offset = 0;
        if(dz > 0 && offset != 0) {
            removing_offset = 1;
            if(offset > 0) offset = offset > dz ? offset - dz : 0;
            else offset += dz;
        }
        last_z = z_pos_in;
    }
    if(!isfinite(offset)) offset = 0;
    z_pos_out = z_pos_in + offset;
    z_fb_out = z_pos_in;
} else {
    z_pos_out = z_pos_in + offset;
    z_fb_out = z_pos_in;
}
cur_offset = offset;
