/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * command_jog.c - jogs by keys: which are allowed, and where they go.
 *
 * In:     shared command      Out: targets of joint and axis planners
 * Thread: servo, called by command.c
 */
#include <math.h>
#include "command_priv.h"

enum jog_kind { JOG_CONT, JOG_INCR, JOG_ABS };
static const char *const jog_word[] = {"JOG_CONT", "JOG_INCR", "JOG_ABS"};

/* 1 when a jog of this joint or axis may be considered at all; else said why. */
static int jog_admissible(M *m, C *c, enum jog_kind kind)
{
    if (!is_teleop(m)) {
        if (!joint_ok(m, c->joint)) {
            rtapi_print_msg(RTAPI_MSG_ERR, "Joint jog requested for undefined joint number=%d (min=0,max=%d)",
                            c->joint, all_joints(m) - 1);
            return 0;
        }
        if (get_home_is_synchronized(c->joint) && !get_homing_is_active()) {
            if (m->kin_type == KINEMATICS_IDENTITY)
                rtapi_print_msg(RTAPI_MSG_ERR,
                                "Homing is REQUIRED to jog requested coordinate\n"
                                "because joint (%d) home_sequence is synchronized (%d)",
                                c->joint, get_home_sequence(c->joint));
            else
                rtapi_print_msg(RTAPI_MSG_ERR, "Cannot jog joint %d because home_sequence is synchronized (%d)",
                                c->joint, get_home_sequence(c->joint));
            return 0;
        }
        return 1;
    }
    if (!axis_ok(c->axis)) {
        if (c->joint >= 0)
            rtapi_print_msg(RTAPI_MSG_ERR, "%s Mode is TELEOP, cannot jog joint\n", jog_word[kind]);
        else
            rtapi_print_msg(RTAPI_MSG_ERR, "%s command.com teleop: unexpected negative axis_num\n", jog_word[kind]);
        return 0;
    }
    if (m->axis[c->axis].locking_joint >= 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "Cannot jog a locking indexer AXIS_%c,joint_num=%d", "XYZABCUVW"[c->axis],
                        m->axis[c->axis].locking_joint);
        return 0;
    }
    return 1;
}

static void mark_jog_error(M *m, C *c)
{
    if (!is_teleop(m))
        set_joint_flag(&m->joint[c->joint], EMCMOT_JOINT_ERROR_BIT, 1);
}

/* A jog further past a limit that is already exceeded? Reports it. */
static int jog_past_limit(M *m, int j, double way)
{
    const emcmot_joint_t *jt = &m->joint[j];
    int overridden = (m->status->overrideLimitMask >> (2 * j)) & 3;
    const char *word = NULL;
    if (overridden == 3)
        return 0;
    if (way > 0.0 && joint_flag(jt, EMCMOT_JOINT_MAX_HARD_LIMIT_BIT))
        word = "max hard";
    else if (way < 0.0 && joint_flag(jt, EMCMOT_JOINT_MIN_HARD_LIMIT_BIT))
        word = "min hard";
    else if (way > 0.0 && jt->pos_cmd > jt->max_jog_limit + LIMIT_EPSILON)
        word = "max soft";
    else if (way < 0.0 && jt->pos_cmd < jt->min_jog_limit - LIMIT_EPSILON)
        word = "min soft";
    if (!word)
        return 0;
    report_error("Can't jog joint %d further past %s limit.", j, word);
    return 1;
}

static void jog_joint(M *m, C *c, enum jog_kind kind)
{
    emcmot_joint_t *jt = &m->joint[c->joint];
    double target, step = c->vel > 0.0 ? c->offset : -c->offset;
    if (jt->wheel_jjog_active)
        return;
    if (is_extra(m, c->joint) && get_homed(c->joint)) {
        report_error("Cannot jog extra joint %d: it follows joint.%d.posthome-cmd", c->joint, c->joint);
        return;
    }
    if (kind != JOG_ABS && get_home_needs_unlock_first(c->joint)) {
        report_error("Can't jog locking joint_num=%d", c->joint);
        set_joint_flag(jt, EMCMOT_JOINT_ERROR_BIT, 1);
        return;
    }
    refresh_jog_limits(m, c->joint);
    double way = c->vel == 0.0 ? 0.0 : kind == JOG_CONT ? c->vel : kind == JOG_INCR ? step : c->offset - jt->pos_cmd;
    if (jog_past_limit(m, c->joint, way)) {
        set_joint_flag(jt, EMCMOT_JOINT_ERROR_BIT, 1);
        return;
    }
    switch (kind) {
    case JOG_CONT:
        target = c->vel > 0.0 ? jt->max_jog_limit : jt->min_jog_limit;
        break;
    case JOG_INCR:
        target = jt->free_tp.pos_cmd + step;
        if (leads_out(target, jt->free_tp.pos_cmd, jt->min_jog_limit, jt->max_jog_limit))
            return;
        break;
    default:
        target = fmax(jt->min_jog_limit, fmin(jt->max_jog_limit, c->offset));
        break;
    }
    jt->free_tp.pos_cmd = target;
    jt->free_tp.max_vel = fabs(c->vel);
    m->joint_acc_scale[c->joint] = 1.0;
    jt->kb_jjog_active = 1;
    jt->free_tp.enable = 1;
    if (kind != JOG_ABS)
        axes_abort(m, 0);
    set_joint_flag(jt, EMCMOT_JOINT_ERROR_BIT, 0);
    if (m->kin_type == KINEMATICS_INVERSE_ONLY)
        set_unhomed(m->coord_moved ? -1 : c->joint, m->status->motion_state);
}

static void jog_axis(M *m, C *c, enum jog_kind kind)
{
    struct axis *ax = &m->axis[c->axis];
    double target, step = c->vel > 0.0 ? c->offset : -c->offset;
    if (motion_flag(m, EMCMOT_MOTION_ERROR_BIT) || ax->wheel_ajog_active)
        return;
    switch (kind) {
    case JOG_CONT:
        target = c->vel > 0.0 ? ax->max_pos_limit : ax->min_pos_limit;
        if ((target - ax->teleop_tp.curr_pos) * c->vel < 0.0)
            return; /* beyond that limit already */
        break;
    case JOG_INCR:
        target = ax->teleop_tp.pos_cmd + step;
        if (leads_out(target, ax->teleop_tp.pos_cmd, ax->min_pos_limit, ax->max_pos_limit))
            return;
        break;
    default:
        target = fmax(ax->min_pos_limit, fmin(ax->max_pos_limit, c->offset));
        break;
    }
    for (int j = 0; j < all_joints(m); j++)
        m->joint[j].free_tp.enable = 0;
    ax->teleop_tp.pos_cmd = target;
    ax->jog_vel = fabs(c->vel);
    ax->jog_acc_scale = 1.0;
    ax->kb_ajog_active = 1;
    ax->teleop_tp.enable = 1;
}

static void jog(M *m, C *c, enum jog_kind kind)
{
    if (!jog_admissible(m, c, kind))
        return;
    if (!is_enabled(m)) {
        report_error("Can't jog joint when not enabled.");
        mark_jog_error(m, c);
        return;
    }
    if (hal_get_bool(m->pins->jog_inhibit)) {
        report_error("Cannot jog while jog-inhibit is active.");
        return;
    }
    if (get_homing_is_active()) {
        report_error(kind == JOG_INCR ? "Can't jog any joint while homing." : "Can't jog any joints while homing.");
        mark_jog_error(m, c);
        return;
    }
    if (is_teleop(m))
        jog_axis(m, c, kind);
    else if (!is_coord(m))
        jog_joint(m, c, kind);
}

void cmd_jog_cont(M *m, C *c) { jog(m, c, JOG_CONT); }
void cmd_jog_incr(M *m, C *c) { jog(m, c, JOG_INCR); }
void cmd_jog_abs(M *m, C *c) { jog(m, c, JOG_ABS); }

void cmd_jog_abort(M *m, C *c)
{
    if (is_teleop(m)) {
        if (axis_ok(c->axis))
            m->axis[c->axis].teleop_tp.enable = 0;
        return;
    }
    if (!joint_ok(m, c->joint))
        return;
    joint_stop(m, c->joint, 0);
    if (!get_home_is_idle(c->joint))
        do_cancel_homing(c->joint);
    set_joint_flag(&m->joint[c->joint], EMCMOT_JOINT_ERROR_BIT, 0);
}
