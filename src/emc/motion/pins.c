/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * pins.c - pins and parameters of motmod.
 *
 * In:     sizes and names given at load     Out: struct motion_pins
 * Thread: init
 */
#include "motion_priv.h"

/* A pin of one of the families: offset in its struct and name behind the prefix. */
enum pin_kind { BIT, REAL, SIGNED, UNSIGNED };
struct pin_row {
    const char *name;
    enum pin_kind kind;
    hal_pdir_t dir;
    size_t offset;
    double initial;
};
#define ROW(family, name, kind, dir, field, initial) {name, kind, dir, offsetof(struct family, field), initial}
#define COUNT(rows) (sizeof(rows) / sizeof((rows)[0]))

static const struct pin_row motion_rows[] = {
    ROW(motion_pins, "probe-input", BIT, HAL_IN, probe_input, 0),
    ROW(motion_pins, "adaptive-feed", REAL, HAL_IN, adaptive_feed, 1.0),
    ROW(motion_pins, "feed-hold", BIT, HAL_IN, feed_hold, 0),
    ROW(motion_pins, "feed-inhibit", BIT, HAL_IN, feed_inhibit, 0),
    ROW(motion_pins, "homing-inhibit", BIT, HAL_IN, homing_inhibit, 0),
    ROW(motion_pins, "jog-inhibit", BIT, HAL_IN, jog_inhibit, 0),
    ROW(motion_pins, "jog-stop", BIT, HAL_IN, jog_stop, 0),
    ROW(motion_pins, "jog-stop-immediate", BIT, HAL_IN, jog_stop_immediate, 0),
    ROW(motion_pins, "tp-reverse", BIT, HAL_OUT, tp_reverse, 0),
    ROW(motion_pins, "enable", BIT, HAL_IN, enable, 1),
    ROW(motion_pins, "is-all-homed", BIT, HAL_OUT, is_all_homed, 0),
    ROW(motion_pins, "feed-upm", REAL, HAL_OUT, feed_upm, 0),
    ROW(motion_pins, "feed-inches-per-minute", REAL, HAL_OUT, feed_ipm, 0),
    ROW(motion_pins, "feed-inches-per-second", REAL, HAL_OUT, feed_ips, 0),
    ROW(motion_pins, "feed-mm-per-minute", REAL, HAL_OUT, feed_mmpm, 0),
    ROW(motion_pins, "feed-mm-per-second", REAL, HAL_OUT, feed_mmps, 0),
    ROW(motion_pins, "motion-enabled", BIT, HAL_OUT, motion_enabled, 0),
    ROW(motion_pins, "in-position", BIT, HAL_OUT, in_position, 0),
    ROW(motion_pins, "motion-type", SIGNED, HAL_OUT, motion_type, 0),
    ROW(motion_pins, "coord-mode", BIT, HAL_OUT, coord_mode, 0),
    ROW(motion_pins, "teleop-mode", BIT, HAL_OUT, teleop_mode, 0),
    ROW(motion_pins, "coord-error", BIT, HAL_OUT, coord_error, 0),
    ROW(motion_pins, "on-soft-limit", BIT, HAL_OUT, on_soft_limit, 0),
    ROW(motion_pins, "current-vel", REAL, HAL_OUT, current_vel, 0),
    ROW(motion_pins, "requested-vel", REAL, HAL_OUT, requested_vel, 0),
    ROW(motion_pins, "distance-to-go", REAL, HAL_OUT, distance_to_go, 0),
    ROW(motion_pins, "program-line", SIGNED, HAL_OUT, program_line, 0),
    ROW(motion_pins, "jog-is-active", BIT, HAL_OUT, jog_is_active, 0),
    ROW(motion_pins, "interp.line-number", SIGNED, HAL_OUT, interp_line, 0),
    ROW(motion_pins, "interp.motion-type", SIGNED, HAL_OUT, interp_motion_type, 0),
    ROW(motion_pins, "interp.feedrate", REAL, HAL_OUT, interp_feedrate, 0),
    ROW(motion_pins, "interp.arc-radius", REAL, HAL_OUT, interp_arc_radius, 0),
    ROW(motion_pins, "interp.arc-center-x", REAL, HAL_OUT, interp_arc_center[0], 0),
    ROW(motion_pins, "interp.arc-center-y", REAL, HAL_OUT, interp_arc_center[1], 0),
    ROW(motion_pins, "interp.arc-center-z", REAL, HAL_OUT, interp_arc_center[2], 0),
    ROW(motion_pins, "interp.heading", REAL, HAL_OUT, interp_heading, 0),
    ROW(motion_pins, "interp.normal-heading", REAL, HAL_OUT, interp_normal_heading, 0),
    ROW(motion_pins, "interp.iscircle", BIT, HAL_OUT, interp_iscircle, 0),
    ROW(motion_pins, "servo.last-period", UNSIGNED, HAL_OUT, last_period, 0),
    ROW(motion_pins, "tooloffset.x", REAL, HAL_OUT, tooloffset[0], 0),
    ROW(motion_pins, "tooloffset.y", REAL, HAL_OUT, tooloffset[1], 0),
    ROW(motion_pins, "tooloffset.z", REAL, HAL_OUT, tooloffset[2], 0),
    ROW(motion_pins, "tooloffset.a", REAL, HAL_OUT, tooloffset[3], 0),
    ROW(motion_pins, "tooloffset.b", REAL, HAL_OUT, tooloffset[4], 0),
    ROW(motion_pins, "tooloffset.c", REAL, HAL_OUT, tooloffset[5], 0),
    ROW(motion_pins, "tooloffset.u", REAL, HAL_OUT, tooloffset[6], 0),
    ROW(motion_pins, "tooloffset.v", REAL, HAL_OUT, tooloffset[7], 0),
    ROW(motion_pins, "tooloffset.w", REAL, HAL_OUT, tooloffset[8], 0),
    ROW(motion_pins, "eoffset-active", BIT, HAL_OUT, eoffset_active, 0),
    ROW(motion_pins, "eoffset-limited", BIT, HAL_OUT, eoffset_limited, 0),
};

static const struct pin_row joint_rows[] = {
    ROW(joint_pins, "coarse-pos-cmd", REAL, HAL_OUT, coarse_pos_cmd, 0),
    ROW(joint_pins, "pos-cmd", REAL, HAL_OUT, pos_cmd, 0),
    ROW(joint_pins, "pos-fb", REAL, HAL_OUT, pos_fb, 0),
    ROW(joint_pins, "motor-pos-cmd", REAL, HAL_OUT, motor_pos_cmd, 0),
    ROW(joint_pins, "motor-pos-fb", REAL, HAL_IN, motor_pos_fb, 0),
    ROW(joint_pins, "motor-offset", REAL, HAL_OUT, motor_offset, 0),
    ROW(joint_pins, "pos-lim-sw-in", BIT, HAL_IN, pos_lim_sw_in, 0),
    ROW(joint_pins, "neg-lim-sw-in", BIT, HAL_IN, neg_lim_sw_in, 0),
    ROW(joint_pins, "amp-enable-out", BIT, HAL_OUT, amp_enable_out, 0),
    ROW(joint_pins, "amp-fault-in", BIT, HAL_IN, amp_fault_in, 0),
    ROW(joint_pins, "jog-counts", SIGNED, HAL_IN, jog_counts, 0),
    ROW(joint_pins, "jog-enable", BIT, HAL_IN, jog_enable, 0),
    ROW(joint_pins, "jog-scale", REAL, HAL_IN, jog_scale, 0),
    ROW(joint_pins, "jog-vel-mode", BIT, HAL_IN, jog_vel_mode, 0),
    ROW(joint_pins, "jog-accel-fraction", REAL, HAL_IN, jog_accel_fraction, 1.0),
    ROW(joint_pins, "vel-cmd", REAL, HAL_OUT, vel_cmd, 0),
    ROW(joint_pins, "acc-cmd", REAL, HAL_OUT, acc_cmd, 0),
    ROW(joint_pins, "jerk-cmd", REAL, HAL_OUT, jerk_cmd, 0),
    ROW(joint_pins, "backlash-corr", REAL, HAL_OUT, backlash_corr, 0),
    ROW(joint_pins, "backlash-filt", REAL, HAL_OUT, backlash_filt, 0),
    ROW(joint_pins, "backlash-vel", REAL, HAL_OUT, backlash_vel, 0),
    ROW(joint_pins, "f-error", REAL, HAL_OUT, f_error, 0),
    ROW(joint_pins, "f-error-lim", REAL, HAL_OUT, f_error_lim, 0),
    ROW(joint_pins, "free-pos-cmd", REAL, HAL_OUT, free_pos_cmd, 0),
    ROW(joint_pins, "free-vel-lim", REAL, HAL_OUT, free_vel_lim, 0),
    ROW(joint_pins, "free-tp-enable", BIT, HAL_OUT, free_tp_enable, 0),
    ROW(joint_pins, "kb-jog-active", BIT, HAL_OUT, kb_jog_active, 0),
    ROW(joint_pins, "wheel-jog-active", BIT, HAL_OUT, wheel_jog_active, 0),
    ROW(joint_pins, "in-position", BIT, HAL_OUT, in_position, 0),
    ROW(joint_pins, "pos-hard-limit", BIT, HAL_OUT, pos_hard_limit, 0),
    ROW(joint_pins, "neg-hard-limit", BIT, HAL_OUT, neg_hard_limit, 0),
    ROW(joint_pins, "active", BIT, HAL_OUT, active, 0),
    ROW(joint_pins, "error", BIT, HAL_OUT, error, 0),
    ROW(joint_pins, "f-errored", BIT, HAL_OUT, f_errored, 0),
    ROW(joint_pins, "faulted", BIT, HAL_OUT, faulted, 0),
};
static const struct pin_row unlock_rows[] = {
    ROW(joint_pins, "unlock", BIT, HAL_OUT, unlock, 0),
    ROW(joint_pins, "is-unlocked", BIT, HAL_IN, is_unlocked, 0),
};
static const struct pin_row extra_rows[] = {
    ROW(joint_pins, "posthome-cmd", REAL, HAL_IN, posthome_cmd, 0),
};

static const struct pin_row axis_rows[] = {
    ROW(axis_pins, "pos-cmd", REAL, HAL_OUT, pos_cmd, 0),
    ROW(axis_pins, "teleop-vel-cmd", REAL, HAL_OUT, teleop_vel_cmd, 0),
    ROW(axis_pins, "teleop-pos-cmd", REAL, HAL_OUT, teleop_pos_cmd, 0),
    ROW(axis_pins, "teleop-vel-lim", REAL, HAL_OUT, teleop_vel_lim, 0),
    ROW(axis_pins, "teleop-tp-enable", BIT, HAL_OUT, teleop_tp_enable, 0),
    ROW(axis_pins, "eoffset-enable", BIT, HAL_IN, eoffset_enable, 0),
    ROW(axis_pins, "eoffset-clear", BIT, HAL_IN, eoffset_clear, 0),
    ROW(axis_pins, "eoffset-counts", SIGNED, HAL_IN, eoffset_counts, 0),
    ROW(axis_pins, "eoffset-scale", REAL, HAL_IN, eoffset_scale, 0),
    ROW(axis_pins, "eoffset", REAL, HAL_OUT, eoffset, 0),
    ROW(axis_pins, "eoffset-request", REAL, HAL_OUT, eoffset_request, 0),
    ROW(axis_pins, "jog-enable", BIT, HAL_IN, jog_enable, 0),
    ROW(axis_pins, "jog-scale", REAL, HAL_IN, jog_scale, 0),
    ROW(axis_pins, "jog-counts", SIGNED, HAL_IN, jog_counts, 0),
    ROW(axis_pins, "jog-vel-mode", BIT, HAL_IN, jog_vel_mode, 0),
    ROW(axis_pins, "jog-accel-fraction", REAL, HAL_IN, jog_accel_fraction, 1.0),
    ROW(axis_pins, "kb-jog-active", BIT, HAL_OUT, kb_jog_active, 0),
    ROW(axis_pins, "wheel-jog-active", BIT, HAL_OUT, wheel_jog_active, 0),
};

static const struct pin_row spindle_rows[] = {
    ROW(spindle_pins, "index-enable", BIT, HAL_IO, index_enable, 0),
    ROW(spindle_pins, "on", BIT, HAL_OUT, on, 0),
    ROW(spindle_pins, "forward", BIT, HAL_OUT, forward, 0),
    ROW(spindle_pins, "reverse", BIT, HAL_OUT, reverse, 0),
    ROW(spindle_pins, "brake", BIT, HAL_OUT, brake, 0),
    ROW(spindle_pins, "speed-out", REAL, HAL_OUT, speed_out, 0),
    ROW(spindle_pins, "speed-out-abs", REAL, HAL_OUT, speed_out_abs, 0),
    ROW(spindle_pins, "speed-out-rps", REAL, HAL_OUT, speed_out_rps, 0),
    ROW(spindle_pins, "speed-out-rps-abs", REAL, HAL_OUT, speed_out_rps_abs, 0),
    ROW(spindle_pins, "speed-cmd-rps", REAL, HAL_OUT, speed_cmd_rps, 0),
    ROW(spindle_pins, "inhibit", BIT, HAL_IN, inhibit, 0),
    ROW(spindle_pins, "amp-fault-in", BIT, HAL_IN, amp_fault_in, 0),
    ROW(spindle_pins, "orient-angle", REAL, HAL_OUT, orient_angle, 0),
    ROW(spindle_pins, "orient-mode", SIGNED, HAL_OUT, orient_mode, 0),
    ROW(spindle_pins, "orient", BIT, HAL_OUT, orient, 0),
    ROW(spindle_pins, "locked", BIT, HAL_OUT, locked, 0),
    ROW(spindle_pins, "is-oriented", BIT, HAL_IN, is_oriented, 0),
    ROW(spindle_pins, "orient-fault", SIGNED, HAL_IN, orient_fault, 0),
    ROW(spindle_pins, "revs", REAL, HAL_IN, revs, 0),
    ROW(spindle_pins, "speed-in", REAL, HAL_IN, speed_in, 0),
    ROW(spindle_pins, "at-speed", BIT, HAL_IN, at_speed, 1),
};

static int make_pin(int comp, enum pin_kind kind, hal_pdir_t dir, void *ref, double initial, const char *name)
{
    switch (kind) {
    case BIT:
        return hal_pin_new_bool(comp, dir, ref, initial != 0.0, "%s", name);
    case REAL:
        return hal_pin_new_real(comp, dir, ref, initial, "%s", name);
    case SIGNED:
        return hal_pin_new_si32(comp, dir, ref, (rtapi_s32)initial, "%s", name);
    default:
        return hal_pin_new_ui32(comp, dir, ref, (rtapi_u32)initial, "%s", name);
    }
}

static int make_rows(int comp, const struct pin_row *rows, size_t count, void *base, const char *prefix)
{
    char name[HAL_NAME_LEN + 1];
    for (size_t i = 0; i < count; i++) {
        rtapi_snprintf(name, sizeof(name), "%s.%s", prefix, rows[i].name);
        int r = make_pin(comp, rows[i].kind, rows[i].dir, (char *)base + rows[i].offset, rows[i].initial, name);
        if (r < 0)
            return r;
    }
    return 0;
}

/* Named ones first, the rest numbered from 00 among themselves. */
static int make_io(int comp, enum pin_kind kind, hal_pdir_t dir, void *refs, int count, char **names,
                   const char *named, const char *numbered)
{
    char name[HAL_NAME_LEN + 1];
    int number = 0, more_names = 1;
    for (int i = 0; i < count; i++) {
        void *ref = (char *)refs + (size_t)i * sizeof(hal_bool_t);
        more_names = more_names && names && names[i] && names[i][0];
        if (more_names)
            rtapi_snprintf(name, sizeof(name), "motion.%s-%s", named, names[i]);
        else
            rtapi_snprintf(name, sizeof(name), "motion.%s-%02d", numbered, number++);
        int r = make_pin(comp, kind, dir, ref, 0.0, name);
        if (r < 0)
            return r;
    }
    return 0;
}

static int make_params(struct motion *m)
{
    struct motion_pins *p = m->pins;
    int c = m->comp_id, r = 0;
    for (int i = 0; i < 2; i++) {
        r |= hal_param_new_bool(c, HAL_RO, &p->debug_bit[i], 0, "motion.debug-bit-%d", i);
        r |= hal_param_new_si32(c, HAL_RO, &p->debug_s32[i], 0, "motion.debug-s32-%d", i);
    }
    for (int i = 0; i < 4; i++) {
        r |= hal_param_new_real(c, HAL_RO, &p->debug_float[i], 0, "motion.debug-float-%d", i);
        r |= hal_param_new_real(c, HAL_RO, &p->tc_pos[i], 0, "tc.%d.pos", i);
        r |= hal_param_new_real(c, HAL_RO, &p->tc_vel[i], 0, "tc.%d.vel", i);
        r |= hal_param_new_real(c, HAL_RO, &p->tc_acc[i], 0, "tc.%d.acc", i);
    }
    r |= hal_param_new_real(c, HAL_RO, &p->traj_pos_out, 0, "traj.pos_out");
    r |= hal_param_new_real(c, HAL_RO, &p->traj_vel_out, 0, "traj.vel_out");
    r |= hal_param_new_ui32(c, HAL_RO, &p->traj_active_tc, 0, "traj.active_tc");
    return r < 0 ? r : 0;
}

int pins_create(struct motion *m, const struct motion_sizes *s)
{
    static const char letters[] = "xyzabcuvw";
    struct motion_pins *p = hal_malloc(sizeof(*p));
    char prefix[16];
    int c = m->comp_id, r;
    if (!p)
        return -1;
    m->pins = p;
    if ((r = make_rows(c, motion_rows, COUNT(motion_rows), p, "motion")) < 0 ||
        (r = make_io(c, BIT, HAL_IN, p->digital_in, s->dio, s->names_din, "din", "digital-in")) < 0 ||
        (r = make_io(c, BIT, HAL_OUT, p->digital_out, s->dio, s->names_dout, "dout", "digital-out")) < 0 ||
        (r = make_io(c, REAL, HAL_IN, p->analog_in, s->aio, s->names_ain, "ain", "analog-in")) < 0 ||
        (r = make_io(c, REAL, HAL_OUT, p->analog_out, s->aio, s->names_aout, "aout", "analog-out")) < 0 ||
        (r = make_io(c, BIT, HAL_IN, p->misc_error, s->misc_errors, s->names_misc, "err", "misc-error")) < 0)
        return r;
    if (kinematicsSwitchable() &&
        (r = hal_pin_new_real(c, HAL_IN, &p->switchkins_type, 0.0, "motion.switchkins-type")) < 0)
        return r;
    for (int n = 0; n < s->joints; n++) {
        rtapi_snprintf(prefix, sizeof(prefix), "joint.%d", n);
        if ((r = make_rows(c, joint_rows, COUNT(joint_rows), &p->joint[n], prefix)) < 0)
            return r;
        if (s->unlock_joints_mask & (1 << n)) {
            rtapi_print_msg(RTAPI_MSG_WARN, "motion.c: Creating unlock hal pins for joint %d\n", n);
            if ((r = make_rows(c, unlock_rows, COUNT(unlock_rows), &p->joint[n], prefix)) < 0)
                return r;
        }
        if (n >= s->joints - s->extra_joints &&
            (r = make_rows(c, extra_rows, COUNT(extra_rows), &p->joint[n], prefix)) < 0)
            return r;
    }
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        rtapi_snprintf(prefix, sizeof(prefix), "axis.%c", letters[n]);
        if ((r = make_rows(c, axis_rows, COUNT(axis_rows), &p->axis[n], prefix)) < 0)
            return r;
    }
    for (int n = 0; n < s->spindles; n++) {
        rtapi_snprintf(prefix, sizeof(prefix), "spindle.%d", n);
        if ((r = make_rows(c, spindle_rows, COUNT(spindle_rows), &p->spindle[n], prefix)) < 0)
            return r;
    }
    return make_params(m);
}
