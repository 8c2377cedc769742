/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * motion_logger.c - stands in for motmod and writes down the commands of task.
 *
 * In:     commands of the shared segment (key 100)
 * Out:    one line a command, in LOGFILE or on standard output; a status of a
 *         machine that is always in position and answers OK
 * Thread: task; needs no realtime process
 * Usage:  motion-logger [LOGFILE]
 */
#include <errno.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include "emcmotutil.h"
#include "hal.h"
#include "kerf_clock.h"
#include "usrmotintf.h"

#define IDLE_NS 10000000       /* between looks when nothing comes */
#define BUSY_NS 100000         /* for a while after a command */
#define BUSY_LOOKS 100

static volatile sig_atomic_t quit;
static const char *log_name; /* null: standard output */
static FILE *log_file;
static emcmot_struct_t *shared;

static struct {
    hal_bool_t reopen_log;
} *pins;

static void on_signal(int number)
{
    (void)number;
    quit = 1;
}

static void open_log(void)
{
    log_file = log_name ? fopen(log_name, "w") : stdout;
    if (log_file)
        return;
    fprintf(stderr, "motion-logger: cannot write %s: %s\n", log_name, strerror(errno));
    exit(1);
}

static void say(const char *fmt, ...) __attribute__((format(printf, 1, 2)));
static void say(const char *fmt, ...)
{
    va_list ap;
    if (!log_file)
        open_log();
    va_start(ap, fmt);
    vfprintf(log_file, fmt, ap);
    va_end(ap);
    fputc('\n', log_file);
    fflush(log_file);
}

/* The pin asks for a new file. */
static void reopen_when_asked(void)
{
    if (!hal_get_bool(pins->reopen_log))
        return;
    if (log_file && log_file != stdout) {
        fclose(log_file);
        open_log();
    }
    hal_set_bool(pins->reopen_log, 0);
}

/* ---- lines ---- */

#define POSE_FMT "x=%.6g, y=%.6g, z=%.6g, a=%.6g, b=%.6g, c=%.6g, u=%.6g, v=%.6g, w=%.6g"
#define POSE_ARGS(p) (p).tran.x, (p).tran.y, (p).tran.z, (p).a, (p).b, (p).c, (p).u, (p).v, (p).w

/* Names of commands that are logged with their name alone. */
static const char *plain_name(cmd_code_t code)
{
    static const char *const names[] = {
        [EMCMOT_ABORT] = "ABORT", [EMCMOT_ENABLE] = "ENABLE", [EMCMOT_DISABLE] = "DISABLE",
        [EMCMOT_PAUSE] = "PAUSE", [EMCMOT_RESUME] = "RESUME", [EMCMOT_STEP] = "STEP", [EMCMOT_FREE] = "FREE",
        [EMCMOT_COORD] = "COORD", [EMCMOT_TELEOP] = "TELEOP", [EMCMOT_SPINDLE_SCALE] = "SPINDLE_SCALE",
        [EMCMOT_SS_ENABLE] = "SS_ENABLE", [EMCMOT_FEED_SCALE] = "FEED_SCALE",
        [EMCMOT_RAPID_SCALE] = "RAPID_SCALE", [EMCMOT_FS_ENABLE] = "FS_ENABLE", [EMCMOT_FH_ENABLE] = "FH_ENABLE",
        [EMCMOT_AF_ENABLE] = "AF_ENABLE", [EMCMOT_OVERRIDE_LIMITS] = "OVERRIDE_LIMITS",
        [EMCMOT_JOG_CONT] = "JOG_CONT", [EMCMOT_JOG_INCR] = "JOG_INCR", [EMCMOT_JOG_ABS] = "JOG_ABS",
        [EMCMOT_CLEAR_PROBE_FLAGS] = "CLEAR_PROBE_FLAGS", [EMCMOT_PROBE] = "PROBE",
        [EMCMOT_RIGID_TAP] = "RIGID_TAP", [EMCMOT_SET_DEBUG] = "SET_DEBUG", [EMCMOT_SET_DOUT] = "SET_DOUT",
        [EMCMOT_SET_AOUT] = "SET_AOUT", [EMCMOT_SPINDLE_OFF] = "SPINDLE_OFF",
        [EMCMOT_SPINDLE_INCREASE] = "SPINDLE_INCREASE", [EMCMOT_SPINDLE_DECREASE] = "SPINDLE_DECREASE",
        [EMCMOT_SPINDLE_BRAKE_ENGAGE] = "SPINDLE_BRAKE_ENGAGE",
        [EMCMOT_SPINDLE_BRAKE_RELEASE] = "SPINDLE_BRAKE_RELEASE", [EMCMOT_SPINDLE_ORIENT] = "SPINDLE_ORIENT",
        [EMCMOT_SET_JOINT_MOTOR_OFFSET] = "SET_JOINT_MOTOR_OFFSET", [EMCMOT_SET_JOINT_COMP] = "SET_JOINT_COMP",
        [EMCMOT_SETUP_ARC_BLENDS] = "SETUP_ARC_BLENDS",
    };
    return (size_t)code < sizeof(names) / sizeof(names[0]) ? names[code] : NULL;
}

static const char *joint_name(cmd_code_t code)
{
    switch (code) {
    case EMCMOT_JOG_ABORT: return "JOG_ABORT";
    case EMCMOT_JOINT_ACTIVATE: return "JOINT_ACTIVATE";
    case EMCMOT_JOINT_DEACTIVATE: return "JOINT_DEACTIVATE";
    case EMCMOT_JOINT_HOME: return "JOINT_HOME";
    case EMCMOT_JOINT_UNHOME: return "JOINT_UNHOME";
    default: return NULL;
    }
}

static void log_circle(const emcmot_command_t *c)
{
    say("SET_CIRCLE:");
    say("    pos: " POSE_FMT, POSE_ARGS(c->pos));
    say("    center: x=%.6g, y=%.6g, z=%.6g", c->center.x, c->center.y, c->center.z);
    say("    normal: x=%.6g, y=%.6g, z=%.6g", c->normal.x, c->normal.y, c->normal.z);
    say("    id=%d, motion_type=%d, vel=%.6g, ini_maxvel=%.6g, acc=%.6g, turn=%d", c->id, c->motion_type, c->vel,
        c->ini_maxvel, c->acc, c->turn);
}

static void log_command(const emcmot_command_t *c)
{
    if (plain_name(c->command)) {
        say("%s", plain_name(c->command));
        return;
    }
    if (joint_name(c->command)) {
        say("%s joint=%d", joint_name(c->command), c->joint);
        return;
    }
    switch (c->command) {
    case EMCMOT_SET_LINE:
        say("SET_LINE " POSE_FMT ", id=%d, motion_type=%d, vel=%.6g, ini_maxvel=%.6g, acc=%.6g, turn=%d",
            POSE_ARGS(c->pos), c->id, c->motion_type, c->vel, c->ini_maxvel, c->acc, c->turn);
        break;
    case EMCMOT_SET_CIRCLE:
        log_circle(c);
        break;
    case EMCMOT_SET_JOINT_POSITION_LIMITS:
        say("SET_JOINT_POSITION_LIMITS joint=%d, min=%.6g, max=%.6g", c->joint, c->minLimit, c->maxLimit);
        break;
    case EMCMOT_SET_AXIS_POSITION_LIMITS:
        say("SET_AXIS_POSITION_LIMITS axis=%d, min=%.6g, max=%.6g", c->axis, c->minLimit, c->maxLimit);
        break;
    case EMCMOT_SET_AXIS_LOCKING_JOINT:
        say("SET_AXIS_LOCKING_JOINT axis=%d, locking_joint=%d", c->axis, c->joint);
        break;
    case EMCMOT_SET_AXIS_JERK_LIMIT:
        say("SET_AXIS_JERK_LIMIT axis=%d, jerk=%.6g", c->axis, c->jerk);
        break;
    case EMCMOT_SET_JOINT_BACKLASH:
        say("SET_JOINT_BACKLASH joint=%d, backlash=%.6g", c->joint, c->backlash);
        break;
    case EMCMOT_SET_JOINT_MIN_FERROR:
        say("SET_JOINT_MIN_FERROR joint=%d, minFerror=%.6g", c->joint, c->minFerror);
        break;
    case EMCMOT_SET_JOINT_MAX_FERROR:
        say("SET_JOINT_MAX_FERROR joint=%d, maxFerror=%.6g", c->joint, c->maxFerror);
        break;
    case EMCMOT_SET_VEL:
        say("SET_VEL vel=%.6g, ini_maxvel=%.6g", c->vel, c->ini_maxvel);
        break;
    case EMCMOT_SET_VEL_LIMIT:
        say("SET_VEL_LIMIT vel=%.6g", c->vel);
        break;
    case EMCMOT_SET_AXIS_VEL_LIMIT:
        say("SET_AXIS_VEL_LIMIT axis=%d vel=%.6g", c->axis, c->vel);
        break;
    case EMCMOT_SET_JOINT_VEL_LIMIT:
        say("SET_JOINT_VEL_LIMIT joint=%d, vel=%.6g", c->joint, c->vel);
        break;
    case EMCMOT_SET_AXIS_ACC_LIMIT:
        say("SET_AXIS_ACC_LIMIT axis=%d, acc=%.6g", c->axis, c->acc);
        break;
    case EMCMOT_SET_JOINT_ACC_LIMIT:
        say("SET_JOINT_ACC_LIMIT joint=%d, acc=%.6g", c->joint, c->acc);
        break;
    case EMCMOT_SET_ACC:
        say("SET_ACC acc=%.6g", c->acc);
        break;
    case EMCMOT_SET_JERK:
        say("SET_JERK jerk=%.6g", c->jerk);
        break;
    case EMCMOT_SET_JOINT_JERK_LIMIT:
        say("SET_JOINT_JERK_LIMIT joint=%d, jerk=%.6g", c->joint, c->jerk);
        break;
    case EMCMOT_SET_PLANNER_TYPE:
        say("SET_PLANNER_TYPE planner_type=%d", c->planner_type);
        break;
    case EMCMOT_SET_SCURVE_PEAK_SCALE:
        say("SET_SCURVE_PEAK_SCALE scale=%.6g", c->scurve_peak_scale);
        break;
    case EMCMOT_SET_TERM_COND:
        say("SET_TERM_COND termCond=%d, tolerance=%.6g", c->termCond, c->tolerance);
        break;
    case EMCMOT_SET_NUM_JOINTS:
        say("SET_NUM_JOINTS %d", c->joint);
        break;
    case EMCMOT_SET_NUM_SPINDLES:
        say("SET_NUM_SPINDLES %d", c->spindle);
        break;
    case EMCMOT_SET_WORLD_HOME:
        say("SET_WORLD_HOME " POSE_FMT, POSE_ARGS(c->pos));
        break;
    case EMCMOT_SET_OFFSET:
        say("SET_OFFSET x=%.6g, y=%.6g, z=%.6g, a=%.6g, b=%.6g, c=%.6g u=%.6g, v=%.6g, w=%.6g",
            POSE_ARGS(c->tool_offset));
        break;
    case EMCMOT_SET_MAX_FEED_OVERRIDE:
        say("SET_MAX_FEED_OVERRIDE %.6g", c->maxFeedScale);
        break;
    case EMCMOT_SET_PROBE_ERR_INHIBIT:
        say("SETUP_SET_PROBE_ERR_INHIBIT %d %d", c->probe_jog_err_inhibit, c->probe_home_err_inhibit);
        break;
    case EMCMOT_SET_JOINT_HOMING_PARAMS:
        say("SET_JOINT_HOMING_PARAMS joint=%d, offset=%.6g home=%.6g, final_vel=%.6g, search_vel=%.6g, "
            "latch_vel=%.6g, flags=0x%08x, sequence=%d, volatile=%d",
            c->joint, c->offset, c->home, c->home_final_vel, c->search_vel, c->latch_vel, (unsigned)c->flags,
            c->home_sequence, c->volatile_home);
        break;
    case EMCMOT_UPDATE_JOINT_HOMING_PARAMS:
        say("UPDATE_JOINT_HOMING_PARAMS joint=%d, offset=%.6g home=%.6g home_sequence=%d", c->joint, c->offset,
            c->home, c->home_sequence);
        break;
    case EMCMOT_SET_SPINDLE_PARAMS:
        say("SET_SPINDLE_PARAMS, %.2e, %.2e, %.2e, %.2e", c->maxLimit, c->min_pos_speed, c->minLimit,
            c->max_neg_speed);
        break;
    case EMCMOT_SET_SPINDLESYNC:
        say("SET_SPINDLESYNC sync=%06f, flags=0x%08x", c->spindlesync, (unsigned)c->flags);
        break;
    case EMCMOT_SPINDLE_ON:
        say("SPINDLE_ON speed=%f, css_factor=%f, xoffset=%f", c->vel, c->ini_maxvel, c->acc);
        break;
    default:
        say("ERROR: unknown command %d", (int)c->command);
        break;
    }
}

/* ---- status ---- */

static void set_flag(int bit, int on)
{
    shared->status.motionFlag = on ? shared->status.motionFlag | bit : shared->status.motionFlag & ~bit;
}

static void update_state(void)
{
    emcmot_status_t *s = &shared->status;
    int enabled = (s->motionFlag & EMCMOT_MOTION_ENABLE_BIT) != 0;
    s->motion_state = !enabled                                    ? EMCMOT_MOTION_DISABLED
                      : s->motionFlag & EMCMOT_MOTION_TELEOP_BIT ? EMCMOT_MOTION_TELEOP
                      : s->motionFlag & EMCMOT_MOTION_COORD_BIT  ? EMCMOT_MOTION_COORD
                                                                  : EMCMOT_MOTION_FREE;
}

/* What commands change in the pretended machine. */
static void pretend(const emcmot_command_t *c)
{
    emcmot_status_t *s = &shared->status;
    switch (c->command) {
    case EMCMOT_ENABLE:
        set_flag(EMCMOT_MOTION_ENABLE_BIT, 1);
        break;
    case EMCMOT_DISABLE:
        set_flag(EMCMOT_MOTION_ENABLE_BIT, 0);
        break;
    case EMCMOT_FREE:
        set_flag(EMCMOT_MOTION_COORD_BIT | EMCMOT_MOTION_TELEOP_BIT, 0);
        break;
    case EMCMOT_COORD:
        set_flag(EMCMOT_MOTION_COORD_BIT, 1);
        set_flag(EMCMOT_MOTION_TELEOP_BIT, 0);
        break;
    case EMCMOT_TELEOP:
        set_flag(EMCMOT_MOTION_TELEOP_BIT, 1);
        break;
    case EMCMOT_JOINT_HOME:
        for (int j = 0; j < EMCMOT_MAX_JOINTS; j++)
            if (c->joint < 0 || j == c->joint)
                s->joint_status[j].homed = 1;
        break;
    case EMCMOT_SPINDLE_ON:
        s->spindle_status[0].speed = c->vel;
        break;
    case EMCMOT_SPINDLE_OFF:
        s->spindle_status[0].speed = 0.0;
        break;
    case EMCMOT_SET_NUM_JOINTS:
        shared->config.numJoints = c->joint;
        break;
    case EMCMOT_SET_NUM_SPINDLES:
        shared->config.numSpindles = c->spindle;
        break;
    default:
        break;
    }
    update_state();
}

static void init_segment(void)
{
    emcmot_status_t *s = &shared->status;
    emcmot_config_t *c = &shared->config;
    memset(s, 0, sizeof(*s));
    memset(c, 0, sizeof(*c));
    emcmotErrorInit(&shared->error);
    s->motionFlag = EMCMOT_MOTION_INPOS_BIT;
    s->vel = 1.0;
    s->acc = 10.0;
    s->feed_scale = s->rapid_scale = s->net_feed_scale = 1.0;
    s->enables_new = s->enables_queued = SS_ENABLED | FS_ENABLED | FH_ENABLED;
    s->scurve_peak_scale = 1.0;
    s->carte_pos_cmd_ok = s->carte_pos_fb_ok = 1;
    for (int n = 0; n < EMCMOT_MAX_SPINDLES; n++) {
        s->spindle_status[n].scale = s->spindle_status[n].net_scale = 1.0;
        s->spindle_status[n].at_speed = 1;
    }
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        s->axis_status[n].min_pos_limit = -1.0;
        s->axis_status[n].max_pos_limit = 1.0;
    }
    for (int j = 0; j < EMCMOT_MAX_JOINTS; j++)
        s->joint_status[j].flag = EMCMOT_JOINT_ACTIVE_BIT | EMCMOT_JOINT_INPOS_BIT;
    c->kinType = KINEMATICS_IDENTITY;
    c->numJoints = EMCMOT_MAX_JOINTS;
    c->numSpindles = 1;
    c->limitVel = 1.0;
    c->trajCycleTime = c->servoCycleTime = 0.001;
    c->interpolationRate = 1;
    c->config_num = s->config_num = 1;
}

/* Handles a waiting command; 1 when there was one. */
static int look(void)
{
    emcmot_status_t *s = &shared->status;
    static emcmot_command_t c;
    if (!emcmotCommandTryLockUser(shared, getpid()))
        return 0;
    int fresh = shared->command.commandNum != s->commandNumEcho;
    if (fresh) {
        c = shared->command;
        log_command(&c);
        emcmotBlockBegin(&s->head);
        s->commandEcho = c.command;
        s->commandStatus = EMCMOT_COMMAND_OK;
        pretend(&c);
        emcmotBlockEnd(&s->head, &s->tail);
        __atomic_store_n(&s->commandNumEcho, c.commandNum, __ATOMIC_RELEASE);
    }
    emcmotCommandUnlock(shared);
    return fresh;
}

static int handle_signals(void)
{
    static const int ends[] = {SIGINT, SIGQUIT, SIGTERM, SIGHUP}, ignored[] = {SIGUSR1, SIGUSR2};
    struct sigaction end = {.sa_handler = on_signal}, ignore = {.sa_handler = SIG_IGN};
    int r = 0;
    for (size_t i = 0; i < sizeof(ends) / sizeof(ends[0]); i++)
        r |= sigaction(ends[i], &end, NULL);
    for (size_t i = 0; i < sizeof(ignored) / sizeof(ignored[0]); i++)
        r |= sigaction(ignored[i], &ignore, NULL);
    return r;
}

static int make_component(void)
{
    int id = hal_init("motion-logger");
    if (id < 0)
        return id;
    pins = hal_malloc(sizeof(*pins));
    if (!pins || hal_pin_new_bool(id, HAL_IO, &pins->reopen_log, 0, "motion-logger.reopen-log") < 0 ||
        usrmotInit("motion-logger", DEFAULT_SHMEM_KEY, DEFAULT_EMCMOT_COMM_TIMEOUT) != 0) {
        hal_exit(id);
        return -1;
    }
    return id;
}

int main(int argc, char **argv)
{
    int idle = 0;
    if (argc > 2) {
        fprintf(stderr, "usage: motion-logger [LOGFILE]\n");
        return 1;
    }
    log_name = argc == 2 ? argv[1] : NULL;
    kerf_clock_join("motion-logger", KERF_CLOCK_PRIO_RT + 1);
    int id = make_component();
    if (id < 0 || handle_signals() != 0)
        return 1;
    shared = usrmotSegment();
    init_segment();
    hal_ready(id);
    while (!quit) {
        emcmotBlockBegin(&shared->status.head); /* task waits for a first beat, and for one after each move */
        shared->status.heartbeat++;
        emcmotBlockEnd(&shared->status.head, &shared->status.tail);
        reopen_when_asked();
        idle = look() ? 0 : idle + 1;
        kerf_clock_sleep_ns(idle < BUSY_LOOKS ? BUSY_NS : IDLE_NS);
    }
    usrmotExit();
    hal_exit(id);
    kerf_clock_leave();
    if (log_file && log_file != stdout)
        fclose(log_file);
    return 0;
}
