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
#include <stdlib.h>
#include "motion_priv.h"

typedef struct motion M;
typedef const emcmot_command_t C;

static void answer(M *m, cmd_status_t status) { m->status->commandStatus = status; }

static int joint_ok(const M *m, int j) { return j >= 0 && j < all_joints(m); }
static int axis_ok(int a) { return a >= 0 && a < EMCMOT_MAX_AXIS; }

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
        if (m->status->spindle_status[s].state == 0 && !m->status->spindle_status[s].at_speed) {
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

/* ---- moves ---- */

static int on_hard_limit(const M *m)
{
    for (int j = 0; j < all_joints(m); j++)
        if (is_active(&m->joint[j]) &&
            joint_flag(&m->joint[j], EMCMOT_JOINT_MAX_HARD_LIMIT_BIT | EMCMOT_JOINT_MIN_HARD_LIMIT_BIT))
            return 1;
    return 0;
}

/* Preconditions of a move; 0 when refused, then answered and reported. */
static int move_allowed(M *m, C *c, const char *word, const char *kind)
{
    if (!is_coord(m) || !is_enabled(m)) {
        report_error("need to be enabled, in coord mode for %s", word);
        answer(m, EMCMOT_COMMAND_INVALID_COMMAND);
        set_motion_flag(m, EMCMOT_MOTION_ERROR_BIT, 1);
        return 0;
    }
    if (c->command == EMCMOT_SET_CIRCLE ? !arc_in_range(m, c) : !in_range(m, &c->pos, c->id, kind)) {
        if (c->command == EMCMOT_SET_LINE)
            report_error("invalid params in linear command");
        answer(m, EMCMOT_COMMAND_INVALID_PARAMS);
        fail_motion(m);
        return 0;
    }
    if (on_hard_limit(m)) {
        report_error("can't do %s with limits exceeded", word);
        answer(m, EMCMOT_COMMAND_INVALID_PARAMS);
        fail_motion(m);
        return 0;
    }
    return 1;
}

/* Takes the at-speed barrier for a move of this type; re-arms it on a rapid under constant surface speed. */
static int take_atspeed(M *m, C *c)
{
    int waits = m->status->atspeed_next_feed;
    switch (c->motion_type) {
    case EMC_MOTION_TYPE_FEED:
    case EMC_MOTION_TYPE_ARC:
    case EMC_MOTION_TYPE_PROBING:
        m->status->atspeed_next_feed = 0;
        return waits;
    case EMC_MOTION_TYPE_TRAVERSE:
    case EMC_MOTION_TYPE_TOOLCHANGE:
    case EMC_MOTION_TYPE_INDEXROTARY:
        if (c->spindle >= 0 && c->spindle < EMCMOT_MAX_SPINDLES &&
            m->status->spindle_status[c->spindle].css_factor != 0.0)
            m->status->atspeed_next_feed = 1;
        return 0;
    default:
        rtapi_print_msg(RTAPI_MSG_ERR, "Internal error: unhandled motion type %d\n", c->motion_type);
        return 0;
    }
}

/* A move was queued: seen at once by who reads the status after the echo. */
static void move_queued(M *m)
{
    set_motion_flag(m, EMCMOT_MOTION_ERROR_BIT, 0);
    set_motion_flag(m, EMCMOT_MOTION_INPOS_BIT, 0);
    m->status->depth = tpQueueDepth(&m->tp);
    m->queue_end = m->command->pos;
    m->settle = 0;
}

static void cmd_set_line(M *m, C *c)
{
    if (!move_allowed(m, c, "linear move", "Linear"))
        return;
    int armed = m->status->atspeed_next_feed, atspeed = take_atspeed(m, c);
    int indexer = c->motion_type == EMC_MOTION_TYPE_INDEXROTARY ? c->turn : -1;
    tpSetId(&m->tp, c->id);
    int r = tpAddLine(&m->tp, c->pos, c->motion_type, c->vel, c->ini_maxvel, c->acc, c->ini_maxjerk,
                      m->status->enables_new, (char)atspeed, indexer, c->tag);
    if (r < 0) {
        report_error("can't add linear move at line %d, error code %d", c->id, r);
        answer(m, EMCMOT_COMMAND_BAD_EXEC);
        fail_motion(m);
    } else if (r > 0) {
        if (atspeed)
            m->status->atspeed_next_feed = armed;
    } else {
        move_queued(m);
        m->coord_moved = 1;
    }
}

static void cmd_set_circle(M *m, C *c)
{
    if (!move_allowed(m, c, "circular move", "Circular"))
        return;
    int atspeed = m->status->atspeed_next_feed;
    m->status->atspeed_next_feed = 0;
    tpSetId(&m->tp, c->id);
    int r = tpAddCircle(&m->tp, c->pos, c->center, c->normal, c->turn, c->motion_type, c->vel, c->ini_maxvel,
                        c->acc, c->ini_maxjerk, m->status->enables_new, (char)atspeed, c->tag);
    if (r < 0) {
        report_error("can't add circular move at line %d, error code %d", c->id, r);
        answer(m, EMCMOT_COMMAND_BAD_EXEC);
        fail_motion(m);
    } else if (r > 0) {
        m->status->atspeed_next_feed |= atspeed;
    } else {
        move_queued(m);
        m->coord_moved = 1;
    }
}

static void cmd_clear_probe_flags(M *m, C *c)
{
    (void)c;
    m->status->probing = 0;
    m->status->probeTripped = 0;
}

#define PROBE_SUPPRESS 1 /* probe_type: no error when nothing happens */
#define PROBE_AWAY 2     /* contact is to be lost */

static void cmd_probe(M *m, C *c)
{
    if (!move_allowed(m, c, "probe move", "Probe"))
        return;
    int away = (c->probe_type & PROBE_AWAY) != 0;
    if (!(c->probe_type & PROBE_SUPPRESS) && !!hal_get_bool(m->pins->probe_input) == !away) {
        report_error(away ? "Probe is already clear when starting G38.4 or G38.5 move"
                          : "Probe is already tripped when starting G38.2 or G38.3 move");
        answer(m, EMCMOT_COMMAND_BAD_EXEC);
        fail_motion(m);
        return;
    }
    int atspeed = m->status->atspeed_next_feed;
    m->status->atspeed_next_feed = 0;
    tpSetId(&m->tp, c->id);
    int r = tpAddLine(&m->tp, c->pos, c->motion_type, c->vel, c->ini_maxvel, c->acc, c->ini_maxjerk,
                      m->status->enables_new, (char)atspeed, -1, c->tag);
    if (r < 0) {
        report_error("can't add probe move");
        answer(m, EMCMOT_COMMAND_BAD_EXEC);
        fail_motion(m);
        return;
    }
    m->status->probing = 1;
    m->status->probe_type = c->probe_type;
    move_queued(m);
    m->coord_moved = 1;
}

static void cmd_rigid_tap(M *m, C *c)
{
    if (!move_allowed(m, c, "rigid tap move", "Rigid tap"))
        return;
    tpSetId(&m->tp, c->id);
    int r = tpAddRigidTap(&m->tp, c->pos, c->vel, c->ini_maxvel, c->acc, c->ini_maxjerk, m->status->enables_new,
                          c->scale, c->tag);
    if (r < 0) {
        m->status->atspeed_next_feed = 0;
        report_error("can't add rigid tap move at line %d, error code %d", c->id, r);
        fail_motion(m);
    } else {
        move_queued(m);
    }
}

/* ---- planner settings ---- */

static void cmd_set_vel(M *m, C *c)
{
    m->status->vel = c->vel;
    tpSetVmax(&m->tp, c->vel, c->ini_maxvel);
}

static void cmd_set_vel_limit(M *m, C *c)
{
    m->config_work.limitVel = c->vel;
    tpSetVlimit(&m->tp, c->vel);
    config_publish(m);
}

static void cmd_set_acc(M *m, C *c)
{
    m->status->acc = c->acc;
    tpSetAmax(&m->tp, c->acc);
}

static void cmd_set_jerk(M *m, C *c) { m->status->jerk = c->jerk; }

static void cmd_set_planner_type(M *m, C *c)
{
    int type = c->planner_type == 1;
    if (type == 1 && m->status->jerk < 1.0) {
        report_error("S-curve planner refused: no usable jerk limit - set [TRAJ]MAX_LINEAR_JERK and per-axis "
                     "[AXIS_*]MAX_JERK");
        return;
    }
    if (tpIsDone(&m->tp) && tpQueueDepth(&m->tp) == 0) {
        m->status->planner_type = type;
        m->pending_planner_type = -1;
    } else if (type == m->status->planner_type) {
        m->pending_planner_type = -1;
    } else {
        if (m->pending_planner_type != type)
            report_error("planner switch deferred until queued motion completes (requested type %d)", type);
        m->pending_planner_type = type;
    }
}

static void cmd_set_scurve_peak_scale(M *m, C *c)
{
    m->status->scurve_peak_scale = fmax(0.1, fmin(1.0, c->scurve_peak_scale));
}

static void cmd_set_term_cond(M *m, C *c) { tpSetTermCond(&m->tp, c->termCond, c->tolerance); }

static void cmd_set_num_joints(M *m, C *c)
{
    if (c->joint < 1 || c->joint > EMCMOT_MAX_JOINTS)
        return;
    /* pins exist for the joints of the module */
    m->config_work.numJoints = c->joint < m->num_joints ? c->joint : m->num_joints;
    config_publish(m);
}

static void cmd_set_num_spindles(M *m, C *c)
{
    if (c->spindle < 1 || c->spindle > m->num_spindles) {
        report_error("Problem:\n  motmod configured for %d spindles\n  but command requests %d spindles\n"
                     "  Using: %d spindles",
                     m->num_spindles, c->spindle, m->num_spindles);
        m->config_work.numSpindles = m->num_spindles;
    } else {
        m->config_work.numSpindles = c->spindle;
    }
    config_publish(m);
}

static void cmd_set_world_home(M *m, C *c) { m->status->world_home = c->pos; }

static void cmd_set_debug(M *m, C *c)
{
    m->config_work.debug = c->debug;
    config_publish(m);
}

static void cmd_set_max_feed_override(M *m, C *c)
{
    m->config_work.maxFeedScale = c->maxFeedScale;
    config_publish(m);
}

static void cmd_setup_arc_blends(M *m, C *c)
{
    emcmot_config_t *w = &m->config_work;
    w->arcBlendEnable = c->arcBlendEnable;
    w->arcBlendFallbackEnable = c->arcBlendFallbackEnable;
    w->arcBlendOptDepth = c->arcBlendOptDepth;
    w->arcBlendGapCycles = c->arcBlendGapCycles;
    w->arcBlendRampFreq = c->arcBlendRampFreq;
    w->arcBlendTangentKinkRatio = c->arcBlendTangentKinkRatio;
    config_publish(m);
}

static void cmd_set_probe_err_inhibit(M *m, C *c)
{
    m->config_work.inhibit_probe_jog_error = c->probe_jog_err_inhibit;
    m->config_work.inhibit_probe_home_error = c->probe_home_err_inhibit;
    config_publish(m);
}

static void cmd_set_offset(M *m, C *c)
{
    m->status->tool_offset = c->tool_offset;
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

/* ---- spindles ---- */

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

static void cmd_set_spindlesync(M *m, C *c) { tpSetSpindleSync(&m->tp, c->spindle, c->spindlesync, c->flags); }

static void cmd_spindle_on(M *m, C *c)
{
    int s, end;
    if (!spindle_range(m, c, &s, &end, "!Attempt to start non-existent spindle"))
        return;
    for (; s < end; s++) {
        spindle_status_t *sp = &m->status->spindle_status[s];
        hal_set_bool(m->pins->spindle[s].orient, 0);
        hal_set_bool(m->pins->spindle[s].locked, 0);
        sp->locked = 0;
        sp->orient_state = EMCMOT_ORIENT_NONE;
        sp->state = c->state;
        sp->speed = limit_speed(sp, c->vel);
        sp->css_factor = c->ini_maxvel;
        sp->xoffset = c->acc;
        if (c->state) {
            sp->direction = c->vel >= 0.0 ? 1 : -1;
            sp->brake = 0;
        }
    }
    m->status->atspeed_next_feed = c->wait_for_spindle_at_speed;
}

static void cmd_spindle_off(M *m, C *c)
{
    int s, end;
    if (!spindle_range(m, c, &s, &end, "stop non-existent spindle"))
        return;
    for (; s < end; s++) {
        spindle_status_t *sp = &m->status->spindle_status[s];
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

static void cmd_spindle_increase(M *m, C *c)
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

static void cmd_spindle_decrease(M *m, C *c)
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

static void cmd_spindle_brake_engage(M *m, C *c)
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

static void cmd_spindle_brake_release(M *m, C *c)
{
    int s, end;
    if (!spindle_range(m, c, &s, &end, "release brake of non-existent spindle"))
        return;
    for (; s < end; s++)
        m->status->spindle_status[s].brake = 0;
}

static void cmd_spindle_orient(M *m, C *c)
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
        sp->locked = 0;
        hal_set_bool(p->on, 0);
        hal_set_real(p->orient_angle, c->orientation);
        hal_set_si32(p->orient_mode, c->mode);
        hal_set_bool(p->locked, 0);
        hal_set_bool(p->orient, 1);
    }
}

static void cmd_set_spindle_params(M *m, C *c)
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

/* ---- jogs ---- */

enum jog_kind { JOG_CONT, JOG_INCR, JOG_ABS };
static const char *const jog_word[] = {"JOG_CONT", "JOG_INCR", "JOG_ABS"};

/* 1 when a jog of this joint or axis may be considered at all; else said why. */
static int jog_admissible(M *m, C *c, enum jog_kind kind)
{
    if (!is_teleop(m)) {
        if (!joint_ok(m, c->joint)) {
            rtapi_print_msg(RTAPI_MSG_ERR, "Joint jog requested for undefined joint number=%d (min=0,max=%d)",
                            c->joint, all_joints(m) - 1);
            return 0;
        }
        if (get_home_is_synchronized(c->joint) && !get_homing_is_active()) {
            if (m->kin_type == KINEMATICS_IDENTITY)
                rtapi_print_msg(RTAPI_MSG_ERR,
                                "Homing is REQUIRED to jog requested coordinate\n"
                                "because joint (%d) home_sequence is synchronized (%d)",
                                c->joint, get_home_sequence(c->joint));
            else
                rtapi_print_msg(RTAPI_MSG_ERR, "Cannot jog joint %d because home_sequence is synchronized (%d)",
                                c->joint, get_home_sequence(c->joint));
            return 0;
        }
        return 1;
    }
    if (!axis_ok(c->axis)) {
        if (c->joint >= 0)
            rtapi_print_msg(RTAPI_MSG_ERR, "%s Mode is TELEOP, cannot jog joint\n", jog_word[kind]);
        else
            rtapi_print_msg(RTAPI_MSG_ERR, "%s command.com teleop: unexpected negative axis_num\n", jog_word[kind]);
        return 0;
    }
    if (m->axis[c->axis].locking_joint >= 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "Cannot jog a locking indexer AXIS_%c,joint_num=%d", "XYZABCUVW"[c->axis],
                        m->axis[c->axis].locking_joint);
        return 0;
    }
    return 1;
}

static void mark_jog_error(M *m, C *c)
{
    if (!is_teleop(m))
        set_joint_flag(&m->joint[c->joint], EMCMOT_JOINT_ERROR_BIT, 1);
}

/* A jog further past a limit that is already exceeded? Reports it. */
static int jog_past_limit(M *m, int j, double vel)
{
    const emcmot_joint_t *jt = &m->joint[j];
    int overridden = (m->status->overrideLimitMask >> (2 * j)) & 3;
    const char *word = NULL;
    if (overridden == 3)
        return 0;
    if (vel > 0.0 && joint_flag(jt, EMCMOT_JOINT_MAX_HARD_LIMIT_BIT))
        word = "max hard";
    else if (vel < 0.0 && joint_flag(jt, EMCMOT_JOINT_MIN_HARD_LIMIT_BIT))
        word = "min hard";
    else if (vel > 0.0 && jt->pos_cmd > jt->max_jog_limit)
        word = "max soft";
    else if (vel < 0.0 && jt->pos_cmd < jt->min_jog_limit)
        word = "min soft";
    if (!word)
        return 0;
    report_error("Can't jog joint %d further past %s limit.", j, word);
    return 1;
}

static void jog_joint(M *m, C *c, enum jog_kind kind)
{
    emcmot_joint_t *jt = &m->joint[c->joint];
    double target, step = c->vel > 0.0 ? c->offset : -c->offset;
    if (jt->wheel_jjog_active)
        return;
    if (is_extra(m, c->joint) && get_homed(c->joint)) {
        report_error("Cannot jog extra joint %d: it follows joint.%d.posthome-cmd", c->joint, c->joint);
        return;
    }
    if (kind != JOG_ABS && get_home_needs_unlock_first(c->joint)) {
        report_error("Can't jog locking joint_num=%d", c->joint);
        set_joint_flag(jt, EMCMOT_JOINT_ERROR_BIT, 1);
        return;
    }
    refresh_jog_limits(m, c->joint);
    if (jog_past_limit(m, c->joint, c->vel)) {
        set_joint_flag(jt, EMCMOT_JOINT_ERROR_BIT, 1);
        return;
    }
    switch (kind) {
    case JOG_CONT:
        target = c->vel > 0.0 ? jt->max_jog_limit : jt->min_jog_limit;
        break;
    case JOG_INCR:
        target = jt->free_tp.pos_cmd + step;
        if (target > jt->max_jog_limit || target < jt->min_jog_limit)
            return;
        break;
    default:
        target = fmax(jt->min_jog_limit, fmin(jt->max_jog_limit, c->offset));
        break;
    }
    jt->free_tp.pos_cmd = target;
    jt->free_tp.max_vel = fabs(c->vel);
    m->joint_acc_scale[c->joint] = 1.0;
    jt->kb_jjog_active = 1;
    jt->free_tp.enable = 1;
    if (kind != JOG_ABS)
        axes_abort(m, 0);
    set_joint_flag(jt, EMCMOT_JOINT_ERROR_BIT, 0);
    if (m->kin_type == KINEMATICS_INVERSE_ONLY)
        set_unhomed(m->coord_moved ? -1 : c->joint, m->status->motion_state);
}

static void jog_axis(M *m, C *c, enum jog_kind kind)
{
    struct axis *ax = &m->axis[c->axis];
    double target, step = c->vel > 0.0 ? c->offset : -c->offset;
    if (motion_flag(m, EMCMOT_MOTION_ERROR_BIT) || ax->wheel_ajog_active)
        return;
    switch (kind) {
    case JOG_CONT:
        target = c->vel > 0.0 ? ax->max_pos_limit : ax->min_pos_limit;
        break;
    case JOG_INCR:
        target = ax->teleop_tp.pos_cmd + step;
        if (target > ax->max_pos_limit || target < ax->min_pos_limit)
            return;
        break;
    default:
        target = fmax(ax->min_pos_limit, fmin(ax->max_pos_limit, c->offset));
        break;
    }
    for (int j = 0; j < all_joints(m); j++)
        m->joint[j].free_tp.enable = 0;
    ax->teleop_tp.pos_cmd = target;
    ax->jog_vel = fabs(c->vel);
    ax->jog_acc_scale = 1.0;
    ax->kb_ajog_active = 1;
    ax->teleop_tp.enable = 1;
}

static void jog(M *m, C *c, enum jog_kind kind)
{
    if (!jog_admissible(m, c, kind))
        return;
    if (!is_enabled(m)) {
        report_error("Can't jog joint when not enabled.");
        mark_jog_error(m, c);
        return;
    }
    if (hal_get_bool(m->pins->jog_inhibit)) {
        report_error("Cannot jog while jog-inhibit is active.");
        return;
    }
    if (get_homing_is_active()) {
        report_error(kind == JOG_INCR ? "Can't jog any joint while homing." : "Can't jog any joints while homing.");
        mark_jog_error(m, c);
        return;
    }
    if (is_teleop(m))
        jog_axis(m, c, kind);
    else if (!is_coord(m))
        jog_joint(m, c, kind);
}

static void cmd_jog_cont(M *m, C *c) { jog(m, c, JOG_CONT); }
static void cmd_jog_incr(M *m, C *c) { jog(m, c, JOG_INCR); }
static void cmd_jog_abs(M *m, C *c) { jog(m, c, JOG_ABS); }

static void cmd_jog_abort(M *m, C *c)
{
    if (is_teleop(m)) {
        if (axis_ok(c->axis))
            m->axis[c->axis].teleop_tp.enable = 0;
        return;
    }
    if (!joint_ok(m, c->joint))
        return;
    joint_stop(m, c->joint, 0);
    if (!get_home_is_idle(c->joint))
        do_cancel_homing(c->joint);
    set_joint_flag(&m->joint[c->joint], EMCMOT_JOINT_ERROR_BIT, 0);
}

/* ---- joints ---- */

static void cmd_joint_activate(M *m, C *c)
{
    if (joint_ok(m, c->joint))
        set_joint_flag(&m->joint[c->joint], EMCMOT_JOINT_ACTIVE_BIT, 1);
}

static void cmd_joint_deactivate(M *m, C *c)
{
    if (joint_ok(m, c->joint))
        set_joint_flag(&m->joint[c->joint], EMCMOT_JOINT_ACTIVE_BIT, 0);
}

static void cmd_joint_home(M *m, C *c)
{
    if (m->status->motion_state != EMCMOT_MOTION_FREE) {
        report_error("must be in joint mode to home");
        return;
    }
    if (hal_get_bool(m->pins->homing_inhibit)) {
        report_error("Homing denied by motion.homing-inhibit joint=%d\n", c->joint);
        return;
    }
    if (get_homing_is_active()) {
        report_error("Homing not possible until current homing process is finished.\n");
        return;
    }
    if (!is_enabled(m) || c->joint >= all_joints(m))
        return;
    joints_stop(m, 0);
    do_home_joint(c->joint < 0 ? -1 : c->joint);
    m->coord_moved = 0;
}

static void cmd_joint_unhome(M *m, C *c)
{
    motion_state_t state = m->status->motion_state;
    if (state != EMCMOT_MOTION_FREE && state != EMCMOT_MOTION_DISABLED) {
        report_error("must be in joint mode or disabled to unhome");
        return;
    }
    int was = get_allhomed();
    set_unhomed(c->joint, state);
    if (c->joint == -2 && was && !get_allhomed()) {
        m->internal->teleoperating = m->internal->coordinating = 0;
        set_motion_flag(m, EMCMOT_MOTION_TELEOP_BIT, 0);
        set_motion_flag(m, EMCMOT_MOTION_COORD_BIT, 0);
    }
}

static void cmd_set_joint_position_limits(M *m, C *c)
{
    if (!joint_ok(m, c->joint))
        return;
    m->joint[c->joint].min_pos_limit = c->minLimit;
    m->joint[c->joint].max_pos_limit = c->maxLimit;
    config_publish(m);
}

static void cmd_set_joint_backlash(M *m, C *c)
{
    if (!joint_ok(m, c->joint))
        return;
    comp_set_backlash(&m->joint[c->joint], c->backlash);
    config_publish(m);
}

static void cmd_set_joint_min_ferror(M *m, C *c)
{
    if (!joint_ok(m, c->joint) || c->minFerror < 0.0)
        return;
    m->joint[c->joint].min_ferror = c->minFerror;
    config_publish(m);
}

static void cmd_set_joint_max_ferror(M *m, C *c)
{
    if (!joint_ok(m, c->joint) || c->maxFerror < 0.0)
        return;
    m->joint[c->joint].max_ferror = c->maxFerror;
    config_publish(m);
}

static void cmd_set_joint_vel_limit(M *m, C *c)
{
    if (!joint_ok(m, c->joint))
        return;
    m->joint[c->joint].vel_limit = c->vel;
    m->joint[c->joint].big_vel = 10.0 * c->vel;
    config_publish(m);
}

static void cmd_set_joint_acc_limit(M *m, C *c)
{
    if (!joint_ok(m, c->joint))
        return;
    m->joint[c->joint].acc_limit = c->acc;
    config_publish(m);
}

static void cmd_set_joint_jerk_limit(M *m, C *c)
{
    if (!joint_ok(m, c->joint))
        return;
    m->joint[c->joint].jerk_limit = c->jerk;
    config_publish(m);
}

static void cmd_set_joint_homing_params(M *m, C *c)
{
    if (joint_ok(m, c->joint))
        set_joint_homing_params(c->joint, c->offset, c->home, c->home_final_vel, c->search_vel, c->latch_vel,
                                c->flags, c->home_sequence, c->volatile_home != 0);
}

static void cmd_update_joint_homing_params(M *m, C *c)
{
    if (joint_ok(m, c->joint))
        update_joint_homing_params(c->joint, c->offset, c->home, c->home_sequence);
}

static void cmd_set_joint_motor_offset(M *m, C *c)
{
    if (joint_ok(m, c->joint))
        m->joint[c->joint].motor_offset = c->motor_offset;
}

static void cmd_set_joint_comp(M *m, C *c)
{
    if (!joint_ok(m, c->joint))
        return;
    switch (comp_add(&m->joint[c->joint], c->comp_nominal, c->comp_forward, c->comp_reverse)) {
    case -1:
        report_error("joint %d: too many compensation entries", c->joint);
        break;
    case -2:
        report_error("joint %d: compensation values must increase", c->joint);
        break;
    }
}

/* ---- axes ---- */

static void cmd_set_axis_position_limits(M *m, C *c)
{
    if (!axis_ok(c->axis))
        return;
    m->axis[c->axis].min_pos_limit = c->minLimit;
    m->axis[c->axis].max_pos_limit = c->maxLimit;
    config_publish(m);
}

static void cmd_set_axis_vel_limit(M *m, C *c)
{
    if (!axis_ok(c->axis))
        return;
    m->axis[c->axis].vel_limit = c->vel;
    m->axis[c->axis].ext_offset_vel_limit = c->ext_offset_vel;
    config_publish(m);
}

static void cmd_set_axis_acc_limit(M *m, C *c)
{
    if (!axis_ok(c->axis))
        return;
    m->axis[c->axis].acc_limit = c->acc;
    m->axis[c->axis].ext_offset_acc_limit = c->ext_offset_acc;
    config_publish(m);
}

static void cmd_set_axis_locking_joint(M *m, C *c)
{
    if (axis_ok(c->axis))
        m->axis[c->axis].locking_joint = c->joint;
}

static void cmd_set_axis_jerk_limit(M *m, C *c)
{
    if (!axis_ok(c->axis))
        return;
    m->axis[c->axis].jerk_limit = c->jerk;
    config_publish(m);
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
