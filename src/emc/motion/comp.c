/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * comp.c - backlash and screw error compensation.
 *
 * In:     pos_cmd, vel_cmd of each joint; tables or BACKLASH
 * Out:    backlash_corr (wanted), backlash_filt (what is added to the command), backlash_vel
 * Thread: servo; the table is searched in at most 9 steps
 * Method: trims linear between points (motion.md 12); the wanted value is approached by a
 *         planner of its own. A joint with compensation gives it a share of its limits and
 *         plans its motion with the rest (joint_motion_limits()), so that both together stay
 *         within them: compensation neither steps nor stops the path.
 */
#include <float.h>
#include <math.h>
#include "motion_priv.h"

#define SHARE 0.1        /* of a joint's acceleration and jerk for compensation, where there is any */
#define MOST_VEL 0.5     /* of its velocity: only a table steeper than that would need more */
#define SLOPE_MARGIN 1.1 /* for catching up with a table's slope at full speed */
#define STILL 1e-7       /* units/s: speeds below are rounding of kinematics, no direction */
#define REVERSAL 1e-5    /* units, and */
#define LAST_CYCLES 0.3  /* of a cycle's jerk: ways back below both are the last cycles of a stop, no reversal */

/* Entry 0 and the last one are sentinels at -DBL_MAX and DBL_MAX. */
void comp_init(emcmot_joint_t *joint)
{
    emcmot_comp_t *c = &joint->comp;
    emcmot_comp_entry_t low = {-DBL_MAX, 0, 0, 0, 0}, high = {DBL_MAX, 0, 0, 0, 0};
    c->entries = 0;
    c->entry = NULL;
    c->swing = c->slope = 0.0;
    c->shared = c->direction = 0;
    c->back = 0.0;
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
    c->swing = fmax(c->swing, fabs(forward) + fabs(reverse));
    c->slope = fmax(c->slope, fmax(fabs(before->fwd_slope), fabs(before->rev_slope)));
    return 0;
}

/* ---- shares of the limits ---- */

void comp_set_backlash(emcmot_joint_t *joint, double backlash)
{
    joint->backlash = backlash;
    joint->comp.swing = fmax(joint->comp.swing, fabs(backlash)); /* the way back to less is as long */
}

static struct joint_limits comp_limits(const emcmot_joint_t *jt)
{
    struct joint_limits l = {0.0, SHARE * jt->acc_limit, SHARE * jt->jerk_limit};
    /* a way s from rest to rest never gets faster than sqrt(s a) */
    l.vel = fmin(MOST_VEL * jt->vel_limit,
                 sqrt(jt->comp.swing * l.acc) + SLOPE_MARGIN * jt->comp.slope * jt->vel_limit);
    return l;
}

struct joint_limits joint_motion_limits(const emcmot_joint_t *jt)
{
    struct joint_limits l = {jt->vel_limit, jt->acc_limit, jt->jerk_limit};
    if (!jt->comp.shared)
        return l;
    struct joint_limits c = comp_limits(jt);
    l.vel -= c.vel;
    l.acc -= c.acc;
    l.jerk -= c.jerk;
    return l;
}

/* A share is taken while nothing moves, and kept until there is nothing left to compensate. */
static void share_limits(const struct motion *m, emcmot_joint_t *jt)
{
    int wanted = jt->comp.entries > 0 || jt->backlash != 0.0 || jt->backlash_filt != 0.0;
    if (wanted == jt->comp.shared)
        return;
    if (!wanted || !is_enabled(m) || (is_inpos(m) && !axes_moving(m) && !eoffsets_moving(m)))
        jt->comp.shared = wanted;
}

/* ---- the cycle ---- */

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

static int direction_of(emcmot_joint_t *jt, double T)
{
    emcmot_comp_t *c = &jt->comp;
    double way = jt->vel_cmd * T;
    if (c->direction == 0)
        c->direction = way > 0.0 ? 1 : -1;
    c->back = fmax(0.0, c->back - c->direction * way);
    if (c->back > fmax(REVERSAL, LAST_CYCLES * jt->jerk_limit * T * T * T)) {
        c->direction = -c->direction;
        c->back = 0.0;
    }
    return c->direction;
}

static void wanted_correction(emcmot_joint_t *jt, double T)
{
    if (fabs(jt->vel_cmd) < STILL)
        return;
    int direction = direction_of(jt, T);
    if (jt->comp.entries > 0) {
        const emcmot_comp_entry_t *e = &jt->comp.array[interval_of(&jt->comp, jt->pos_cmd)];
        double d = e->nominal == -DBL_MAX ? 0.0 : jt->pos_cmd - e->nominal;
        jt->backlash_corr = direction > 0 ? e->fwd_trim + e->fwd_slope * d : e->rev_trim + e->rev_slope * d;
    } else {
        jt->backlash_corr = 0.5 * direction * jt->backlash;
    }
}

/* While no motor follows, nothing is corrected: the position that is shown would run away from the slide. */
static void rest(emcmot_joint_t *jt)
{
    simple_tp_adopt(&jt->comp.tp, jt->backlash_filt, 0.0, 0.0);
    jt->backlash_corr = jt->backlash_filt;
    jt->backlash_vel = 0.0;
}

/* One cycle towards the wanted value; a hold of the feed holds it too. */
static void approach(emcmot_joint_t *jt, double scale, double T)
{
    struct joint_limits l = comp_limits(jt);
    simple_tp_t *tp = &jt->comp.tp;
    tp->max_vel = l.vel * fmin(1.0, scale);
    tp->max_acc = l.acc;
    tp->max_jerk = l.jerk;
    tp->pos_cmd = jt->backlash_corr;
    tp->enable = scale > 0.0;
    simple_tp_update(tp, T);
    jt->backlash_filt = tp->curr_pos;
    jt->backlash_vel = tp->curr_vel;
}

void phase_compensation(struct motion *m)
{
    for (int j = 0; j < all_joints(m); j++) {
        emcmot_joint_t *jt = &m->joint[j];
        if (!is_active(jt))
            continue;
        share_limits(m, jt);
        if (!is_enabled(m)) {
            rest(jt);
            continue;
        }
        wanted_correction(jt, m->servo_period);
        if (jt->comp.shared)
            approach(jt, get_homing(j) ? 1.0 : m->status->net_feed_scale,
                     m->servo_period); /* no override slows homing */
    }
}
