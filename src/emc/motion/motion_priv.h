/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * motion_priv.h - the parts of motmod and what they share.
 *
 * One struct motion holds all state. The servo cycle (cycle.c) is a fixed list of
 * phases; each is one function declared here with what it reads and writes.
 * Everything marked [servo] is bounded: loops run over at most EMCMOT_MAX_*.
 */
#ifndef KERF_MOTION_PRIV_H
#define KERF_MOTION_PRIV_H

#include "cubic.h"
#include "emcmotutil.h"
#include "emcpose.h"
#include "hal.h"
#include "homing.h"
#include "motion.h"
#include "tp.h"

#define ALL_SPINDLES (-1)

/* ---- HAL pins (pins.c) ---------------------------------------------------- */

struct joint_pins {
    hal_real_t coarse_pos_cmd, pos_cmd, pos_fb, motor_pos_cmd, motor_pos_fb, motor_offset;
    hal_bool_t pos_lim_sw_in, neg_lim_sw_in, amp_enable_out, amp_fault_in;
    hal_sint_t jog_counts;
    hal_bool_t jog_enable, jog_vel_mode;
    hal_real_t jog_scale, jog_accel_fraction;
    hal_real_t vel_cmd, acc_cmd, jerk_cmd, backlash_corr, backlash_filt, backlash_vel;
    hal_real_t f_error, f_error_lim, free_pos_cmd, free_vel_lim;
    hal_bool_t free_tp_enable, kb_jog_active, wheel_jog_active, in_position;
    hal_bool_t pos_hard_limit, neg_hard_limit, active, error, f_errored, faulted;
    hal_bool_t unlock, is_unlocked; /* null without a bit in unlock_joints_mask */
    hal_real_t posthome_cmd;        /* null unless an extra joint */
};

struct axis_pins {
    hal_real_t pos_cmd, teleop_vel_cmd, teleop_pos_cmd, teleop_vel_lim;
    hal_bool_t teleop_tp_enable, eoffset_enable, eoffset_clear;
    hal_sint_t eoffset_counts;
    hal_real_t eoffset_scale, eoffset, eoffset_request;
    hal_bool_t jog_enable, jog_vel_mode;
    hal_real_t jog_scale, jog_accel_fraction;
    hal_sint_t jog_counts;
    hal_bool_t kb_jog_active, wheel_jog_active;
};

struct spindle_pins {
    hal_bool_t index_enable, on, forward, reverse, brake;
    hal_real_t speed_out, speed_out_abs, speed_out_rps, speed_out_rps_abs, speed_cmd_rps;
    hal_bool_t inhibit, amp_fault_in;
    hal_real_t orient_angle;
    hal_sint_t orient_mode;
    hal_bool_t orient, locked, is_oriented;
    hal_sint_t orient_fault;
    hal_real_t revs, speed_in;
    hal_bool_t at_speed;
};

struct motion_pins {
    hal_bool_t probe_input;
    hal_real_t adaptive_feed;
    hal_bool_t feed_hold, feed_inhibit, homing_inhibit, jog_inhibit, jog_stop, jog_stop_immediate;
    hal_bool_t tp_reverse, enable, is_all_homed;
    hal_real_t feed_upm, feed_ipm, feed_ips, feed_mmpm, feed_mmps;
    hal_bool_t digital_in[EMCMOT_MAX_DIO], digital_out[EMCMOT_MAX_DIO];
    hal_real_t analog_in[EMCMOT_MAX_AIO], analog_out[EMCMOT_MAX_AIO];
    hal_bool_t misc_error[EMCMOT_MAX_MISC_ERROR];
    hal_bool_t motion_enabled, in_position, coord_mode, teleop_mode, coord_error, on_soft_limit;
    hal_sint_t motion_type, program_line;
    hal_real_t current_vel, requested_vel, distance_to_go;
    hal_bool_t jog_is_active;
    hal_sint_t interp_line, interp_motion_type;
    hal_real_t interp_feedrate, interp_arc_radius, interp_arc_center[3], interp_heading, interp_normal_heading;
    hal_bool_t interp_iscircle;
    hal_uint_t last_period;
    hal_real_t tooloffset[EMCMOT_MAX_AXIS];
    hal_real_t switchkins_type; /* null unless the kinematics can be switched */
    hal_bool_t eoffset_active, eoffset_limited;
    hal_bool_t debug_bit[2];
    hal_real_t debug_float[4];
    hal_sint_t debug_s32[2];
    hal_real_t traj_pos_out, traj_vel_out;
    hal_uint_t traj_active_tc;
    hal_real_t tc_pos[4], tc_vel[4], tc_acc[4];
    struct joint_pins joint[EMCMOT_MAX_JOINTS];
    struct axis_pins axis[EMCMOT_MAX_AXIS];
    struct spindle_pins spindle[EMCMOT_MAX_SPINDLES];
};

/* ---- state ---------------------------------------------------------------- */

struct teleop_scale {
    double vel, acc, jerk; /* parts of the axes' limits, 0..1 */
    int crowded;           /* no axis may get faster now */
};

struct axis {
    double min_pos_limit, max_pos_limit; /* both 0: not configured */
    double joint_lo, joint_hi;           /* where the jog in progress meets a joint's limit; infinite: not known */
    double vel_limit, acc_limit, jerk_limit;
    double ext_offset_vel_limit, ext_offset_acc_limit;
    int locking_joint;                   /* -1 none */
    double jog_vel;                      /* asked for, >= 0 */
    simple_tp_t teleop_tp;               /* position without external offset */
    simple_tp_t ext_offset_tp;           /* external offset */
    int kb_ajog_active, wheel_ajog_active;
    int old_ajog_counts, old_eoffset_counts;
    int eoffset_counts_known;
    struct teleop_scale part;            /* in effect, teleop mode */
    struct teleop_scale offset_part;     /* of the offset planner's limits in coordinated mode; 0 not known */
    double jog_acc_scale;                /* of the wheel jog in progress, else 1 */
};

struct joint_limits {
    double vel, acc, jerk; /* units/s, /s^2, /s^3; jerk 0: none */
};

struct axis_reach {
    double lo, hi; /* units */
};

/* Sizes given at load. */
struct motion_sizes {
    int joints, extra_joints, spindles, dio, aio, misc_errors;
    int unlock_joints_mask;
    char **names_din, **names_dout, **names_ain, **names_aout, **names_misc;
};

struct motion {
    emcmot_struct_t *shared;
    emcmot_command_t *command;
    emcmot_status_t *status;
    emcmot_config_t *config;
    emcmot_internal_t *internal;
    emcmot_joint_t *joint; /* internal->joints */
    struct motion_pins *pins;
    int comp_id;
    int num_joints, num_extra, num_spindles; /* as loaded */
    KINEMATICS_TYPE kin_type;
    KINEMATICS_FORWARD_FLAGS fflags;
    KINEMATICS_INVERSE_FLAGS iflags;
    int switchkins_type; /* in effect */
    int kins_failed_type; /* last refused type, INT_MIN none */

    TP_STRUCT tp;
    cubic_t cubic[EMCMOT_MAX_JOINTS];
    struct axis axis[EMCMOT_MAX_AXIS];
    struct axis axis_was[EMCMOT_MAX_AXIS]; /* before the step of this cycle */
    emcmot_config_t config_work; /* published by config_publish() */

    long period_ns;            /* of the servo cycle, 0 before the first */
    double servo_period, traj_period; /* s */
    int interpolation_rate;
    long long last_start_ns;
    long long stall_hold_ns;   /* between two cycles, at most; 0: any time */
    int first_pass;            /* wheel counters are only read */

    int pending_planner_type;  /* -1 none */
    int planner_deferral_told;
    int settle;                /* cycles since the planner finished, saturating */
    int aligning;              /* joints go to where kinematics wants them before teleop or coord */
    double align_to[EMCMOT_MAX_JOINTS];
    int coord_moved;           /* a coordinated move was queued since homing (INVERSE_ONLY) */
    int probe_stops;           /* a probe move runs or comes to rest */
    double probe_held;         /* s that the probe input has been on; infinite: by a probe move */
    int index_was[EMCMOT_MAX_SPINDLES]; /* request as last written to the pin */
    double pos_was[EMCMOT_MAX_JOINTS][2];      /* pos_cmd of the last two cycles, newest first */
    double joint_acc_scale[EMCMOT_MAX_JOINTS]; /* wheel jog's fraction, else 1 */
    int joint_violated[EMCMOT_MAX_JOINTS];     /* soft limit message given */
    int eoffset_limited;
    int path_waits;            /* 1: held, so that path and offsets stay within the limits */
    int offsets_wait;          /* 1: they stop, and go on after a change of mode */
    EmcPose queue_end;         /* of the last move that was queued */
    EmcPose path_was;          /* the planner's position of the cycle before */
    double offset_share[EMCMOT_MAX_JOINTS]; /* of a joint's limits, for external offsets */
    int offset_axes[EMCMOT_MAX_JOINTS];     /* number of axes whose offsets move the joint */
    int jog_was_active;
    char wait_atspeed_told;
};

extern struct motion motion_state_;

/* ---- small access --------------------------------------------------------- */

static inline int motion_flag(const struct motion *m, int bit) { return (m->status->motionFlag & bit) != 0; }
static inline void set_motion_flag(struct motion *m, int bit, int on)
{
    m->status->motionFlag = on ? m->status->motionFlag | bit : m->status->motionFlag & ~bit;
}
static inline int joint_flag(const emcmot_joint_t *j, int bit) { return (j->flag & bit) != 0; }
static inline void set_joint_flag(emcmot_joint_t *j, int bit, int on)
{
    j->flag = on ? j->flag | bit : j->flag & ~bit;
}
static inline int is_enabled(const struct motion *m) { return motion_flag(m, EMCMOT_MOTION_ENABLE_BIT); }
static inline int is_coord(const struct motion *m) { return motion_flag(m, EMCMOT_MOTION_COORD_BIT); }
static inline int is_teleop(const struct motion *m) { return motion_flag(m, EMCMOT_MOTION_TELEOP_BIT); }
static inline int is_inpos(const struct motion *m) { return motion_flag(m, EMCMOT_MOTION_INPOS_BIT); }
static inline int is_active(const emcmot_joint_t *j) { return joint_flag(j, EMCMOT_JOINT_ACTIVE_BIT); }
/* Joints in use, and of those the ones kinematics knows. */
static inline int all_joints(const struct motion *m) { return m->config_work.numJoints; }
static inline int kin_joints(const struct motion *m)
{
    int n = m->config_work.numJoints - m->num_extra;
    return n > 0 ? n : 0;
}
static inline int is_extra(const struct motion *m, int j) { return j >= kin_joints(m); }

/* ---- messages (report.c) -------------------------------------------------- */

/* [any] Operator error: into the error ring and on the console. */
void report_error(const char *fmt, ...) __attribute__((format(printf, 1, 2)));
/* [init] RTAPI errors of this process also become operator errors. */
void report_hook(void);
void report_unhook(void);

/* ---- load ----------------------------------------------------------------- */

/* [init] Creates all pins and parameters; 0, or a negative errno. */
int pins_create(struct motion *m, const struct motion_sizes *sizes);
/* [init] Startup values of status, configuration, joints and axes. */
void state_init(struct motion *m, const struct motion_sizes *sizes);
/* [servo] Makes a changed config_work visible with a new config_num. */
void config_publish(struct motion *m);
/* [servo] Times of planner and interpolators from the period of the caller. */
void cycle_times(struct motion *m, long period_ns);
/* [any] The planner period asked for at load. */
long motion_traj_period_nsec(void);

/* ---- functions of the servo thread ---------------------------------------- */

void motion_command_handler(void *arg, long period_ns); /* command.c */
void motion_controller(void *arg, long period_ns);      /* cycle.c */

/* ---- phases, in order (cycle.c calls them) -------------------------------- */

void phase_switch_kinematics(struct motion *m);  /* mode.c:   switchkins pin -> kinematics, carte_pos_cmd */
void phase_inputs(struct motion *m);             /* input.c:  pins -> spindles, scales, joints' feedback and flags */
void phase_forward(struct motion *m);            /* input.c:  pos_fb -> carte_pos_fb */
void phase_probe(struct motion *m);              /* probe.c:  probe pin -> probedPos, abort */
void phase_faults(struct motion *m);             /* mode.c:   joint flags, pins -> enabling, messages */
void phase_mode(struct motion *m);               /* mode.c:   requests -> motionFlag, motion_state */
void phase_joint_wheels(struct motion *m);       /* jog.c:    jog-counts -> free_tp */
void phase_axis_wheels(struct motion *m);        /* jog.c:    jog-counts -> teleop_tp */
void phase_homing(struct motion *m);             /* mode.c:   homing module -> free_tp, joints */
void phase_planner_type(struct motion *m);       /* mode.c:   pending type -> status.planner_type */
void phase_position(struct motion *m);           /* position.c: planners -> pos_cmd of each joint */
void phase_compensation(struct motion *m);       /* comp.c:   pos_cmd, vel_cmd -> backlash_filt */
void phase_eoffset(struct motion *m);            /* eoffset.c: eoffset pins -> ext_offset_tp */
void phase_output(struct motion *m);             /* output.c: everything -> pins */
void phase_status(struct motion *m);             /* output.c: everything -> status block */

/* ---- services between the parts ------------------------------------------- */

/* mode.c */
void request_coord(struct motion *m);
void request_teleop(struct motion *m);
void request_free(struct motion *m);
/* Stops motion along the path: planner abort; sets no flag. */
void abort_planner(struct motion *m);
/* Motion ERROR flag with planner abort. */
void fail_motion(struct motion *m);
int kinematics_forward(struct motion *m, const double *joint, EmcPose *pose);
int kinematics_inverse(struct motion *m, const EmcPose *pose, double *joint);
/* 1: the planner is done and the interpolators delivered its last point. */
int coord_in_position(struct motion *m);

/* axis.c: axis planners */
void axis_init(struct motion *m);
void axes_sync_to(struct motion *m, const EmcPose *pose); /* at rest there */
void axes_abort(struct motion *m, int immediate);
void jogs_end(struct motion *m, int immediate);
/* Units: below any encoder; interpolated positions round by more than 1e-12. */
#define LIMIT_EPSILON 1e-9

/* [servo] 1: a jog from here to target ends farther outside the limits than it begins. */
static inline int leads_out(double target, double from, double lo, double hi)
{
    return target > (from > hi ? from : hi) || target < (from < lo ? from : lo);
}
int axes_jogging(const struct motion *m);
int axes_moving(const struct motion *m);
/* [servo] 1: at q a homed joint would be farther outside its limits (less the rounding of stops)
 * than it is, by eps units. */
int joints_go_outside(const struct motion *m, const double *q, double eps);
void axis_teleop_step(struct motion *m, EmcPose *pose);   /* -> positions with offsets */
/* Speed (units/s, >= 0) that a planner has or cannot avoid any more. */
double axis_speed_ahead(const simple_tp_t *tp);
double axis_get_vel_limit(int axis);
double axis_get_acc_limit(int axis);
double axis_get_jerk_limit(int axis); /* 0: none */

/* teleop_scale.c: parts of the axes' limits that keep the joints within theirs */
void teleop_scale(struct motion *m, struct teleop_scale *scale);

/* offset_share.c: the joints' limits between the path and the external offsets */

/* Finds out which joints external offsets move: their limits are shared from now on. At rest. */
void offset_share_find(struct motion *m);
/* What the path may use of the limits of joint j. */
struct joint_limits offset_share_path(const struct motion *m, int j);
/* Sets each axis' offset_part so that the joints keep within the rest; path: this cycle's. */
void offset_share_scale(struct motion *m, const EmcPose *path);
/* 1: with the path at pose (and the offsets where they can stop) joints get farther out of their
 * limits than they are. */
int offset_share_leaves(struct motion *m, const EmcPose *pose);

void override_status(struct motion *m); /* override.c */

/* eoffset.c: external offsets */
int axis_has_no_limits(const struct axis *a);
int eoffsets_moving(const struct motion *m);
/* Sets the limits of a's offset planner; 0: the axis takes no offsets. */
int eoffset_prepare(struct axis *a);
/* 1: the path must be held this cycle so that path and offset together stay within the limits. */
int eoffset_path_waits(struct motion *m);
void eoffset_coord_step(struct motion *m, EmcPose *pose); /* adds offsets within limits */
/* Joints take over the motion: offsets stay where they are. */
void eoffsets_hand_over(struct motion *m);
void axis_apply_eoffsets(const struct motion *m, EmcPose *pose, int direction);
void axis_zero_eoffsets(struct motion *m);
int axis_eoffsets_applied(const struct motion *m, EmcPose *offsets);
/* The targets of enabled offsets, else NAN; stops all offsets; gives the targets back. */
void eoffsets_asked(struct motion *m, double asked[EMCMOT_MAX_AXIS]);
void eoffsets_hold(struct motion *m);
void eoffsets_release(struct motion *m, const double asked[EMCMOT_MAX_AXIS]);
/* One step of period T (s) towards a target within [lo, hi]; the planner's own target stays. */
void axis_step_within(simple_tp_t *tp, double lo, double hi, double T);
/* Where a planner may still get to when it stops now. */
struct axis_reach axis_reach_of(const simple_tp_t *tp, double T);

/* range.c: 1 when a point, or an arc from the end of the queue, is within the limits; else reported. */
int in_range(struct motion *m, const EmcPose *pos, int id, const char *kind);
int arc_in_range(struct motion *m, const emcmot_command_t *c);
/* The same for a line, on the way to which joints of other kinematics may bulge. */
int line_in_range(struct motion *m, const emcmot_command_t *c, const char *kind);

/* jog.c */
void joint_stop(struct motion *m, int j, int immediate);
void joints_stop(struct motion *m, int immediate);
int any_jog_active(const struct motion *m);
void refresh_jog_limits(struct motion *m, int j);

/* position.c: fills the interpolators with the present joint commands; joints that
 * kinematics would make jump (a racked gantry) are first moved there within limits. */
void position_enter_cartesian(struct motion *m);
/* 1: nothing is left in the interpolators. */
int position_at_rest(const struct motion *m);
/* Joint planners take over the present motion and stop it. */
void position_enter_free(struct motion *m);

/* comp.c */
void comp_init(emcmot_joint_t *joint);
void comp_set_backlash(emcmot_joint_t *joint, double backlash);
/* 0, -1 table full, -2 nominal does not increase. */
int comp_add(emcmot_joint_t *joint, double nominal, double forward, double reverse);
/* [servo] What compensation leaves of a joint's limits to the motion that is commanded. */
struct joint_limits joint_motion_limits(const emcmot_joint_t *jt);

/* spindle.c */
void spindle_inputs(struct motion *m);
void spindle_output(struct motion *m);
void spindle_index(struct motion *m);
void spindle_orient(struct motion *m); /* one cycle of orientation */

/* io.c: outputs, rotary locks; also callbacks of planner and homing */
void dio_write(int index, char value);
void aio_write(int index, double value);
void rotary_unlock(int joint, int unlock);
int rotary_is_unlocked(int joint);

#endif
