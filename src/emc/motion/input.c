/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * input.c - pins to state: spindles, scales, joint feedback, pose from feedback.
 *
 * In:     pins, homing state       Out: status, joints
 * Thread: servo
 */
#include <math.h>
#include "motion_priv.h"

/* Adaptive feed: returns the factor and chooses the direction of run. */
static double adaptive_factor(struct motion *m)
{
    double in = hal_get_real(m->pins->adaptive_feed), max = m->config_work.maxFeedScale;
    if (!isfinite(in))
        return 0.0;
    in = fmax(-max, fmin(max, in));
    if (in < 0.0 && m->tp.reverse_run == TC_DIR_FORWARD && tpSetRunDir(&m->tp, TC_DIR_REVERSE) != TP_ERR_OK)
        return 0.0;
    if (in > 0.0 && m->tp.reverse_run == TC_DIR_REVERSE && tpSetRunDir(&m->tp, TC_DIR_FORWARD) != TP_ERR_OK)
        return 0.0;
    return fabs(in);
}

static void scales(struct motion *m)
{
    emcmot_status_t *s = m->status;
    unsigned char enables = s->motion_state == EMCMOT_MOTION_COORD ? s->enables_queued : s->enables_new;
    double scale = 1.0;
    if (s->motion_state != EMCMOT_MOTION_FREE && (enables & FS_ENABLED))
        scale *= s->motionType == EMC_MOTION_TYPE_TRAVERSE ? s->rapid_scale : s->feed_scale;
    if (enables & AF_ENABLED)
        scale *= adaptive_factor(m);
    if ((enables & FH_ENABLED) && hal_get_bool(m->pins->feed_hold))
        scale = 0.0;
    if (hal_get_bool(m->pins->feed_inhibit))
        scale = 0.0;
    s->net_feed_scale = scale;
    for (int n = 0; n < m->num_spindles; n++) {
        spindle_status_t *sp = &s->spindle_status[n];
        sp->net_scale = enables & SS_ENABLED ? sp->scale : 1.0;
        if (hal_get_bool(m->pins->spindle[n].inhibit))
            sp->net_scale = 0.0;
    }
}

static void joint_input(struct motion *m, int j)
{
    emcmot_joint_t *jt = &m->joint[j];
    const struct joint_pins *p = &m->pins->joint[j];
    double fb = hal_get_real(p->motor_pos_fb);
    jt->motor_pos_fb = fb;
    if (get_homing_at_index_search_wait(j) && !get_index_enable(j))
        jt->pos_fb = jt->pos_cmd; /* the encoder was reset under way */
    else
        jt->pos_fb = fb - (jt->backlash_filt + jt->motor_offset);
    jt->ferror = is_extra(m, j) && get_homed(j) ? 0.0 : jt->pos_cmd - jt->pos_fb;
    if (fabs(jt->ferror) > jt->ferror_high_mark)
        jt->ferror_high_mark = fabs(jt->ferror);
    jt->ferror_limit = jt->vel_limit > 0.0 ? jt->max_ferror * fabs(jt->vel_cmd) / jt->vel_limit : 0.0;
    if (jt->ferror_limit < jt->min_ferror)
        jt->ferror_limit = jt->min_ferror;
    /* written so that a feedback that is no number is an error too */
    set_joint_flag(jt, EMCMOT_JOINT_FERROR_BIT, !(fabs(jt->ferror) <= jt->ferror_limit));
    jt->on_pos_limit = hal_get_bool(p->pos_lim_sw_in);
    jt->on_neg_limit = hal_get_bool(p->neg_lim_sw_in);
    set_joint_flag(jt, EMCMOT_JOINT_MAX_HARD_LIMIT_BIT, jt->on_pos_limit);
    set_joint_flag(jt, EMCMOT_JOINT_MIN_HARD_LIMIT_BIT, jt->on_neg_limit);
    set_joint_flag(jt, EMCMOT_JOINT_FAULT_BIT, hal_get_bool(p->amp_fault_in));
}

void jogs_end(struct motion *m, int immediate)
{
    for (int j = 0; j < kin_joints(m); j++)
        joint_stop(m, j, immediate);
    axes_abort(m, immediate);
    if (!immediate)
        for (int n = 0; n < EMCMOT_MAX_AXIS; n++)
            m->axis[n].kb_ajog_active = m->axis[n].wheel_ajog_active = 0;
}

static void jog_stop(struct motion *m)
{
    int immediate = hal_get_bool(m->pins->jog_stop_immediate);
    if (!m->jog_was_active || !(immediate || hal_get_bool(m->pins->jog_stop)))
        return;
    jogs_end(m, immediate);
    report_error(immediate ? "Jog aborted by jog-stop-immediate" : "Jog aborted by jog-stop");
}

void phase_inputs(struct motion *m)
{
    spindle_inputs(m);
    scales(m);
    for (int j = 0; j < all_joints(m); j++)
        if (is_active(&m->joint[j]))
            joint_input(m, j);
    spindle_orient(m);
    jog_stop(m);
}

void phase_forward(struct motion *m)
{
    double q[EMCMOT_MAX_JOINTS];
    emcmot_status_t *s = m->status;
    for (int j = 0; j < EMCMOT_MAX_JOINTS; j++)
        q[j] = m->joint[j].pos_fb;
    switch (m->kin_type) {
    case KINEMATICS_IDENTITY:
        kinematics_forward(m, q, &s->carte_pos_fb);
        s->carte_pos_fb_ok = get_allhomed();
        break;
    case KINEMATICS_BOTH:
        if (get_allhomed()) {
            if (!s->carte_pos_fb_ok)
                s->carte_pos_fb = s->world_home;
            s->carte_pos_fb_ok = kinematics_forward(m, q, &s->carte_pos_fb) >= 0;
        } else {
            s->carte_pos_fb_ok = 0;
        }
        break;
    case KINEMATICS_INVERSE_ONLY:
        if (is_coord(m) || is_teleop(m)) {
            s->carte_pos_fb = s->carte_pos_cmd;
            s->carte_pos_fb_ok = 1;
        } else {
            s->carte_pos_fb_ok = 0;
        }
        break;
    default:
        s->carte_pos_fb_ok = 0;
        break;
    }
}
