// SPDX-License-Identifier: GPL-2.0-or-later
component corexy_by_hal "CoreXY kinematics between joints and motors";
pin in float alpha_fb "Feedback of the alpha motor.";
pin in float beta_fb "Feedback of the beta motor.";
pin out float j0_motor_pos_fb "alpha + beta; connect to joint.0.motor-pos-fb.";
pin out float j1_motor_pos_fb "alpha - beta; connect to joint.1.motor-pos-fb.";
pin in float j0_motor_pos_cmd "Connect to joint.0.motor-pos-cmd.";
pin in float j1_motor_pos_cmd "Connect to joint.1.motor-pos-cmd.";
pin out float alpha_cmd "Command of the alpha motor: half the sum.";
pin out float beta_cmd "Command of the beta motor: half the difference.";
function _ "Updates commands and feedback.";
option period no;
license "GPL";
author "Kerf developers";
;;
j0_motor_pos_fb = alpha_fb + beta_fb;
j1_motor_pos_fb = alpha_fb - beta_fb;
alpha_cmd = 0.5 * (j0_motor_pos_cmd + j1_motor_pos_cmd);
beta_cmd = 0.5 * (j0_motor_pos_cmd - j1_motor_pos_cmd);
