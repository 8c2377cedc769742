// SPDX-License-Identifier: GPL-2.0-or-later
component differential "Kinematics of a differential transmission";
pin in float roll_cmd "Roll command.";
pin in float pitch_cmd "Pitch command.";
pin out float roll_fb "Roll feedback.";
pin out float pitch_fb "Pitch feedback.";
pin out float motor0_cmd "Command of motor 0: roll + pitch.";
pin out float motor1_cmd "Command of motor 1: roll - pitch.";
pin in float motor0_fb "Feedback of motor 0.";
pin in float motor1_fb "Feedback of motor 1.";
function _ "Updates commands and feedback.";
option period no;
license "GPL";
author "Kerf developers";
;;
motor0_cmd = roll_cmd + pitch_cmd;
motor1_cmd = roll_cmd - pitch_cmd;
roll_fb = (motor0_fb + motor1_fb) / 2;
pitch_fb = (motor0_fb - motor1_fb) / 2;
