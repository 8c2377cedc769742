// SPDX-License-Identifier: GPL-2.0-or-later
component thc "Torch height control from a voltage converter";
pin in float encoder_vel "Frequency of the voltage-to-frequency converter.";
pin in float current_vel "Present velocity.";
pin in float requested_vel "Requested velocity.";
pin in float volts_requested "Arc voltage wanted.";
pin in float vel_tol "Not used; see *velocity-tol*.";
pin in bit torch_on "The torch is on.";
pin in bit arc_ok "The arc burns.";
pin in bit enable "TRUE: the height is controlled.";
pin in float z_pos_in "Commanded position of Z.";
pin out float z_pos_out "Corrected position of Z.";
pin out float z_fb_out "Position for the controller's feedback.";
pin out float volts "Arc voltage.";
pin out bit vel_status "Velocity is near the requested one.";
pin out float offset_value "Correction of the last cycle.";
param rw float vel_scale "Volts per Hz.";
param rw float scale_offset "Frequency at 0 volts.";
param rw float velocity_tol "Tolerance of the velocity, percent.";
param rw float voltage_tol "Tolerance of the voltage.";
param rw float correction_vel "Correction in a cycle.";
variable double offset;
variable double last_z;
function _ "Updates the height.";
option singleton;
option period no;
see_also "thcud(9), plasmac(9)";
license "GPL";
author "Kerf developers";
include <rtapi_math.h>;
;;
double v = (encoder_vel - scale_offset) * vel_scale;
if(v < 0) v = 0;
volts = v;
offset_value = offset;
if(enable) {
    vel_status = current_vel > 0 && current_vel >= requested_vel * (1 - velocity_tol / 100);
    if(torch_on && arc_ok && vel_status) {
        if(v + voltage_tol > volts_requested) offset -= correction_vel;
        if(v - voltage_tol < volts_requested) offset += correction_vel;
        last_z = 0;
    }
    if(!torch_on) {
        double dz = z_pos_in - last_z;
        if(dz > 0 && offset != 0) {
            if(offset > 0) offset = offset > dz ? offset - dz : 0;
            else offset += dz;
        }
        last_z = z_pos_in;
    }
    if(!isfinite(offset)) offset = 0;
    z_pos_out = z_pos_in + offset;
    z_fb_out = z_pos_in;
} else {
    z_pos_out = z_pos_in;
    z_fb_out = z_pos_in;
}
