/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * spindle.c - speed output and orientation of the spindles.
 *
 * In:     spindle status (commands), overrides, x position (constant surface speed)
 * Out:    spindle.N.* pins
 * Thread: servo
 */
#include <math.h>
#include "motion_priv.h"

/* The speed at an override, within the limits. */
static double speed_at(const struct motion *m, const spindle_status_t *s, double scale)
{
    double rpm = s->speed;
    if (s->css_factor != 0.0) {
        double radius = fabs(s->xoffset - m->status->carte_pos_cmd.tran.x), limit = fabs(s->speed);
        if (radius > 0.0)
            rpm = s->css_factor / radius;
        rpm *= scale;
        rpm = fmax(-limit, fmin(limit, rpm));
    } else {
        rpm *= scale;
    }
    if (rpm > 0.0)
        return fmax(s->min_pos_speed, fmin(s->max_pos_speed, rpm));
    if (rpm < 0.0)
        return fmin(s->min_neg_speed, fmax(s->max_neg_speed, rpm));
    return 0.0;
}

static void index_handshake(struct motion *m, int n)
{
    spindle_status_t *s = &m->status->spindle_status[n];
    if (s->spindle_index_enable && !m->index_was[n])
        hal_set_bool(m->pins->spindle[n].index_enable, 1);
    else if (s->spindle_index_enable && !hal_get_bool(m->pins->spindle[n].index_enable))
        s->spindle_index_enable = 0;
    else if (!s->spindle_index_enable && m->index_was[n])
        hal_set_bool(m->pins->spindle[n].index_enable, 0); /* the planner gave up: abort, disable */
    m->index_was[n] = s->spindle_index_enable;
}

void spindle_output(struct motion *m)
{
    for (int n = 0; n < m->num_spindles; n++) {
        spindle_status_t *s = &m->status->spindle_status[n];
        struct spindle_pins *p = &m->pins->spindle[n];
        double rpm = s->state ? speed_at(m, s, s->net_scale) : 0.0; /* a set speed alone turns nothing */
        s->rpm = s->state && s->speed != 0.0 ? speed_at(m, s, 1.0) : 0.0;
        hal_set_real(p->speed_out, rpm);
        hal_set_real(p->speed_out_abs, fabs(rpm));
        hal_set_real(p->speed_out_rps, rpm / 60.0);
        hal_set_real(p->speed_out_rps_abs, fabs(rpm) / 60.0);
        hal_set_real(p->speed_cmd_rps, s->speed / 60.0);
        hal_set_bool(p->on, s->state != 0);
        hal_set_bool(p->forward, rpm > 0.0);
        hal_set_bool(p->reverse, rpm < 0.0);
        hal_set_bool(p->brake, s->brake != 0);
    }
}

void spindle_inputs(struct motion *m)
{
    for (int n = 0; n < m->num_spindles; n++) {
        spindle_status_t *s = &m->status->spindle_status[n];
        const struct spindle_pins *p = &m->pins->spindle[n];
        s->spindleRevs = hal_get_real(p->revs);
        s->spindleSpeedIn = hal_get_real(p->speed_in);
        s->at_speed = hal_get_bool(p->at_speed);
        s->fault = hal_get_bool(p->amp_fault_in);
    }
}

/* End of the planner's cycle: requests for an index go out, answers come in next cycle. */
void spindle_index(struct motion *m)
{
    for (int n = 0; n < m->num_spindles; n++)
        index_handshake(m, n);
}

void spindle_orient(struct motion *m)
{
    for (int n = 0; n < m->num_spindles; n++) {
        spindle_status_t *s = &m->status->spindle_status[n];
        struct spindle_pins *p = &m->pins->spindle[n];
        if (!hal_get_bool(p->orient))
            continue;
        s->orient_fault = hal_get_si32(p->orient_fault);
        if (s->orient_fault != 0) {
            s->orient_state = EMCMOT_ORIENT_FAULTED;
            hal_set_bool(p->orient, 0);
            report_error("fault %d during orient in progress", s->orient_fault);
            m->status->commandStatus = EMCMOT_COMMAND_INVALID_COMMAND;
            fail_motion(m);
        } else if (hal_get_bool(p->is_oriented)) {
            hal_set_bool(p->orient, 0);
            hal_set_bool(p->locked, 1);
            s->locked = 1;
            s->brake = 1;
            s->orient_state = EMCMOT_ORIENT_COMPLETE;
        }
    }
}
