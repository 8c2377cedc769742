/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * override.c - what becomes of the feed or rapid override that the operator asked for.
 *
 * In:     overrides and what holds the path, the planner's bound for the executing move
 * Out:    status override_effective, override_cause
 * Thread: servo
 */
#include <math.h>
#include "motion_priv.h"

/* Why the path has another speed than the override asks for, before the planner's own bound. */
static enum override_cause held_by(const struct motion *m, unsigned char enables, double asked)
{
    if (hal_get_bool(m->pins->feed_inhibit))
        return EMCMOT_OVERRIDE_INHIBITED;
    if ((enables & FH_ENABLED) && hal_get_bool(m->pins->feed_hold))
        return EMCMOT_OVERRIDE_HELD;
    if (m->path_waits)
        return EMCMOT_OVERRIDE_OFFSETS;
    if ((enables & AF_ENABLED) && hal_get_real(m->pins->adaptive_feed) != 1.0)
        return EMCMOT_OVERRIDE_ADAPTIVE;
    return !(enables & FS_ENABLED) && asked != 1.0 ? EMCMOT_OVERRIDE_DISABLED : EMCMOT_OVERRIDE_FREE;
}

void override_status(struct motion *m)
{
    emcmot_status_t *s = m->status;
    double asked = s->motionType == EMC_MOTION_TYPE_TRAVERSE ? s->rapid_scale : s->feed_scale;
    s->override_effective = asked;
    s->override_cause = EMCMOT_OVERRIDE_FREE;
    if (s->motion_state != EMCMOT_MOTION_COORD)
        return;
    s->override_cause = (int)held_by(m, s->enables_queued, asked);
    s->override_effective = s->net_feed_scale;
    if (s->scale_bound == EMCMOT_OVERRIDE_SPINDLE) { /* neither override nor pause act */
        s->override_effective = 1.0;
        s->override_cause = EMCMOT_OVERRIDE_SPINDLE;
    } else if (s->paused) {
        s->override_effective = 0.0;
        s->override_cause = EMCMOT_OVERRIDE_PAUSED;
    } else if (s->override_effective > s->scale_allowed) {
        s->override_effective = s->scale_allowed;
        s->override_cause = s->scale_bound;
    }
}
