/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * command_priv.h - what the files of the command handler share. command.c has the table from code
 * to function; each function lists the arguments of its command (motion.md 4). Context: [servo].
 */
#ifndef KERF_COMMAND_PRIV_H
#define KERF_COMMAND_PRIV_H

#include "motion_priv.h"

typedef struct motion M;
typedef const emcmot_command_t C;

static inline void answer(M *m, cmd_status_t status) { m->status->commandStatus = status; }
static inline int joint_ok(const M *m, int j) { return j >= 0 && j < all_joints(m); }
static inline int axis_ok(int a) { return a >= 0 && a < EMCMOT_MAX_AXIS; }

void cmd_set_line(M *m, C *c);
void cmd_set_circle(M *m, C *c);
void cmd_clear_probe_flags(M *m, C *c);
void cmd_probe(M *m, C *c);
void cmd_rigid_tap(M *m, C *c);
void cmd_set_vel(M *m, C *c);
void cmd_set_vel_limit(M *m, C *c);
void cmd_set_acc(M *m, C *c);
void cmd_set_jerk(M *m, C *c);
void cmd_set_planner_type(M *m, C *c);
void cmd_set_scurve_peak_scale(M *m, C *c);
void cmd_set_term_cond(M *m, C *c);
void cmd_set_num_joints(M *m, C *c);
void cmd_set_num_spindles(M *m, C *c);
void cmd_set_world_home(M *m, C *c);
void cmd_set_debug(M *m, C *c);
void cmd_set_max_feed_override(M *m, C *c);
void cmd_setup_arc_blends(M *m, C *c);
void cmd_set_probe_err_inhibit(M *m, C *c);
void cmd_set_offset(M *m, C *c);
void cmd_set_spindlesync(M *m, C *c);
void cmd_spindle_on(M *m, C *c);
void cmd_spindle_off(M *m, C *c);
void cmd_spindle_increase(M *m, C *c);
void cmd_spindle_decrease(M *m, C *c);
void cmd_spindle_brake_engage(M *m, C *c);
void cmd_spindle_brake_release(M *m, C *c);
void cmd_spindle_orient(M *m, C *c);
void cmd_set_spindle_params(M *m, C *c);
void cmd_jog_cont(M *m, C *c);
void cmd_jog_incr(M *m, C *c);
void cmd_jog_abs(M *m, C *c);
void cmd_jog_abort(M *m, C *c);
void cmd_joint_activate(M *m, C *c);
void cmd_joint_deactivate(M *m, C *c);
void cmd_joint_home(M *m, C *c);
void cmd_joint_unhome(M *m, C *c);
void cmd_set_joint_position_limits(M *m, C *c);
void cmd_set_joint_backlash(M *m, C *c);
void cmd_set_joint_min_ferror(M *m, C *c);
void cmd_set_joint_max_ferror(M *m, C *c);
void cmd_set_joint_vel_limit(M *m, C *c);
void cmd_set_joint_acc_limit(M *m, C *c);
void cmd_set_joint_jerk_limit(M *m, C *c);
void cmd_set_joint_homing_params(M *m, C *c);
void cmd_update_joint_homing_params(M *m, C *c);
void cmd_set_joint_motor_offset(M *m, C *c);
void cmd_set_joint_comp(M *m, C *c);
void cmd_set_axis_position_limits(M *m, C *c);
void cmd_set_axis_vel_limit(M *m, C *c);
void cmd_set_axis_acc_limit(M *m, C *c);
void cmd_set_axis_locking_joint(M *m, C *c);
void cmd_set_axis_jerk_limit(M *m, C *c);

#endif
