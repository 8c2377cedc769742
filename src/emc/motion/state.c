/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * state.c - startup values, published configuration, cycle times.
 *
 * In, out: motion_priv.h   Thread: init; config_publish and cycle_times also servo
 */
#include <limits.h>
#include <string.h>
#include "motion_priv.h"

static void joint_init(emcmot_joint_t *j)
{
    memset(j, 0, sizeof(*j));
    j->flag = EMCMOT_JOINT_INPOS_BIT; /* a machine that starts is at rest */
    j->max_pos_limit = 1.0;
    j->min_pos_limit = -1.0;
    j->vel_limit = 1.0;
    j->acc_limit = 1.0;
    j->jerk_limit = 1.0;
    j->min_ferror = 0.01;
    j->max_ferror = 1.0;
    j->big_vel = 10.0;
    j->free_tp.max_vel = j->vel_limit;
    j->free_tp.max_acc = j->acc_limit;
    j->flag = EMCMOT_JOINT_INPOS_BIT; /* at rest until it is told to move */
    comp_init(j);
}

static void spindle_init(spindle_status_t *s)
{
    s->scale = s->net_scale = 1.0;
    s->max_pos_speed = DEFAULT_MAX_SPINDLE_SPEED;
    s->max_neg_speed = -DEFAULT_MAX_SPINDLE_SPEED;
    s->increment = 100.0;
    s->at_speed = s->rests = 1;
}

void state_init(struct motion *m, const struct motion_sizes *sizes)
{
    emcmot_status_t *s = m->status;
    emcmot_config_t *c = &m->config_work;
    memset(s, 0, sizeof(*s));
    memset(c, 0, sizeof(*c));
    memset(m->config, 0, sizeof(*m->config));
    memset(m->internal, 0, sizeof(*m->internal));
    s->feed_scale = s->rapid_scale = s->net_feed_scale = 1.0;
    s->scale_allowed = 1e99; /* a planner that says nothing */
    s->override_effective = 1.0;
    s->enables_new = s->enables_queued = SS_ENABLED | FS_ENABLED | FH_ENABLED;
    s->motionFlag = EMCMOT_MOTION_INPOS_BIT;
    s->scurve_peak_scale = 1.0;
    s->numExtraJoints = sizes->extra_joints;
    for (int i = 0; i < EMCMOT_MAX_SPINDLES; i++)
        spindle_init(&s->spindle_status[i]);

    c->numJoints = sizes->joints;
    c->numExtraJoints = sizes->extra_joints;
    c->numSpindles = sizes->spindles;
    c->kinType = m->kin_type;
    c->numDIO = sizes->dio;
    c->numAIO = sizes->aio;
    c->numMiscError = sizes->misc_errors;
    c->limitVel = 1e99;
    c->maxFeedScale = DEFAULT_MAX_FEEDOVERRIDE;
    c->arcBlendEnable = 1;
    c->arcBlendOptDepth = 50;
    c->arcBlendGapCycles = 4;
    c->arcBlendRampFreq = 100.0;
    c->arcBlendTangentKinkRatio = 0.1;

    for (int j = 0; j < EMCMOT_MAX_JOINTS; j++) {
        joint_init(&m->joint[j]);
        m->joint_acc_scale[j] = 1.0;
    }
    axis_init(m);
    m->pending_planner_type = -1;
    m->kins_failed_type = INT_MIN;
    m->first_pass = 1;
    m->settle = INT_MAX;
}

void config_publish(struct motion *m)
{
    emcmot_config_t *to = m->config;
    unsigned int tail = to->tail;
    m->config_work.config_num++;
    emcmotBlockBegin(&to->head);
    unsigned int head = to->head;
    *to = m->config_work;
    to->tail = tail;
    __atomic_store_n(&to->head, head, __ATOMIC_RELAXED);
    emcmotBlockEnd(&to->head, &to->tail);
    m->status->config_num = m->config_work.config_num;
}

void cycle_times(struct motion *m, long period_ns)
{
    long traj = motion_traj_period_nsec();
    int rate = (int)((double)traj / (double)period_ns + 0.5);
    if (rate < 1)
        rate = 1;
    m->period_ns = period_ns;
    m->servo_period = (double)period_ns * 1e-9;
    m->interpolation_rate = rate;
    m->traj_period = m->servo_period * rate;
    m->config_work.servoCycleTime = m->servo_period;
    m->config_work.trajCycleTime = m->traj_period;
    m->config_work.interpolationRate = rate;
    tpSetCycleTime(&m->tp, m->traj_period);
    for (int j = 0; j < EMCMOT_MAX_JOINTS; j++) {
        cubic_init(&m->cubic[j], m->traj_period, rate);
        cubic_add_point(&m->cubic[j], m->joint[j].pos_cmd);
        m->cubic[j].need_next = 1;
    }
    config_publish(m);
}
