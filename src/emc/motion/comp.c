/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * comp.c - backlash and screw error compensation.
 *
 * In:     pos_cmd, vel_cmd of each joint; tables or BACKLASH
 * Out:    backlash_corr (wanted), backlash_filt (ramped), backlash_vel
 * Thread: servo; the table is searched from the entry of the cycle before
 * Method: trims linear between points; the wanted value is approached with half
 *         of the joint's speed and acceleration (motion.md 12).
 */
#include <float.h>
#include <math.h>
#include "motion_priv.h"

/* Entry 0 and the last one are sentinels at -DBL_MAX and DBL_MAX. */
void comp_init(emcmot_joint_t *joint)
{
    emcmot_comp_t *c = &joint->comp;
    emcmot_comp_entry_t low = {-DBL_MAX, 0, 0, 0, 0}, high = {DBL_MAX, 0, 0, 0, 0};
    c->entries = 0;
    c->entry = NULL;
    c->array[0] = low;
    c->array[1] = high;
}

int comp_add(emcmot_joint_t *joint, double nominal, double forward, double reverse)
{
    emcmot_comp_t *c = &joint->comp;
    if (c->entries >= EMCMOT_COMP_SIZE)
        return -1;
    emcmot_comp_entry_t *before = &c->array[c->entries], *new = before + 1;
    if (!(nominal > before->nominal))
        return -2;
    new[1] = *new; /* the upper sentinel */
    new->nominal = nominal;
    new->fwd_trim = (float)forward;
    new->rev_trim = (float)reverse;
    new->fwd_slope = new->rev_slope = 0.0f;
    if (c->entries == 0) { /* before the first point its trims hold */
        before->fwd_trim = new->fwd_trim;
        before->rev_trim = new->rev_trim;
    } else {
        double length = new->nominal - before->nominal;
        before->fwd_slope = (float)((new->fwd_trim - before->fwd_trim) / length);
        before->rev_slope = (float)((new->rev_trim - before->rev_trim) / length);
    }
    c->entries++;
    return 0;
}

/* Index of the entry whose interval holds pos: binary search, at most 9 steps. */
static int interval_of(const emcmot_comp_t *c, double pos)
{
    int lo = 0, hi = c->entries + 1;
    while (hi - lo > 1) {
        int mid = (lo + hi) / 2;
        if (c->array[mid].nominal <= pos)
            lo = mid;
        else
            hi = mid;
    }
    return lo;
}

static void wanted_correction(emcmot_joint_t *jt)
{
    if (jt->vel_cmd == 0.0)
        return;
    if (jt->comp.entries > 0) {
        const emcmot_comp_entry_t *e = &jt->comp.array[interval_of(&jt->comp, jt->pos_cmd)];
        double d = e->nominal == -DBL_MAX ? 0.0 : jt->pos_cmd - e->nominal;
        jt->backlash_corr = jt->vel_cmd > 0.0 ? e->fwd_trim + e->fwd_slope * d : e->rev_trim + e->rev_slope * d;
    } else {
        jt->backlash_corr = copysign(0.5 * jt->backlash, jt->vel_cmd);
    }
}

/* One cycle towards the wanted value: distance s > 0 ahead, speed v towards it. Returns the step. */
static double ramp_step(double s, double *speed, double vmax, double amax, double T, int *arrived)
{
    double v = fmax(0.0, *speed), dv = amax * T, ds_vel = v * T;
    double stop = 0.5 * (v + dv) * (v + dv) / amax;
    *arrived = 0;
    if (s <= stop + ds_vel) {
        if (v > dv) {
            *speed = v - dv;
            return ds_vel - 0.5 * dv * T;
        }
        *speed = 0.0;
        *arrived = 1;
        return s;
    }
    if (v + dv > vmax)
        dv = vmax - v;
    double ds_acc = 0.5 * dv * T;
    stop = 0.5 * (v + dv) * (v + dv) / amax;
    if (s > stop + ds_vel + ds_acc) {
        *speed = v + dv;
        return ds_vel + ds_acc;
    }
    *speed = v;
    return ds_vel;
}

static void ramp(emcmot_joint_t *jt, double scale, double T)
{
    double vmax = 0.5 * jt->vel_limit * scale, amax = 0.5 * jt->acc_limit;
    double s = jt->backlash_corr - jt->backlash_filt, dir = s >= 0.0 ? 1.0 : -1.0, v;
    int arrived;
    if (s == 0.0) {
        jt->backlash_vel = 0.0;
        return;
    }
    v = dir * jt->backlash_vel;
    if (v < 0.0) { /* the wanted value turned back: brake first */
        v = fmin(0.0, v + amax * T);
        jt->backlash_filt += dir * v * T;
        jt->backlash_vel = dir * v;
        return;
    }
    double step = ramp_step(fabs(s), &v, vmax, amax, T, &arrived);
    jt->backlash_filt = arrived ? jt->backlash_corr : jt->backlash_filt + dir * step;
    jt->backlash_vel = dir * v;
}

void phase_compensation(struct motion *m)
{
    for (int j = 0; j < all_joints(m); j++) {
        emcmot_joint_t *jt = &m->joint[j];
        if (!is_active(jt))
            continue;
        wanted_correction(jt);
        ramp(jt, m->status->net_feed_scale, m->servo_period);
    }
}
