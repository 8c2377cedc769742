/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * command_spindle.c - spindle commands.
 *
 * In:     shared command      Out: commanded state of spindles, orientation pins
 * Thread: servo, called by command.c
 */
#include <math.h>
#include "command_priv.h"

/* First and behind-last spindle of a command; reports and answers when there is none. */
static int spindle_range(M *m, C *c, int *first, int *end, const char *what)
{
    if (c->spindle == ALL_SPINDLES) {
        *first = 0;
        *end = m->num_spindles;
        return 1;
    }
    if (c->spindle < 0 || c->spindle >= m->config_work.numSpindles) {
        if (what[0] == '!')
            report_error("%s", what + 1);
        else
            report_error("Attempt to %s <%d>%s", what, c->spindle,
                         c->command == EMCMOT_SPINDLE_DECREASE ? "." : "");
        answer(m, EMCMOT_COMMAND_INVALID_COMMAND);
        return 0;
    }
    *first = c->spindle;
    *end = c->spindle + 1;
    return 1;
}

/* The commanded speed within the spindle's limits; 0 stays 0. */
static double limit_speed(const spindle_status_t *s, double rpm)
{
    if (rpm > 0.0)
        return fmax(s->min_pos_speed, fmin(s->max_pos_speed, rpm));
    if (rpm < 0.0)
        return fmin(s->min_neg_speed, fmax(s->max_neg_speed, rpm));
    return 0.0;
}

void cmd_set_spindlesync(M *m, C *c) { tpSetSpindleSync(&m->tp, c->spindle, c->spindlesync, c->flags); }

/* An order that a spindle obeys already: what waited for its speed has done so. */
static int same_order(const spindle_status_t *s, C *c)
{
    return s->state && c->state && s->speed == limit_speed(s, c->vel) &&
           s->css_factor == c->ini_maxvel && s->xoffset == c->acc;
}

void cmd_spindle_on(M *m, C *c)
{
    int s, end, changed = 0;
    if (!spindle_range(m, c, &s, &end, "!Attempt to start non-existent spindle"))
        return;
    for (; s < end; s++) {
        spindle_status_t *sp = &m->status->spindle_status[s];
        changed |= !same_order(sp, c);
        if (c->state) { /* a speed alone leaves an orientation as it is */
            hal_set_bool(m->pins->spindle[s].orient, 0);
            hal_set_bool(m->pins->spindle[s].locked, 0);
            sp->locked = 0;
            sp->orient_state = EMCMOT_ORIENT_NONE;
            sp->rests = 0;
        } else if (sp->state) {
            sp->rests = 1;
        }
        sp->state = c->state;
        sp->speed = limit_speed(sp, c->vel);
        if (c->vel != 0.0 && sp->speed == 0.0 && c->state)
            report_error("spindle %d stays at rest: its limit in this direction is 0 rpm "
                         "([SPINDLE_%d]MAX_%s_VELOCITY)",
                         s, s, c->vel > 0.0 ? "FORWARD" : "REVERSE");
        sp->css_factor = c->ini_maxvel;
        sp->xoffset = c->acc;
        if (c->state) {
            sp->direction = c->vel >= 0.0 ? 1 : -1;
            sp->brake = 0;
        }
    }
    if (changed)
        m->status->atspeed_next_feed = c->wait_for_spindle_at_speed;
}

void cmd_spindle_off(M *m, C *c)
{
    int s, end;
    if (!spindle_range(m, c, &s, &end, "stop non-existent spindle"))
        return;
    for (; s < end; s++) {
        spindle_status_t *sp = &m->status->spindle_status[s];
        sp->rests = !c->wait_for_spindle_at_speed;
        sp->state = 0;
        sp->speed = 0.0;
        sp->direction = 0;
        sp->brake = 1;
        sp->locked = 0;
        sp->orient_state = EMCMOT_ORIENT_NONE;
        hal_set_bool(m->pins->spindle[s].orient, 0);
        hal_set_bool(m->pins->spindle[s].locked, 0);
    }
    m->status->atspeed_next_feed = c->wait_for_spindle_at_speed;
}

void cmd_spindle_increase(M *m, C *c)
{
    int s, end;
    if (!spindle_range(m, c, &s, &end, "increase non-existent spindle"))
        return;
    for (; s < end; s++) {
        spindle_status_t *sp = &m->status->spindle_status[s];
        if (sp->speed > 0.0)
            sp->speed += sp->increment;
        else if (sp->speed < 0.0)
            sp->speed -= sp->increment;
        sp->speed = limit_speed(sp, sp->speed);
    }
}

void cmd_spindle_decrease(M *m, C *c)
{
    int s, end;
    if (!spindle_range(m, c, &s, &end, "decrease non-existent spindle"))
        return;
    for (; s < end; s++) {
        spindle_status_t *sp = &m->status->spindle_status[s];
        if (fabs(sp->speed) > sp->increment)
            sp->speed -= copysign(sp->increment, sp->speed);
        sp->speed = limit_speed(sp, sp->speed);
    }
}

void cmd_spindle_brake_engage(M *m, C *c)
{
    int s, end;
    if (!spindle_range(m, c, &s, &end, "engage brake of non-existent spindle"))
        return;
    for (; s < end; s++) {
        m->status->spindle_status[s].speed = 0.0;
        m->status->spindle_status[s].direction = 0;
        m->status->spindle_status[s].brake = 1;
    }
}

void cmd_spindle_brake_release(M *m, C *c)
{
    int s, end;
    if (!spindle_range(m, c, &s, &end, "release brake of non-existent spindle"))
        return;
    for (; s < end; s++)
        m->status->spindle_status[s].brake = 0;
}

void cmd_spindle_orient(M *m, C *c)
{
    int s, end;
    if (!spindle_range(m, c, &s, &end, "orient non-existent spindle"))
        return;
    for (; s < end; s++) {
        spindle_status_t *sp = &m->status->spindle_status[s];
        struct spindle_pins *p = &m->pins->spindle[s];
        sp->orient_state = EMCMOT_ORIENT_IN_PROGRESS;
        sp->speed = 0.0;
        sp->direction = 0;
        sp->brake = 0;
        sp->state = 0;
        sp->rests = 1;
        sp->locked = 0;
        hal_set_bool(p->on, 0);
        hal_set_real(p->orient_angle, c->orientation);
        hal_set_si32(p->orient_mode, c->mode);
        hal_set_bool(p->locked, 0);
        hal_set_bool(p->orient, 1);
    }
}

void cmd_set_spindle_params(M *m, C *c)
{
    if (c->spindle < 0 || c->spindle >= m->num_spindles) {
        report_error("Attempt to configure non-existent spindle");
        answer(m, EMCMOT_COMMAND_INVALID_COMMAND);
        return;
    }
    spindle_status_t *s = &m->status->spindle_status[c->spindle];
    s->max_pos_speed = c->maxLimit;
    s->max_neg_speed = c->minLimit;
    s->min_pos_speed = c->min_pos_speed;
    s->min_neg_speed = c->max_neg_speed;
    s->home_search_vel = c->search_vel;
    s->home_angle = c->home;
    s->home_sequence = c->home_sequence;
    s->increment = c->offset;
}
