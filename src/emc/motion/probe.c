/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * probe.c - probe moves, and contacts where none is expected.
 *
 * In:     motion.probe-input, state of the planner   Out: probedPos, aborts, messages
 * Thread: servo
 * Method: a probe move latches the first edge and has all the bounce until it stands; elsewhere a
 *         contact counts when it has lasted for the filter's time.
 */
#include <math.h>
#include "motion_priv.h"

#define PROBE_SUPPRESS 1
#define PROBE_AWAY 2

static void probe_move(struct motion *m)
{
    emcmot_status_t *s = m->status;
    int away = (s->probe_type & PROBE_AWAY) != 0;
    if (!!s->probeVal == !away) {
        s->probedPos = s->carte_pos_fb;
        s->probing = 0;
        s->probeTripped = 1;
        abort_planner(m);
        m->settle = 0;
    } else if (is_inpos(m) && tpQueueDepth(&m->tp) == 0) {
        s->probedPos = s->carte_pos_fb;
        s->probing = 0;
        if (s->probe_type & PROBE_SUPPRESS) {
            s->probeTripped = 0;
        } else {
            report_error(away ? "G38.4 move finished without breaking contact."
                              : "G38.2 move finished without making contact.");
            set_motion_flag(m, EMCMOT_MOTION_ERROR_BIT, 1);
        }
    }
}

static void unexpected_contact(struct motion *m)
{
    int homing = 0, jogging = 0;
    if (!is_inpos(m) && tpQueueDepth(&m->tp) != 0) {
        int action = m->status->motionType == EMC_MOTION_TYPE_TRAVERSE ? m->config_work.probe_rapid_contact
                                                                        : m->config_work.probe_feed_contact;
        if (action == PROBE_CONTACT_WARN) {
            report_error("Probe tripped during non-probe move, which goes on.");
        } else if (action != PROBE_CONTACT_IGNORE) {
            report_error("Probe tripped during non-probe move.");
            fail_motion(m);
        }
        return;
    }
    for (int j = 0; j < all_joints(m); j++) {
        if (!is_active(&m->joint[j]))
            continue;
        if (get_homing(j) || !get_home_is_idle(j)) { /* also one that starts in this cycle */
            if (!m->config_work.inhibit_probe_home_error) {
                do_cancel_homing(j);
                homing = 1;
            }
            continue;
        }
        if (!m->config_work.inhibit_probe_jog_error && m->joint[j].free_tp.enable && m->joint[j].free_tp.active) {
            joint_stop(m, j, 0);
            jogging = 1;
        }
    }
    if (homing)
        report_error("Probe tripped during homing motion.");
    if (jogging)
        report_error("Probe tripped during a joint jog.");
    if (!m->config_work.inhibit_probe_jog_error && is_teleop(m) && axes_jogging(m)) {
        axes_abort(m, 0);
        report_error("Probe tripped during a coordinate jog.");
    }
}

static int nothing_moves(struct motion *m)
{
    return is_inpos(m) && tpQueueDepth(&m->tp) == 0 && !get_homing_is_active() && !axes_jogging(m);
}

void phase_probe(struct motion *m)
{
    int now = hal_get_bool(m->pins->probe_input);
    double before = m->probe_held, filter = m->config_work.probe_filter;
    m->status->probeVal = now;
    m->probe_held = now ? before + m->servo_period : 0.0;
    if (m->status->probing)
        m->probe_stops = 1;
    else if (is_inpos(m))
        m->probe_stops = 0;
    if (m->probe_stops) {
        m->probe_held = now ? INFINITY : 0.0;
        if (m->status->probing)
            probe_move(m);
    } else if (filter > 0.0 && now && before == 0.0 && nothing_moves(m)) {
        m->probe_held = INFINITY; /* begun at rest: no fault of the move that comes next */
    } else if (before <= filter && m->probe_held > filter) {
        unexpected_contact(m);
    }
}
