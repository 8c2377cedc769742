/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * jog.c - jog wheels, jog limits, stopping jogs.
 *
 * In:     jog-counts, jog-enable, jog-scale, jog-vel-mode, jog-accel-fraction
 * Out:    targets of joint planners (free mode) and axis planners (teleop)
 * Thread: servo
 * Method: counts are read in every cycle, whatever the state, so that counts
 *         turned while jogging is not allowed are never moved later (FP-062).
 */
#include <math.h>
#include "motion_priv.h"

#define MIN_FEED_SCALE 0.0001 /* below: feed hold, no wheel jogs */

void refresh_jog_limits(struct motion *m, int j)
{
    emcmot_joint_t *jt = &m->joint[j];
    double range = jt->max_pos_limit - jt->min_pos_limit;
    (void)m;
    if (get_homed(j)) {
        jt->max_jog_limit = jt->max_pos_limit;
        jt->min_jog_limit = jt->min_pos_limit;
    } else {
        jt->max_jog_limit = jt->pos_fb + range;
        jt->min_jog_limit = jt->pos_fb - range;
    }
}

void joint_stop(struct motion *m, int j, int immediate)
{
    emcmot_joint_t *jt = &m->joint[j];
    jt->free_tp.enable = 0;
    jt->kb_jjog_active = jt->wheel_jjog_active = 0;
    if (immediate)
        simple_tp_adopt(&jt->free_tp, jt->free_tp.curr_pos, 0.0, 0.0);
}

void joints_stop(struct motion *m, int immediate)
{
    for (int j = 0; j < all_joints(m); j++)
        joint_stop(m, j, immediate);
}

int any_jog_active(const struct motion *m)
{
    for (int j = 0; j < all_joints(m); j++)
        if (m->joint[j].kb_jjog_active || m->joint[j].wheel_jjog_active)
            return 1;
    return axes_jogging(m);
}

/* Fraction of the acceleration limit asked for by a wheel; outside (0, 1] the whole. */
static double accel_fraction(hal_real_t pin)
{
    double f = hal_get_real(pin);
    return f > 0.0 && f <= 1.0 ? f : 1.0;
}

/* Wheel in velocity mode: no farther than a stop from the speed limit takes. */
static double velocity_mode(double target, double from, double vel, double acc)
{
    double stop = 0.5 * vel * vel / acc;
    return fmax(from - stop, fmin(from + stop, target));
}

/* ---- joint wheels ---- */

static int joint_wheel_allowed(struct motion *m, int j, double distance)
{
    const emcmot_joint_t *jt = &m->joint[j];
    int overridden = m->status->overrideLimitMask >> (2 * j);
    if (is_extra(m, j) && get_homed(j))
        return 0; /* follows its posthome-cmd */
    if (get_home_needs_unlock_first(j)) {
        report_error("Can't wheel jog locking joint_num=%d", j);
        return 0;
    }
    if (get_home_is_synchronized(j)) {
        if (m->kin_type == KINEMATICS_IDENTITY)
            report_error("Homing is REQUIRED to wheel jog requested coordinate\n"
                         "because joint (%d) home_sequence is synchronized (%d)",
                         j, get_home_sequence(j));
        else
            report_error("Cannot wheel jog joint %d because home_sequence synchronized (%d)", j,
                         get_home_sequence(j));
        return 0;
    }
    if (distance > 0.0 && joint_flag(jt, EMCMOT_JOINT_MAX_HARD_LIMIT_BIT) && !(overridden & 2))
        return 0;
    if (distance < 0.0 && joint_flag(jt, EMCMOT_JOINT_MIN_HARD_LIMIT_BIT) && !(overridden & 1))
        return 0;
    return 1;
}

static void joint_wheel(struct motion *m, int j, int delta)
{
    emcmot_joint_t *jt = &m->joint[j];
    struct joint_pins *p = &m->pins->joint[j];
    double distance = delta * hal_get_real(p->jog_scale);
    if (!hal_get_bool(p->jog_enable) || jt->kb_jjog_active || !isfinite(distance))
        return;
    if (!joint_wheel_allowed(m, j, distance))
        return;
    refresh_jog_limits(m, j);
    double from = jt->free_tp.enable ? jt->free_tp.pos_cmd : jt->free_tp.curr_pos;
    struct joint_limits lim = joint_motion_limits(jt);
    double target = from + distance, acc = lim.acc * accel_fraction(p->jog_accel_fraction);
    if (leads_out(target, from, jt->min_jog_limit, jt->max_jog_limit))
        return;
    if (hal_get_bool(p->jog_vel_mode))
        target = velocity_mode(target, jt->pos_cmd, lim.vel * fmin(1.0, m->status->net_feed_scale), acc);
    jt->free_tp.pos_cmd = target;
    jt->free_tp.max_vel = jt->vel_limit;
    m->joint_acc_scale[j] = accel_fraction(p->jog_accel_fraction);
    jt->wheel_jjog_active = 1;
    jt->free_tp.enable = 1;
    axes_abort(m, 0);
    if (m->kin_type == KINEMATICS_INVERSE_ONLY)
        set_unhomed(m->coord_moved ? -1 : j, m->status->motion_state);
}

void phase_joint_wheels(struct motion *m)
{
    int allowed = m->status->motion_state == EMCMOT_MOTION_FREE && !hal_get_bool(m->pins->jog_inhibit) &&
                  !get_homing_is_active() && m->status->net_feed_scale >= MIN_FEED_SCALE;
    for (int j = 0; j < all_joints(m); j++) {
        emcmot_joint_t *jt = &m->joint[j];
        int counts = hal_get_si32(m->pins->joint[j].jog_counts);
        int delta = (int)((unsigned)counts - (unsigned)jt->old_jjog_counts);
        jt->old_jjog_counts = counts;
        if (delta != 0 && !m->first_pass && allowed && is_active(jt))
            joint_wheel(m, j, delta);
    }
}

/* ---- axis wheels ---- */

static void axis_wheel(struct motion *m, int n, int delta)
{
    struct axis *a = &m->axis[n];
    struct axis_pins *p = &m->pins->axis[n];
    double distance = delta * hal_get_real(p->jog_scale);
    if (!hal_get_bool(p->jog_enable) || a->kb_ajog_active || !isfinite(distance))
        return;
    if (a->locking_joint >= 0) {
        report_error("Cannot wheel jog a locking indexer AXIS_%c", "XYZABCUVW"[n]);
        return;
    }
    double from = a->teleop_tp.enable ? a->teleop_tp.pos_cmd : a->teleop_tp.curr_pos;
    double target = from + distance, fraction = accel_fraction(p->jog_accel_fraction);
    if (hal_get_bool(p->jog_vel_mode))
        target = velocity_mode(target, a->teleop_tp.curr_pos, a->vel_limit, a->acc_limit * fraction);
    if (leads_out(target, from, a->min_pos_limit, a->max_pos_limit))
        return;
    for (int j = 0; j < all_joints(m); j++)
        m->joint[j].free_tp.enable = 0;
    a->teleop_tp.pos_cmd = target;
    a->jog_vel = a->vel_limit;
    a->jog_acc_scale = fraction;
    a->wheel_ajog_active = 1;
    a->teleop_tp.enable = 1;
}

void phase_axis_wheels(struct motion *m)
{
    int allowed = m->status->motion_state == EMCMOT_MOTION_TELEOP && !hal_get_bool(m->pins->jog_inhibit) &&
                  !get_homing_is_active();
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        struct axis *a = &m->axis[n];
        int counts = hal_get_si32(m->pins->axis[n].jog_counts);
        int delta = (int)((unsigned)counts - (unsigned)a->old_ajog_counts);
        a->old_ajog_counts = counts;
        if (delta != 0 && !m->first_pass && allowed)
            axis_wheel(m, n, delta);
    }
}
