/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * motion.c - loads and unloads motmod.
 *
 * In:     module parameters; kinematics, planner and homing modules loaded before
 * Out:    pins, the functions motion-controller and motion-command-handler, the
 *         threads, the shared segment
 * Thread: init
 */
#include <limits.h>
#include <string.h>
#include "motion_priv.h"
#include "rtapi_app.h"

MODULE_AUTHOR("Kerf");
MODULE_DESCRIPTION("Motion controller");
MODULE_LICENSE("GPL");

static int key = DEFAULT_SHMEM_KEY;
RTAPI_MP_INT(key, "shared memory key");
static long base_period_nsec = 0;
RTAPI_MP_LONG(base_period_nsec, "fastest thread period (nsecs)");
static int base_thread_fp = 0;
RTAPI_MP_INT(base_thread_fp, "deprecated, no effect");
static long servo_period_nsec = 1000000;
RTAPI_MP_LONG(servo_period_nsec, "servo thread period (nsecs)");
static long traj_period_nsec = 0;
RTAPI_MP_LONG(traj_period_nsec, "trajectory planner period (nsecs)");
static int num_spindles = 1;
RTAPI_MP_INT(num_spindles, "number of spindles");
static int num_joints = EMCMOT_MAX_JOINTS;
RTAPI_MP_INT(num_joints, "number of joints, extra joints included");
static int num_extrajoints = 0;
RTAPI_MP_INT(num_extrajoints, "number of extra joints");
static int num_dio = 0;
RTAPI_MP_INT(num_dio, "number of digital inputs and outputs");
static char *names_din[EMCMOT_MAX_DIO];
RTAPI_MP_ARRAY_STRING(names_din, EMCMOT_MAX_DIO, "names of digital inputs");
static char *names_dout[EMCMOT_MAX_DIO];
RTAPI_MP_ARRAY_STRING(names_dout, EMCMOT_MAX_DIO, "names of digital outputs");
static int num_aio = 0;
RTAPI_MP_INT(num_aio, "number of analog inputs and outputs");
static char *names_ain[EMCMOT_MAX_AIO];
RTAPI_MP_ARRAY_STRING(names_ain, EMCMOT_MAX_AIO, "names of analog inputs");
static char *names_aout[EMCMOT_MAX_AIO];
RTAPI_MP_ARRAY_STRING(names_aout, EMCMOT_MAX_AIO, "names of analog outputs");
static int num_misc_error = 0;
RTAPI_MP_INT(num_misc_error, "number of error inputs");
static char *names_misc_errors[EMCMOT_MAX_MISC_ERROR];
RTAPI_MP_ARRAY_STRING(names_misc_errors, EMCMOT_MAX_MISC_ERROR, "names of error inputs");
static int unlock_joints_mask = 0;
RTAPI_MP_INT(unlock_joints_mask, "mask of joints with unlock pins");

static int stall_hold = -1;
RTAPI_MP_INT(stall_hold, "ms between two cycles that hold motion, 0 never, -1: 20 where there is realtime");

#define DEFAULT_DIO 4
#define DEFAULT_STALL_HOLD_MS 20
#define DEFAULT_AIO 4

struct motion motion_state_;
static int shmem_id = -1;

static void refuse(const char *fmt, ...) __attribute__((format(printf, 1, 2)));
static void refuse(const char *fmt, ...)
{
    char text[256];
    va_list ap;
    va_start(ap, fmt);
    rtapi_vsnprintf(text, sizeof(text), fmt, ap);
    va_end(ap);
    rtapi_print_msg(RTAPI_MSG_ERR, "%s", text);
}

static int names_given(char *const *names, int max)
{
    int n = 0;
    while (n < max && names[n] && names[n][0])
        n++;
    return n;
}

/* Number of channels of a kind: from the names or from the number, not both. Returns < 0 when refused. */
static int channels(const char *what, const char *parameter, int number, int named, int fallback, int min, int max)
{
    if (named && number) {
        refuse("MOTION: Can't specify both names and number for %s\n", what);
        return -1;
    }
    if (named)
        return named;
    if (number == 0)
        number = fallback;
    if (number < min || number > max) {
        refuse("MOTION: %s is %d, must be between %d and %d\n", parameter, number, min, max);
        return -1;
    }
    return number;
}

static int max_int(int a, int b) { return a > b ? a : b; }

static int read_sizes(struct motion_sizes *s)
{
    if (num_joints < 1 || num_joints > EMCMOT_MAX_JOINTS) {
        refuse("MOTION: num_joints is %d, must be between 1 and %d\n", num_joints, EMCMOT_MAX_JOINTS);
        return -1;
    }
    if (num_extrajoints < 0 || num_extrajoints > num_joints) {
        refuse("\nMOTION: num_extrajoints is %d, must be between 0 and %d\n\n", num_extrajoints, num_joints);
        return -1;
    }
    if (num_extrajoints > 0 && motion_state_.kin_type != KINEMATICS_BOTH) {
        refuse("\nMOTION: nonzero num_extrajoints requires KINEMATICS_BOTH\n\n");
        return -1;
    }
    if (num_extrajoints > 0)
        refuse("\nMOTION: kinematicjoints=%2d\n            extrajoints=%2d\n           Total joints=%2d\n\n",
               num_joints - num_extrajoints, num_extrajoints, num_joints);
    if (num_spindles < 0 || num_spindles > EMCMOT_MAX_SPINDLES) {
        refuse("MOTION: num_spindles is %d, must be between 0 and %d\n", num_spindles, EMCMOT_MAX_SPINDLES);
        return -1;
    }
    int dio = channels("digital pins", "num_dio", num_dio,
                       max_int(names_given(names_din, EMCMOT_MAX_DIO), names_given(names_dout, EMCMOT_MAX_DIO)),
                       DEFAULT_DIO, 1, EMCMOT_MAX_DIO);
    int aio = channels("analog pins", "num_aio", num_aio,
                       max_int(names_given(names_ain, EMCMOT_MAX_AIO), names_given(names_aout, EMCMOT_MAX_AIO)),
                       DEFAULT_AIO, 1, EMCMOT_MAX_AIO);
    int misc = channels("misc error", "num_misc_error", num_misc_error,
                        names_given(names_misc_errors, EMCMOT_MAX_MISC_ERROR), 0, 0, EMCMOT_MAX_MISC_ERROR);
    if (dio < 0 || aio < 0 || misc < 0)
        return -1;
    struct motion_sizes sizes = {num_joints, num_extrajoints, num_spindles, dio, aio, misc, unlock_joints_mask,
                                 names_din, names_dout, names_ain, names_aout, names_misc_errors};
    *s = sizes;
    return 0;
}

static int make_threads(void)
{
    if (base_period_nsec == 0)
        base_period_nsec = servo_period_nsec;
    if (traj_period_nsec == 0)
        traj_period_nsec = servo_period_nsec;
    if (servo_period_nsec < base_period_nsec) {
        refuse("MOTION: bad servo period %ld nsec\n", servo_period_nsec);
        return -1;
    }
    long ratio = (long)((double)servo_period_nsec / (double)base_period_nsec + 0.5);
    servo_period_nsec = base_period_nsec * ratio;
    if (ratio > 1 && hal_create_thread("base-thread", (unsigned long)base_period_nsec, 1) < 0) {
        refuse("MOTION: failed to create %ld nsec base thread\n", base_period_nsec);
        return -1;
    }
    if (hal_create_thread("servo-thread", (unsigned long)servo_period_nsec, 1) < 0) {
        refuse("MOTION: failed to create %ld nsec servo thread\n", servo_period_nsec);
        return -1;
    }
    return 0;
}

static int make_segment(struct motion *m)
{
    void *memory = NULL;
    shmem_id = rtapi_shmem_new(key, m->comp_id, sizeof(emcmot_struct_t));
    if (shmem_id < 0 || rtapi_shmem_getptr(shmem_id, &memory) < 0) {
        refuse("MOTION: rtapi_shmem_new failed, returned %d\n", shmem_id);
        return -1;
    }
    m->shared = memory;
    m->command = &m->shared->command; /* may hold a command of task already */
    m->status = &m->shared->status;
    m->config = &m->shared->config;
    m->internal = &m->shared->internal;
    m->joint = m->internal->joints;
    emcmotErrorInit(&m->shared->error);
    return 0;
}

/* ---- what a planner may ask of the machine ---- */

static int planner_joints(void)
{
    return kin_joints(&motion_state_);
}

/* Asking does not choose: the flags of the real position stay as they are. */
/* Where the joints are for a place of the path, with the external offsets of now. */
static int planner_inverse(const EmcPose *pose, double *joint)
{
    KINEMATICS_INVERSE_FLAGS iflags = motion_state_.iflags;
    KINEMATICS_FORWARD_FLAGS fflags = motion_state_.fflags;
    EmcPose with = *pose;
    axis_apply_eoffsets(&motion_state_, &with, 1);
    return kinematicsInverse(&with, joint, &iflags, &fflags);
}

static void planner_joint_commands(double *joint)
{
    for (int j = 0; j < EMCMOT_MAX_JOINTS; j++)
        joint[j] = motion_state_.joint[j].coarse_pos;
}

static void planner_joint_limits(int joint, double *vel, double *acc, double *jerk)
{
    struct joint_limits l = offset_share_path(&motion_state_, joint);
    *vel = l.vel;
    *acc = l.acc;
    *jerk = l.jerk;
}

static const struct tp_machine planner_machine = {planner_joints, planner_inverse, planner_joint_commands,
                                                  planner_joint_limits, axis_get_jerk_limit};

/* A user's planner need not have it. */
#pragma weak tpMotMachine

static int bind_modules(struct motion *m)
{
    if (tpMotMachine)
        tpMotMachine(&planner_machine);
    tpMotFunctions(dio_write, aio_write, rotary_unlock, rotary_is_unlocked, axis_get_vel_limit, axis_get_acc_limit);
    tpMotData(m->status, &m->config_work);
    if (tpCreate(&m->tp, DEFAULT_TC_QUEUE_SIZE, m->comp_id) != 0) {
        refuse("MOTION: failed to create motion planner\n");
        return -1;
    }
    homeMotFunctions(rotary_unlock, rotary_is_unlocked);
    if (homing_init(m->comp_id, (double)servo_period_nsec * 1e-9, m->num_joints, m->num_extra, m->joint) != 0) {
        refuse("MOTION: homing_init() failed\n");
        return -1;
    }
    return 0;
}

static int load(struct motion *m)
{
    struct motion_sizes sizes;
    m->kin_type = kinematicsType();
    if (read_sizes(&sizes) != 0)
        return -1;
    m->num_joints = sizes.joints;
    m->num_extra = sizes.extra_joints;
    m->num_spindles = sizes.spindles;
    if (make_segment(m) != 0)
        return -1;
    if (pins_create(m, &sizes) < 0) {
        refuse("MOTION: failed to create pins\n");
        return -1;
    }
    state_init(m, &sizes);
    if (stall_hold < 0)
        stall_hold = rtapi_is_realtime() ? DEFAULT_STALL_HOLD_MS : 0;
    m->stall_hold_ns = stall_hold * 1000000LL;
    if (make_threads() != 0)
        return -1;
    if (bind_modules(m) != 0)
        return -1;
    cycle_times(m, servo_period_nsec);
    config_publish(m);
    if (hal_export_funct("motion-controller", motion_controller, m, 1, 0, m->comp_id) < 0 ||
        hal_export_funct("motion-command-handler", motion_command_handler, m, 1, 0, m->comp_id) < 0) {
        refuse("MOTION: failed to export functions\n");
        return -1;
    }
    return 0;
}

static void release(struct motion *m)
{
    report_unhook();
    m->shared = NULL;
    if (shmem_id >= 0)
        rtapi_shmem_delete(shmem_id, m->comp_id);
    shmem_id = -1;
    if (m->comp_id > 0)
        hal_exit(m->comp_id);
}

int rtapi_app_main(void)
{
    struct motion *m = &motion_state_;
    memset(m, 0, sizeof(*m));
    m->comp_id = hal_init("motmod");
    if (m->comp_id < 0) {
        refuse("MOTION: hal_init() failed\n");
        return -1;
    }
    if (load(m) != 0) {
        release(m);
        return -1;
    }
    report_hook();
    hal_ready(m->comp_id);
    return 0;
}

void rtapi_app_exit(void)
{
    hal_stop_threads();
    release(&motion_state_);
}

/* Read by cycle_times(). */
long motion_traj_period_nsec(void) { return traj_period_nsec; }
