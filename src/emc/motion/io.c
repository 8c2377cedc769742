/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * io.c - synchronised outputs and rotary locks, for commands, planner and homing.
 *
 * In, out: pins of motion_priv.h   Thread: servo
 */
#include "motion_priv.h"

void dio_write(int index, char value)
{
    struct motion *m = &motion_state_;
    if (index < 0 || index >= m->config_work.numDIO) {
        rtapi_print_msg(RTAPI_MSG_ERR,
                        "ERROR: index out of range, %d not in [0..%d] (increase num_dio/EMCMOT_MAX_DIO=%d)\n",
                        index, m->config_work.numDIO, EMCMOT_MAX_DIO);
        return;
    }
    hal_set_bool(m->pins->digital_out[index], value != 0);
}

void aio_write(int index, double value)
{
    struct motion *m = &motion_state_;
    if (index < 0 || index >= m->config_work.numAIO) {
        rtapi_print_msg(RTAPI_MSG_ERR,
                        "ERROR: index out of range, %d not in [0..%d] (increase num_aio/EMCMOT_MAX_AIO=%d)\n",
                        index, m->config_work.numAIO, EMCMOT_MAX_AIO);
        return;
    }
    hal_set_real(m->pins->analog_out[index], value);
}

/* A joint's unlock pin exists. */
static int has_lock(const struct motion *m, int joint)
{
    return joint >= 0 && joint < m->num_joints && m->pins->joint[joint].unlock;
}

void rotary_unlock(int joint, int unlock)
{
    struct motion *m = &motion_state_;
    if (!has_lock(m, joint)) {
        report_error("emcmotSetRotaryUnlock(): No unlock pin configured for joint %d\n"
                     "   Use motmod parameter: unlock_joints_mask=%X",
                     joint, 1u << (joint & 31));
        return;
    }
    hal_set_bool(m->pins->joint[joint].unlock, unlock != 0);
}

int rotary_is_unlocked(int joint)
{
    static int told;
    struct motion *m = &motion_state_;
    if (!has_lock(m, joint)) {
        if (!told)
            report_error("emcmotGetRotaryUnlocked(): No unlock pin configured for joint %d\n"
                         "   Use motmod parameter: unlock_joints_mask=%X'",
                         joint, 1u << (joint & 31));
        told = 1;
        return 0;
    }
    return hal_get_bool(m->pins->joint[joint].is_unlocked);
}
