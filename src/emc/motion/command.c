/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * command.c - executes the commands of the shared segment.
 *
 * In:     shared command (written by task under the command lock)
 * Out:    requests, configuration, planner queue, echo in the status
 * Thread: servo, function motion-command-handler; one command a call
 * Method: a table from code to function; each function lists its arguments.
 */
#include <math.h>
#include "command_priv.h"

/* ---- modes and run state ---- */

static void zero_interp_pins(M *m)
{
    struct motion_pins *p = m->pins;
    hal_set_real(p->interp_arc_radius, 0.0);
    for (int i = 0; i < 3; i++)
        hal_set_real(p->interp_arc_center[i], 0.0);
    hal_set_real(p->interp_heading, 0.0);
    hal_set_real(p->interp_normal_heading, 0.0);
    hal_set_bool(p->interp_iscircle, 0);
}

static void tell_atspeed_wait(M *m)
{
    if (m->tp.spindle.waiting_for_atspeed < 0)
        return;
    for (int s = 0; s < m->config_work.numSpindles; s++)
        if (m->status->spindle_status[s].state == 0 && !m->status->spindle_status[s].rests &&
            !m->status->spindle_status[s].at_speed) {
            report_error("Aborted while waiting for spindle %d at-speed after a spindle stop. "
                         "Check that spindle.%d.at-speed is connected and goes true once the spindle has stopped.",
                         s, s);
            return;
        }
}

static void cmd_abort(M *m, C *c)
{
    (void)c;
    if (m->aligning) {
        request_free(m);
    } else if (is_teleop(m)) {
        axes_abort(m, 0);
    } else if (is_coord(m)) {
        tell_atspeed_wait(m);
        tpAbort(&m->tp);
    } else {
        for (int j = 0; j < all_joints(m); j++) {
            m->joint[j].free_tp.enable = 0;
            do_cancel_homing(j); /* also of a joint whose turn has not come */
        }
    }
    set_motion_flag(m, EMCMOT_MOTION_ERROR_BIT, 0);
    for (int j = 0; j < all_joints(m); j++) {
        set_joint_flag(&m->joint[j], EMCMOT_JOINT_ERROR_BIT, 0);
        set_joint_flag(&m->joint[j], EMCMOT_JOINT_FAULT_BIT, 0);
    }
    m->status->paused = 0;
    m->status->atspeed_next_feed = 0;
    zero_interp_pins(m);
}

static void cmd_enable(M *m, C *c)
{
    (void)c;
    if (!hal_get_bool(m->pins->enable)) {
        report_error("can't enable motion, enable input is false");
        return;
    }
    m->internal->enabling = 1;
    if (m->kin_type == KINEMATICS_INVERSE_ONLY)
        m->internal->teleoperating = m->internal->coordinating = 0;
}

static void cmd_disable(M *m, C *c)
{
    (void)c;
    m->internal->enabling = 0;
    if (m->kin_type == KINEMATICS_INVERSE_ONLY)
        m->internal->teleoperating = m->internal->coordinating = 0;
}

static void cmd_pause(M *m, C *c)
{
    (void)c;
    tpPause(&m->tp);
    m->status->paused = 1;
}

static void cmd_reverse(M *m, C *c)
{
    (void)c;
    tpSetRunDir(&m->tp, TC_DIR_REVERSE);
}

static void cmd_forward(M *m, C *c)
{
    (void)c;
    tpSetRunDir(&m->tp, TC_DIR_FORWARD);
}

static void cmd_resume(M *m, C *c)
{
    (void)c;
    m->status->stepping = 0;
    tpResume(&m->tp);
    m->status->paused = 0;
}

static void cmd_step(M *m, C *c)
{
    (void)c;
    if (!m->status->paused) {
        report_error("MOTION: can't STEP while already executing");
        return;
    }
    m->internal->idForStep = m->status->id;
    m->status->stepping = 1;
    tpResume(&m->tp);
    m->status->paused = 1;
}

static void cmd_free(M *m, C *c)
{
    (void)c;
    request_free(m);
}

static void cmd_coord(M *m, C *c)
{
    (void)c;
    request_coord(m);
}

static void cmd_teleop(M *m, C *c)
{
    (void)c;
    request_teleop(m);
}

/* ---- overrides ---- */

static void cmd_spindle_scale(M *m, C *c)
{
    if (c->spindle >= 0 && c->spindle < EMCMOT_MAX_SPINDLES)
        m->status->spindle_status[c->spindle].scale = fmax(0.0, c->scale);
}

static void cmd_feed_scale(M *m, C *c) { m->status->feed_scale = fmax(0.0, c->scale); }
static void cmd_rapid_scale(M *m, C *c) { m->status->rapid_scale = fmax(0.0, c->scale); }

static void set_enable(M *m, unsigned char bit, int on)
{
    unsigned char e = m->status->enables_new;
    m->status->enables_new = (unsigned char)(on ? e | bit : e & ~bit);
}

static void cmd_ss_enable(M *m, C *c) { set_enable(m, SS_ENABLED, c->mode); }
static void cmd_fs_enable(M *m, C *c) { set_enable(m, FS_ENABLED, c->mode); }
static void cmd_fh_enable(M *m, C *c) { set_enable(m, FH_ENABLED, c->mode); }
static void cmd_af_enable(M *m, C *c) { set_enable(m, AF_ENABLED, c->flags); }

static void cmd_override_limits(M *m, C *c)
{
    m->status->overrideLimitMask = 0;
    if (c->joint >= 0)
        for (int j = 0; j < all_joints(m); j++) {
            if (joint_flag(&m->joint[j], EMCMOT_JOINT_MIN_HARD_LIMIT_BIT))
                m->status->overrideLimitMask |= 1 << (2 * j);
            if (joint_flag(&m->joint[j], EMCMOT_JOINT_MAX_HARD_LIMIT_BIT))
                m->status->overrideLimitMask |= 2 << (2 * j);
        }
    m->internal->overriding = 0;
    for (int j = 0; j < all_joints(m); j++)
        set_joint_flag(&m->joint[j], EMCMOT_JOINT_ERROR_BIT, 0);
}

/* ---- outputs ---- */

static void cmd_set_dout(M *m, C *c)
{
    if (c->now)
        dio_write(c->out, (char)c->start);
    else
        tpSetDout(&m->tp, c->out, c->start, c->end);
}

static void cmd_set_aout(M *m, C *c)
{
    if (c->now)
        aio_write(c->out, c->minLimit);
    else
        tpSetAout(&m->tp, c->out, c->minLimit, c->maxLimit);
}

/* ---- dispatch ---- */

static void (*const handlers[])(M *, C *) = {
    [EMCMOT_ABORT] = cmd_abort,
    [EMCMOT_ENABLE] = cmd_enable,
    [EMCMOT_DISABLE] = cmd_disable,
    [EMCMOT_PAUSE] = cmd_pause,
    [EMCMOT_REVERSE] = cmd_reverse,
    [EMCMOT_FORWARD] = cmd_forward,
    [EMCMOT_RESUME] = cmd_resume,
    [EMCMOT_STEP] = cmd_step,
    [EMCMOT_FREE] = cmd_free,
    [EMCMOT_COORD] = cmd_coord,
    [EMCMOT_TELEOP] = cmd_teleop,
    [EMCMOT_SPINDLE_SCALE] = cmd_spindle_scale,
    [EMCMOT_SS_ENABLE] = cmd_ss_enable,
    [EMCMOT_FEED_SCALE] = cmd_feed_scale,
    [EMCMOT_RAPID_SCALE] = cmd_rapid_scale,
    [EMCMOT_FS_ENABLE] = cmd_fs_enable,
    [EMCMOT_FH_ENABLE] = cmd_fh_enable,
    [EMCMOT_AF_ENABLE] = cmd_af_enable,
    [EMCMOT_OVERRIDE_LIMITS] = cmd_override_limits,
    [EMCMOT_SET_LINE] = cmd_set_line,
    [EMCMOT_SET_CIRCLE] = cmd_set_circle,
    [EMCMOT_CLEAR_PROBE_FLAGS] = cmd_clear_probe_flags,
    [EMCMOT_PROBE] = cmd_probe,
    [EMCMOT_RIGID_TAP] = cmd_rigid_tap,
    [EMCMOT_SET_VEL] = cmd_set_vel,
    [EMCMOT_SET_VEL_LIMIT] = cmd_set_vel_limit,
    [EMCMOT_SET_ACC] = cmd_set_acc,
    [EMCMOT_SET_JERK] = cmd_set_jerk,
    [EMCMOT_SET_PLANNER_TYPE] = cmd_set_planner_type,
    [EMCMOT_SET_SCURVE_PEAK_SCALE] = cmd_set_scurve_peak_scale,
    [EMCMOT_SET_TERM_COND] = cmd_set_term_cond,
    [EMCMOT_SET_NUM_JOINTS] = cmd_set_num_joints,
    [EMCMOT_SET_NUM_SPINDLES] = cmd_set_num_spindles,
    [EMCMOT_SET_WORLD_HOME] = cmd_set_world_home,
    [EMCMOT_SET_DEBUG] = cmd_set_debug,
    [EMCMOT_SET_DOUT] = cmd_set_dout,
    [EMCMOT_SET_AOUT] = cmd_set_aout,
    [EMCMOT_SET_SPINDLESYNC] = cmd_set_spindlesync,
    [EMCMOT_SPINDLE_ON] = cmd_spindle_on,
    [EMCMOT_SPINDLE_OFF] = cmd_spindle_off,
    [EMCMOT_SPINDLE_INCREASE] = cmd_spindle_increase,
    [EMCMOT_SPINDLE_DECREASE] = cmd_spindle_decrease,
    [EMCMOT_SPINDLE_BRAKE_ENGAGE] = cmd_spindle_brake_engage,
    [EMCMOT_SPINDLE_BRAKE_RELEASE] = cmd_spindle_brake_release,
    [EMCMOT_SPINDLE_ORIENT] = cmd_spindle_orient,
    [EMCMOT_SET_OFFSET] = cmd_set_offset,
    [EMCMOT_SET_MAX_FEED_OVERRIDE] = cmd_set_max_feed_override,
    [EMCMOT_SETUP_ARC_BLENDS] = cmd_setup_arc_blends,
    [EMCMOT_SET_PROBE_ERR_INHIBIT] = cmd_set_probe_err_inhibit,
    [EMCMOT_JOG_CONT] = cmd_jog_cont,
    [EMCMOT_JOG_INCR] = cmd_jog_incr,
    [EMCMOT_JOG_ABS] = cmd_jog_abs,
    [EMCMOT_JOG_ABORT] = cmd_jog_abort,
    [EMCMOT_JOINT_ACTIVATE] = cmd_joint_activate,
    [EMCMOT_JOINT_DEACTIVATE] = cmd_joint_deactivate,
    [EMCMOT_JOINT_HOME] = cmd_joint_home,
    [EMCMOT_JOINT_UNHOME] = cmd_joint_unhome,
    [EMCMOT_SET_JOINT_POSITION_LIMITS] = cmd_set_joint_position_limits,
    [EMCMOT_SET_JOINT_BACKLASH] = cmd_set_joint_backlash,
    [EMCMOT_SET_JOINT_MIN_FERROR] = cmd_set_joint_min_ferror,
    [EMCMOT_SET_JOINT_MAX_FERROR] = cmd_set_joint_max_ferror,
    [EMCMOT_SET_JOINT_VEL_LIMIT] = cmd_set_joint_vel_limit,
    [EMCMOT_SET_JOINT_ACC_LIMIT] = cmd_set_joint_acc_limit,
    [EMCMOT_SET_JOINT_HOMING_PARAMS] = cmd_set_joint_homing_params,
    [EMCMOT_SET_JOINT_JERK_LIMIT] = cmd_set_joint_jerk_limit,
    [EMCMOT_UPDATE_JOINT_HOMING_PARAMS] = cmd_update_joint_homing_params,
    [EMCMOT_SET_JOINT_MOTOR_OFFSET] = cmd_set_joint_motor_offset,
    [EMCMOT_SET_JOINT_COMP] = cmd_set_joint_comp,
    [EMCMOT_SET_AXIS_POSITION_LIMITS] = cmd_set_axis_position_limits,
    [EMCMOT_SET_AXIS_VEL_LIMIT] = cmd_set_axis_vel_limit,
    [EMCMOT_SET_AXIS_ACC_LIMIT] = cmd_set_axis_acc_limit,
    [EMCMOT_SET_AXIS_LOCKING_JOINT] = cmd_set_axis_locking_joint,
    [EMCMOT_SET_AXIS_JERK_LIMIT] = cmd_set_axis_jerk_limit,
    [EMCMOT_SET_SPINDLE_PARAMS] = cmd_set_spindle_params,
};

static void execute(M *m, C *c)
{
    unsigned code = (unsigned)c->command;
    answer(m, EMCMOT_COMMAND_OK);
    if (code < sizeof(handlers) / sizeof(handlers[0]) && handlers[code]) {
        handlers[code](m, c);
    } else {
        report_error("unrecognized command %d", (int)code);
        answer(m, EMCMOT_COMMAND_UNKNOWN_COMMAND);
    }
}

void motion_command_handler(void *arg, long period_ns)
{
    M *m = arg;
    emcmot_status_t *s = m->status;
    (void)period_ns;
    if (!emcmotCommandTryLock(m->shared))
        return;
    if (m->command->commandNum != s->commandNumEcho) {
        emcmotBlockBegin(&s->head);
        s->commandEcho = m->command->command;
        execute(m, m->command);
        emcmotBlockEnd(&s->head, &s->tail);
        __atomic_store_n(&s->commandNumEcho, m->command->commandNum, __ATOMIC_RELEASE);
    }
    emcmotCommandUnlock(m->shared);
}
