/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * output.c - state to pins and to the status block.
 *
 * In:     everything          Out: pins, status
 * Thread: servo
 */
#include <math.h>
#include "motion_priv.h"

static void joint_output(struct motion *m, int j)
{
    emcmot_joint_t *jt = &m->joint[j];
    struct joint_pins *p = &m->pins->joint[j];
    jt->motor_pos_cmd = jt->pos_cmd + jt->backlash_filt + jt->motor_offset;
    if (is_extra(m, j) && get_homed(j) && p->posthome_cmd)
        jt->motor_pos_cmd = hal_get_real(p->posthome_cmd) + jt->motor_offset;
    hal_set_real(p->motor_pos_cmd, jt->motor_pos_cmd);
    hal_set_real(p->coarse_pos_cmd, jt->coarse_pos);
    hal_set_real(p->pos_cmd, jt->pos_cmd);
    hal_set_real(p->pos_fb, jt->pos_fb);
    hal_set_real(p->motor_offset, jt->motor_offset);
    hal_set_real(p->vel_cmd, jt->vel_cmd);
    hal_set_real(p->acc_cmd, jt->acc_cmd);
    hal_set_real(p->jerk_cmd, jt->jerk_cmd);
    hal_set_real(p->backlash_corr, jt->backlash_corr);
    hal_set_real(p->backlash_filt, jt->backlash_filt);
    hal_set_real(p->backlash_vel, jt->backlash_vel);
    hal_set_real(p->f_error, jt->ferror);
    hal_set_real(p->f_error_lim, jt->ferror_limit);
    hal_set_real(p->free_pos_cmd, jt->free_tp.pos_cmd);
    hal_set_real(p->free_vel_lim, jt->free_tp.max_vel);
    hal_set_bool(p->free_tp_enable, jt->free_tp.enable);
    hal_set_bool(p->kb_jog_active, jt->kb_jjog_active);
    hal_set_bool(p->wheel_jog_active, jt->wheel_jjog_active);
    hal_set_bool(p->amp_enable_out, joint_flag(jt, EMCMOT_JOINT_ENABLE_BIT));
    hal_set_bool(p->in_position, joint_flag(jt, EMCMOT_JOINT_INPOS_BIT));
    hal_set_bool(p->pos_hard_limit, joint_flag(jt, EMCMOT_JOINT_MAX_HARD_LIMIT_BIT));
    hal_set_bool(p->neg_hard_limit, joint_flag(jt, EMCMOT_JOINT_MIN_HARD_LIMIT_BIT));
    hal_set_bool(p->active, joint_flag(jt, EMCMOT_JOINT_ACTIVE_BIT));
    hal_set_bool(p->error, joint_flag(jt, EMCMOT_JOINT_ERROR_BIT));
    hal_set_bool(p->f_errored, joint_flag(jt, EMCMOT_JOINT_FERROR_BIT));
    hal_set_bool(p->faulted, joint_flag(jt, EMCMOT_JOINT_FAULT_BIT));
    if (p->unlock && !is_enabled(m))
        hal_set_bool(p->unlock, 0);
}

static void axis_output(struct motion *m, int n)
{
    const struct axis *a = &m->axis[n];
    struct axis_pins *p = &m->pins->axis[n];
    hal_set_real(p->pos_cmd, emcPoseGetAxis(&m->status->carte_pos_cmd, n) - a->ext_offset_tp.curr_pos);
    hal_set_real(p->teleop_vel_cmd, a->teleop_tp.curr_vel);
    hal_set_real(p->teleop_pos_cmd, a->teleop_tp.pos_cmd);
    hal_set_real(p->teleop_vel_lim, a->teleop_tp.max_vel);
    hal_set_bool(p->teleop_tp_enable, a->teleop_tp.enable);
    hal_set_bool(p->kb_jog_active, a->kb_ajog_active);
    hal_set_bool(p->wheel_jog_active, a->wheel_ajog_active);
    hal_set_real(p->eoffset, a->ext_offset_tp.curr_pos);
}

static double current_velocity(const struct motion *m)
{
    double sum = 0.0;
    switch (m->status->motion_state) {
    case EMCMOT_MOTION_COORD:
        return m->status->current_vel;
    case EMCMOT_MOTION_TELEOP:
        for (int n = 0; n < EMCMOT_MAX_AXIS; n++)
            if (m->axis[n].teleop_tp.active)
                sum += pmSq(m->axis[n].teleop_tp.curr_vel);
        return sqrt(sum);
    default:
        for (int j = 0; j < all_joints(m); j++)
            if (is_active(&m->joint[j]) && m->joint[j].free_tp.active)
                sum += pmSq(m->joint[j].vel_cmd);
        return sqrt(sum);
    }
}

static double turn360(double deg)
{
    deg = fmod(deg, 360.0);
    return deg < 0.0 ? deg + 360.0 : deg;
}

static void heading_output(struct motion *m, const struct state_tag_t *tag)
{
    struct motion_pins *p = m->pins;
    int mode = tag->fields[GM_FIELD_MOTION_MODE];
    const float *f = tag->fields_float;
    if (mode == 0 || mode == 10) {
        hal_set_real(p->interp_heading, f[GM_FIELD_FLOAT_STRAIGHT_HEADING]);
    } else if (mode == 20 || mode == 30) {
        const PmCartesian *at = &m->status->carte_pos_fb.tran;
        double dx = at->x - f[GM_FIELD_FLOAT_ARC_CENTER_X], dy = at->y - f[GM_FIELD_FLOAT_ARC_CENTER_Y];
        double dz = at->z - f[GM_FIELD_FLOAT_ARC_CENTER_Z], angle = 0.0;
        switch (tag->fields[GM_FIELD_PLANE]) {
        case 170: angle = atan2(dy, dx); break;
        case 180: angle = atan2(dx, dz); break;
        case 190: angle = atan2(dz, dy); break;
        }
        angle *= TO_DEG;
        hal_set_real(p->interp_normal_heading, turn360(angle + 180.0));
        hal_set_real(p->interp_heading, turn360(angle + (mode == 30 ? 90.0 : -90.0)));
    }
}

static void tag_output(struct motion *m)
{
    const struct state_tag_t *tag = &m->status->tag;
    struct motion_pins *p = m->pins;
    const float *f = tag->fields_float;
    hal_set_si32(p->interp_line, tag->fields[GM_FIELD_LINE_NUMBER]);
    hal_set_si32(p->interp_motion_type, tag->fields[GM_FIELD_MOTION_MODE]);
    hal_set_real(p->interp_feedrate, f[GM_FIELD_FLOAT_FEED]);
    hal_set_real(p->interp_arc_radius, f[GM_FIELD_FLOAT_ARC_RADIUS]);
    hal_set_real(p->interp_arc_center[0], f[GM_FIELD_FLOAT_ARC_CENTER_X]);
    hal_set_real(p->interp_arc_center[1], f[GM_FIELD_FLOAT_ARC_CENTER_Y]);
    hal_set_real(p->interp_arc_center[2], f[GM_FIELD_FLOAT_ARC_CENTER_Z]);
    hal_set_bool(p->interp_iscircle, state_tag_flag(tag, GM_FLAG_IS_CIRCLE));
    heading_output(m, tag);
}

static void feed_output(struct motion *m)
{
    const emcmot_status_t *s = m->status;
    struct motion_pins *p = m->pins;
    double upm = 0.0;
    if (s->motionType == EMC_MOTION_TYPE_FEED || s->motionType == EMC_MOTION_TYPE_ARC)
        upm = s->tag.fields_float[GM_FIELD_FLOAT_FEED] * s->net_feed_scale;
    double ipm = state_tag_flag(&s->tag, GM_FLAG_UNITS) ? upm : upm / 25.4;
    hal_set_real(p->feed_upm, upm);
    hal_set_real(p->feed_ipm, ipm);
    hal_set_real(p->feed_ips, ipm / 60.0);
    hal_set_real(p->feed_mmpm, ipm * 25.4);
    hal_set_real(p->feed_mmps, ipm * 25.4 / 60.0);
}

static void debug_output(struct motion *m)
{
    struct motion_pins *p = m->pins;
    const emcmot_status_t *s = m->status;
    hal_set_bool(p->debug_bit[0], m->joint[1].free_tp.active);
    hal_set_bool(p->debug_bit[1], (s->enables_new & AF_ENABLED) != 0);
    hal_set_real(p->debug_float[0], s->spindle_status[0].speed);
    hal_set_real(p->debug_float[1], s->spindleSync);
    hal_set_real(p->debug_float[2], s->vel);
    hal_set_real(p->debug_float[3], s->spindle_status[0].net_scale);
    hal_set_si32(p->debug_s32[0], s->overrideLimitMask);
    hal_set_si32(p->debug_s32[1], (int)s->tcqlen);
}

void phase_output(struct motion *m)
{
    struct motion_pins *p = m->pins;
    emcmot_status_t *s = m->status;
    s->current_vel = current_velocity(m);
    hal_set_bool(p->motion_enabled, is_enabled(m));
    hal_set_bool(p->in_position, is_inpos(m));
    hal_set_bool(p->coord_mode, is_coord(m));
    hal_set_bool(p->teleop_mode, is_teleop(m));
    hal_set_bool(p->coord_error, motion_flag(m, EMCMOT_MOTION_ERROR_BIT));
    hal_set_bool(p->on_soft_limit, s->on_soft_limit);
    hal_set_bool(p->tp_reverse, m->tp.reverse_run != 0);
    hal_set_bool(p->is_all_homed, get_allhomed());
    m->jog_was_active = any_jog_active(m);
    hal_set_bool(p->jog_is_active, m->jog_was_active);
    hal_set_real(p->current_vel, s->current_vel);
    hal_set_real(p->requested_vel, s->motion_state == EMCMOT_MOTION_COORD ? s->requested_vel : 0.0);
    hal_set_real(p->distance_to_go, s->distance_to_go);
    hal_set_si32(p->program_line, s->id);
    hal_set_si32(p->motion_type, s->motionType);
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        hal_set_real(p->tooloffset[n], emcPoseGetAxis(&s->tool_offset, n));
        axis_output(m, n);
    }
    for (int j = 0; j < all_joints(m); j++)
        joint_output(m, j);
    spindle_output(m);
    tag_output(m);
    feed_output(m);
    debug_output(m);
}

static void joint_status(struct motion *m, int j)
{
    const emcmot_joint_t *jt = &m->joint[j];
    emcmot_joint_status_t *s = &m->status->joint_status[j];
    s->flag = jt->flag;
    s->homed = get_homed(j);
    s->homing = get_homing(j);
    s->pos_cmd = jt->pos_cmd;
    s->pos_fb = jt->pos_fb;
    s->vel_cmd = jt->vel_cmd;
    s->acc_cmd = jt->acc_cmd;
    s->ferror = jt->ferror;
    s->ferror_high_mark = jt->ferror_high_mark;
    s->backlash = jt->backlash;
    s->max_pos_limit = jt->max_pos_limit;
    s->min_pos_limit = jt->min_pos_limit;
    s->min_ferror = jt->min_ferror;
    s->max_ferror = jt->max_ferror;
}

static void io_status(struct motion *m)
{
    emcmot_status_t *s = m->status;
    const struct motion_pins *p = m->pins;
    for (int i = 0; i < m->config_work.numDIO; i++) {
        s->synch_di[i] = hal_get_bool(p->digital_in[i]);
        s->synch_do[i] = hal_get_bool(p->digital_out[i]);
    }
    for (int i = 0; i < m->config_work.numAIO; i++) {
        s->analog_input[i] = hal_get_real(p->analog_in[i]);
        s->analog_output[i] = hal_get_real(p->analog_out[i]);
    }
    for (int i = 0; i < m->config_work.numMiscError; i++)
        s->misc_error[i] = hal_get_bool(p->misc_error[i]);
}

static void single_step(struct motion *m)
{
    emcmot_status_t *s = m->status;
    if (!s->stepping || s->id == m->internal->idForStep)
        return;
    tpPause(&m->tp);
    s->stepping = 0;
    s->paused = 1;
}

void phase_status(struct motion *m)
{
    emcmot_status_t *s = m->status;
    for (int j = 0; j < all_joints(m); j++)
        joint_status(m, j);
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        s->axis_status[n].teleop_vel_cmd = m->axis[n].teleop_tp.curr_vel;
        s->axis_status[n].max_pos_limit = m->axis[n].max_pos_limit;
        s->axis_status[n].min_pos_limit = m->axis[n].min_pos_limit;
    }
    io_status(m);
    s->depth = tpQueueDepth(&m->tp);
    s->activeDepth = tpActiveDepth(&m->tp);
    s->id = tpGetExecId(&m->tp);
    s->tag = tpGetExecTag(&m->tp);
    s->motionType = tpGetMotionType(&m->tp);
    s->queueFull = tcqFull(&m->tp.queue);
    s->reverse_run = m->tp.reverse_run;
    s->jogging_active = m->jog_was_active;
    s->external_offsets_applied = axis_eoffsets_applied(m, &s->eoffset_pose);
    override_status(m);
    single_step(m);
}
