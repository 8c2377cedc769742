/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * command_move.c - moves, and what the planner is told.
 *
 * In:     shared command      Out: planner queue and settings, configuration, answers
 * Thread: servo, called by command.c
 */
#include <math.h>
#include "command_priv.h"

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
    if (c->command == EMCMOT_SET_CIRCLE ? !arc_in_range(m, c) : !line_in_range(m, c, kind)) {
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

void cmd_set_line(M *m, C *c)
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

void cmd_set_circle(M *m, C *c)
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

void cmd_clear_probe_flags(M *m, C *c)
{
    (void)c;
    m->status->probing = 0;
    m->status->probeTripped = 0;
}

#define PROBE_SUPPRESS 1 /* probe_type: no error when nothing happens */
#define PROBE_AWAY 2     /* contact is to be lost */

void cmd_probe(M *m, C *c)
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

void cmd_rigid_tap(M *m, C *c)
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

void cmd_set_vel(M *m, C *c)
{
    m->status->vel = c->vel;
    tpSetVmax(&m->tp, c->vel, c->ini_maxvel);
}

void cmd_set_vel_limit(M *m, C *c)
{
    m->config_work.limitVel = c->vel;
    tpSetVlimit(&m->tp, c->vel);
    config_publish(m);
}

void cmd_set_acc(M *m, C *c)
{
    m->status->acc = c->acc;
    tpSetAmax(&m->tp, c->acc);
}

void cmd_set_jerk(M *m, C *c) { m->status->jerk = c->jerk; }

void cmd_set_planner_type(M *m, C *c)
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

void cmd_set_scurve_peak_scale(M *m, C *c)
{
    m->status->scurve_peak_scale = fmax(0.1, fmin(1.0, c->scurve_peak_scale));
}

void cmd_set_term_cond(M *m, C *c) { tpSetTermCond(&m->tp, c->termCond, c->tolerance); }

void cmd_set_num_joints(M *m, C *c)
{
    if (c->joint < 1 || c->joint > EMCMOT_MAX_JOINTS)
        return;
    /* pins exist for the joints of the module */
    m->config_work.numJoints = c->joint < m->num_joints ? c->joint : m->num_joints;
    config_publish(m);
}

void cmd_set_num_spindles(M *m, C *c)
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

void cmd_set_world_home(M *m, C *c) { m->status->world_home = c->pos; }

void cmd_set_debug(M *m, C *c)
{
    m->config_work.debug = c->debug;
    config_publish(m);
}

void cmd_set_max_feed_override(M *m, C *c)
{
    m->config_work.maxFeedScale = c->maxFeedScale;
    config_publish(m);
}

void cmd_setup_arc_blends(M *m, C *c)
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

void cmd_set_probe_err_inhibit(M *m, C *c)
{
    m->config_work.inhibit_probe_jog_error = c->probe_jog_err_inhibit;
    m->config_work.inhibit_probe_home_error = c->probe_home_err_inhibit;
    m->config_work.probe_feed_contact = c->probe_feed_contact;
    m->config_work.probe_rapid_contact = c->probe_rapid_contact;
    m->config_work.probe_filter = c->probe_filter;
    config_publish(m);
}

void cmd_set_offset(M *m, C *c)
{
    m->status->tool_offset = c->tool_offset;
}
