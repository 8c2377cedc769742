/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * cycle.c - the servo cycle: a fixed list of phases.
 *
 * In:     pins, requests of the command handler   Out: pins, status
 * Thread: servo, function motion-controller
 */
#include "motion_priv.h"

static void phase_homing_inputs(struct motion *m) { read_homing_in_pins(all_joints(m)); }
static void phase_homing_outputs(struct motion *m) { write_homing_out_pins(all_joints(m)); }

static void (*const phases[])(struct motion *) = {
    phase_homing_inputs, phase_switch_kinematics, phase_inputs,       phase_forward,      phase_probe,
    phase_faults,        phase_mode,              phase_joint_wheels, phase_axis_wheels,  phase_homing,
    phase_planner_type,  phase_position,          phase_compensation, phase_eoffset,      spindle_index,
    phase_output,        phase_homing_outputs,    phase_status,
};

/* The computer stood still for t s. Where the motors are is known by the drives at most: the program is held as by a
 * pause, jogs end, and task tells the operator. */
static void stall_hold(struct motion *m, double t)
{
    emcmot_status_t *s = m->status;
    s->stalls++;
    s->stall_time = t;
    s->stall_ended = STALL_NOTHING;
    if (s->motion_state == EMCMOT_MOTION_COORD && tpQueueDepth(&m->tp) > 0) {
        tpPause(&m->tp);
        s->paused = 1;
        s->stall_ended = STALL_PROGRAM;
    }
    if (m->jog_was_active) {
        jogs_end(m, 0);
        s->stall_ended = STALL_JOG;
    }
}

/* How late this cycle began, or motion in it. Not so after threads were stopped on purpose. */
static long long late_ns(long long now_ns)
{
    struct rtapi_lateness l = {.last_ns = 0};
    rtapi_task_lateness(rtapi_task_self(), &l);
    long long under_way = now_ns - rtapi_task_pll_get_reference();
    return l.last_ns > under_way ? l.last_ns : under_way;
}

void motion_controller(void *arg, long period_ns)
{
    struct motion *m = arg;
    emcmot_status_t *s = m->status;
    long long now_ns = rtapi_get_time();
    long long since_ns = m->last_start_ns != 0 ? now_ns - m->last_start_ns : 0;
    if (m->last_start_ns != 0)
        hal_set_ui32(m->pins->last_period, (rtapi_u32)since_ns);
    m->last_start_ns = now_ns;
    if (period_ns != m->period_ns)
        cycle_times(m, period_ns);

    emcmotBlockBegin(&s->head);
    emcmotBlockBegin(&m->internal->head);
    if (m->stall_hold_ns > 0 && since_ns > m->stall_hold_ns && late_ns(now_ns) > m->stall_hold_ns)
        stall_hold(m, (double)since_ns * 1e-9);
    for (unsigned i = 0; i < sizeof(phases) / sizeof(phases[0]); i++)
        phases[i](m);
    m->first_pass = 0;
    s->heartbeat++;
    emcmotBlockEnd(&m->internal->head, &m->internal->tail);
    emcmotBlockEnd(&s->head, &s->tail);
}
