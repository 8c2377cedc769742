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

void motion_controller(void *arg, long period_ns)
{
    struct motion *m = arg;
    emcmot_status_t *s = m->status;
    long long now_ns = rtapi_get_time();
    if (m->last_start_ns != 0)
        hal_set_ui32(m->pins->last_period, (rtapi_u32)(now_ns - m->last_start_ns));
    m->last_start_ns = now_ns;
    if (period_ns != m->period_ns)
        cycle_times(m, period_ns);

    emcmotBlockBegin(&s->head);
    emcmotBlockBegin(&m->internal->head);
    for (unsigned i = 0; i < sizeof(phases) / sizeof(phases[0]); i++)
        phases[i](m);
    m->first_pass = 0;
    s->heartbeat++;
    emcmotBlockEnd(&m->internal->head, &m->internal->tail);
    emcmotBlockEnd(&s->head, &s->tail);
}
