/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * command_joint.c - homing requests and configuration of joints and axes.
 *
 * In:     shared command      Out: joints, axes, homing module
 * Thread: servo, called by command.c
 */
#include "command_priv.h"

/* ---- joints ---- */

void cmd_joint_activate(M *m, C *c)
{
    if (joint_ok(m, c->joint))
        set_joint_flag(&m->joint[c->joint], EMCMOT_JOINT_ACTIVE_BIT, 1);
}

void cmd_joint_deactivate(M *m, C *c)
{
    if (joint_ok(m, c->joint))
        set_joint_flag(&m->joint[c->joint], EMCMOT_JOINT_ACTIVE_BIT, 0);
}

void cmd_joint_home(M *m, C *c)
{
    if (m->status->motion_state != EMCMOT_MOTION_FREE) {
        report_error("must be in joint mode to home");
        return;
    }
    if (hal_get_bool(m->pins->homing_inhibit)) {
        report_error("Homing denied by motion.homing-inhibit joint=%d\n", c->joint);
        return;
    }
    if (get_homing_is_active()) {
        report_error("Homing not possible until current homing process is finished.\n");
        return;
    }
    if (!is_enabled(m) || c->joint >= all_joints(m))
        return;
    joints_stop(m, 0);
    do_home_joint(c->joint < 0 ? -1 : c->joint);
    m->coord_moved = 0;
}

void cmd_joint_unhome(M *m, C *c)
{
    motion_state_t state = m->status->motion_state;
    if (state != EMCMOT_MOTION_FREE && state != EMCMOT_MOTION_DISABLED) {
        report_error("must be in joint mode or disabled to unhome");
        return;
    }
    int was = get_allhomed();
    set_unhomed(c->joint, state);
    if (c->joint == -2 && was && !get_allhomed()) {
        m->internal->teleoperating = m->internal->coordinating = 0;
        set_motion_flag(m, EMCMOT_MOTION_TELEOP_BIT, 0);
        set_motion_flag(m, EMCMOT_MOTION_COORD_BIT, 0);
    }
}

void cmd_set_joint_position_limits(M *m, C *c)
{
    if (!joint_ok(m, c->joint))
        return;
    m->joint[c->joint].min_pos_limit = c->minLimit;
    m->joint[c->joint].max_pos_limit = c->maxLimit;
    config_publish(m);
}

void cmd_set_joint_backlash(M *m, C *c)
{
    if (!joint_ok(m, c->joint))
        return;
    comp_set_backlash(&m->joint[c->joint], c->backlash);
    config_publish(m);
}

void cmd_set_joint_min_ferror(M *m, C *c)
{
    if (!joint_ok(m, c->joint) || c->minFerror < 0.0)
        return;
    m->joint[c->joint].min_ferror = c->minFerror;
    config_publish(m);
}

void cmd_set_joint_max_ferror(M *m, C *c)
{
    if (!joint_ok(m, c->joint) || c->maxFerror < 0.0)
        return;
    m->joint[c->joint].max_ferror = c->maxFerror;
    config_publish(m);
}

void cmd_set_joint_vel_limit(M *m, C *c)
{
    if (!joint_ok(m, c->joint))
        return;
    m->joint[c->joint].vel_limit = c->vel;
    m->joint[c->joint].big_vel = 10.0 * c->vel;
    config_publish(m);
}

void cmd_set_joint_acc_limit(M *m, C *c)
{
    if (!joint_ok(m, c->joint))
        return;
    m->joint[c->joint].acc_limit = c->acc;
    config_publish(m);
}

void cmd_set_joint_jerk_limit(M *m, C *c)
{
    if (!joint_ok(m, c->joint))
        return;
    m->joint[c->joint].jerk_limit = c->jerk;
    config_publish(m);
}

void cmd_set_joint_homing_params(M *m, C *c)
{
    if (joint_ok(m, c->joint))
        set_joint_homing_params(c->joint, c->offset, c->home, c->home_final_vel, c->search_vel, c->latch_vel,
                                c->flags, c->home_sequence, c->volatile_home != 0);
}

void cmd_update_joint_homing_params(M *m, C *c)
{
    if (joint_ok(m, c->joint))
        update_joint_homing_params(c->joint, c->offset, c->home, c->home_sequence);
}

void cmd_set_joint_motor_offset(M *m, C *c)
{
    if (joint_ok(m, c->joint))
        m->joint[c->joint].motor_offset = c->motor_offset;
}

void cmd_set_joint_comp(M *m, C *c)
{
    if (!joint_ok(m, c->joint))
        return;
    switch (comp_add(&m->joint[c->joint], c->comp_nominal, c->comp_forward, c->comp_reverse)) {
    case -1:
        report_error("joint %d: too many compensation entries", c->joint);
        break;
    case -2:
        report_error("joint %d: compensation values must increase", c->joint);
        break;
    }
}

/* ---- axes ---- */

void cmd_set_axis_position_limits(M *m, C *c)
{
    if (!axis_ok(c->axis))
        return;
    m->axis[c->axis].min_pos_limit = c->minLimit;
    m->axis[c->axis].max_pos_limit = c->maxLimit;
    config_publish(m);
}

void cmd_set_axis_vel_limit(M *m, C *c)
{
    if (!axis_ok(c->axis))
        return;
    m->axis[c->axis].vel_limit = c->vel;
    m->axis[c->axis].ext_offset_vel_limit = c->ext_offset_vel;
    config_publish(m);
}

void cmd_set_axis_acc_limit(M *m, C *c)
{
    if (!axis_ok(c->axis))
        return;
    m->axis[c->axis].acc_limit = c->acc;
    m->axis[c->axis].ext_offset_acc_limit = c->ext_offset_acc;
    config_publish(m);
}

void cmd_set_axis_locking_joint(M *m, C *c)
{
    if (axis_ok(c->axis))
        m->axis[c->axis].locking_joint = c->joint;
}

void cmd_set_axis_jerk_limit(M *m, C *c)
{
    if (!axis_ok(c->axis))
        return;
    m->axis[c->axis].jerk_limit = c->jerk;
    config_publish(m);
}
