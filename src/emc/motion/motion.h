/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * motion.h - the shared memory between task and the motion controller.
 *
 * One segment (default key 100): emcmot_struct_t. Writers: `command` by one
 * user-space program under command_mutex; `status`, `config` and `joints` by
 * the servo thread; `error` by any realtime thread, read by one user program.
 * Units: machine units, degrees, seconds, rpm, unless a field says otherwise.
 * User space goes through usrmotintf.h, never through the segment itself.
 */
#ifndef KERF_MOTION_H
#define KERF_MOTION_H

#include <stdint.h>
#ifndef __cplusplus
#include <stdbool.h>
#endif

#include "emcmotcfg.h"
#include "emcpos.h"
#include "kinematics.h"
#include "motion_types.h"
#include "simple_tp.h"
#include "state_tag.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What a stall of the computer has held or ended. */
enum { STALL_NOTHING, STALL_PROGRAM, STALL_JOG };

/* ---- commands ------------------------------------------------------------ */

typedef enum {
    EMCMOT_ABORT = 1,
    EMCMOT_ENABLE,
    EMCMOT_DISABLE,
    EMCMOT_PAUSE,
    EMCMOT_REVERSE,
    EMCMOT_FORWARD,
    EMCMOT_RESUME,
    EMCMOT_STEP,
    EMCMOT_FREE,
    EMCMOT_COORD,
    EMCMOT_TELEOP,
    EMCMOT_SPINDLE_SCALE,
    EMCMOT_SS_ENABLE,
    EMCMOT_FEED_SCALE,
    EMCMOT_RAPID_SCALE,
    EMCMOT_FS_ENABLE,
    EMCMOT_FH_ENABLE,
    EMCMOT_AF_ENABLE,
    EMCMOT_OVERRIDE_LIMITS,
    EMCMOT_SET_LINE,
    EMCMOT_SET_CIRCLE,
    EMCMOT_CLEAR_PROBE_FLAGS,
    EMCMOT_PROBE,
    EMCMOT_RIGID_TAP,
    EMCMOT_SET_VEL,
    EMCMOT_SET_VEL_LIMIT,
    EMCMOT_SET_ACC,
    EMCMOT_SET_JERK,
    EMCMOT_SET_PLANNER_TYPE,
    EMCMOT_SET_SCURVE_PEAK_SCALE,
    EMCMOT_SET_TERM_COND,
    EMCMOT_SET_NUM_JOINTS,
    EMCMOT_SET_NUM_SPINDLES,
    EMCMOT_SET_WORLD_HOME,
    EMCMOT_SET_DEBUG,
    EMCMOT_SET_DOUT,
    EMCMOT_SET_AOUT,
    EMCMOT_SET_SPINDLESYNC,
    EMCMOT_SPINDLE_ON,
    EMCMOT_SPINDLE_OFF,
    EMCMOT_SPINDLE_INCREASE,
    EMCMOT_SPINDLE_DECREASE,
    EMCMOT_SPINDLE_BRAKE_ENGAGE,
    EMCMOT_SPINDLE_BRAKE_RELEASE,
    EMCMOT_SPINDLE_ORIENT,
    EMCMOT_SET_OFFSET,
    EMCMOT_SET_MAX_FEED_OVERRIDE,
    EMCMOT_SETUP_ARC_BLENDS,
    EMCMOT_SET_PROBE_ERR_INHIBIT,
    EMCMOT_JOG_CONT,
    EMCMOT_JOG_INCR,
    EMCMOT_JOG_ABS,
    EMCMOT_JOG_ABORT,
    EMCMOT_JOINT_ACTIVATE,
    EMCMOT_JOINT_DEACTIVATE,
    EMCMOT_JOINT_HOME,
    EMCMOT_JOINT_UNHOME,
    EMCMOT_SET_JOINT_POSITION_LIMITS,
    EMCMOT_SET_JOINT_BACKLASH,
    EMCMOT_SET_JOINT_MIN_FERROR,
    EMCMOT_SET_JOINT_MAX_FERROR,
    EMCMOT_SET_JOINT_VEL_LIMIT,
    EMCMOT_SET_JOINT_ACC_LIMIT,
    EMCMOT_SET_JOINT_HOMING_PARAMS,
    EMCMOT_SET_JOINT_JERK_LIMIT,
    EMCMOT_UPDATE_JOINT_HOMING_PARAMS,
    EMCMOT_SET_JOINT_MOTOR_OFFSET,
    EMCMOT_SET_JOINT_COMP,
    EMCMOT_SET_AXIS_POSITION_LIMITS,
    EMCMOT_SET_AXIS_VEL_LIMIT,
    EMCMOT_SET_AXIS_ACC_LIMIT,
    EMCMOT_SET_AXIS_LOCKING_JOINT,
    EMCMOT_SET_AXIS_JERK_LIMIT,
    EMCMOT_SET_SPINDLE_PARAMS /* 74 */
} cmd_code_t;

typedef enum {
    EMCMOT_COMMAND_OK = 0,
    EMCMOT_COMMAND_UNKNOWN_COMMAND,
    EMCMOT_COMMAND_INVALID_COMMAND,
    EMCMOT_COMMAND_INVALID_PARAMS,
    EMCMOT_COMMAND_BAD_EXEC
} cmd_status_t;

typedef enum {
    EMCMOT_MOTION_DISABLED = 0,
    EMCMOT_MOTION_FREE,
    EMCMOT_MOTION_TELEOP,
    EMCMOT_MOTION_COORD
} motion_state_t;

typedef enum {
    EMCMOT_ORIENT_NONE = 0,
    EMCMOT_ORIENT_COMPLETE,
    EMCMOT_ORIENT_IN_PROGRESS,
    EMCMOT_ORIENT_FAULTED
} orient_state_t;

/* Terminal conditions of SET_TERM_COND. */
#define EMCMOT_TERM_COND_STOP 0
#define EMCMOT_TERM_COND_EXACT 1
#define EMCMOT_TERM_COND_BLEND 2

/* enables_new, enables_queued */
#define SS_ENABLED 0x01 /* spindle override */
#define FS_ENABLED 0x02 /* feed override */
#define AF_ENABLED 0x04 /* adaptive feed */
#define FH_ENABLED 0x08 /* feed hold */

/* motionFlag */
#define EMCMOT_MOTION_ENABLE_BIT 0x01
#define EMCMOT_MOTION_INPOS_BIT 0x02
#define EMCMOT_MOTION_COORD_BIT 0x04
#define EMCMOT_MOTION_ERROR_BIT 0x08
#define EMCMOT_MOTION_TELEOP_BIT 0x10

/* joint flags */
#define EMCMOT_JOINT_ENABLE_BIT 0x01
#define EMCMOT_JOINT_ACTIVE_BIT 0x02
#define EMCMOT_JOINT_INPOS_BIT 0x04
#define EMCMOT_JOINT_ERROR_BIT 0x08
#define EMCMOT_JOINT_MAX_HARD_LIMIT_BIT 0x10
#define EMCMOT_JOINT_MIN_HARD_LIMIT_BIT 0x20
#define EMCMOT_JOINT_FERROR_BIT 0x40
#define EMCMOT_JOINT_FAULT_BIT 0x80

/* home_flags of SET_JOINT_HOMING_PARAMS */
#define HOME_IGNORE_LIMITS 1
#define HOME_USE_INDEX 2
#define HOME_IS_SHARED 4
#define HOME_UNLOCK_FIRST 8
#define HOME_ABSOLUTE_ENCODER 16
#define HOME_NO_REHOME 32
#define HOME_NO_FINAL_MOVE 64
#define HOME_INDEX_NO_ENCODER_RESET 128

/* One command. Which fields a command reads is listed in the command's handler (command.c). */
typedef struct emcmot_command {
    cmd_code_t command;
    int commandNum;
    double motor_offset;
    double maxLimit, minLimit;
    double min_pos_speed, max_neg_speed; /* rpm */
    EmcPose pos;
    PmCartesian center, normal;
    int turn;
    double vel, ini_maxvel;
    int motion_type;     /* EMC_MOTION_TYPE_* */
    double spindlesync;  /* units per revolution, 0 = off */
    double acc, jerk, ini_maxjerk;
    int planner_type;
    double scurve_peak_scale;
    double backlash;
    int id;              /* line number, echoed in status.id */
    int termCond;
    double tolerance;
    int joint;           /* 0.. or negative as the command says */
    int axis;            /* 0..8 or -1 */
    int spindle;         /* 0.. or -1 = all */
    double scale;
    double offset, home, home_final_vel, search_vel, latch_vel;
    int flags;
    int home_sequence;
    int volatile_home;
    double minFerror, maxFerror;
    int wdWait;
    int debug;
    unsigned char now, out, start, end;
    unsigned char mode;
    double comp_nominal, comp_forward, comp_reverse;
    unsigned char probe_type;
    int probe_jog_err_inhibit, probe_home_err_inhibit;
    EmcPose tool_offset;
    double orientation;  /* degrees */
    int state;
    int direction;
    double timeout;
    unsigned char wait_for_spindle_at_speed;
    int arcBlendOptDepth, arcBlendEnable, arcBlendFallbackEnable, arcBlendGapCycles;
    double arcBlendRampFreq, arcBlendTangentKinkRatio;
    double maxFeedScale;
    double ext_offset_vel, ext_offset_acc;
    struct state_tag_t tag;
    int probe_feed_contact, probe_rapid_contact; /* PROBE_CONTACT_... */
    double probe_filter; /* s */
} emcmot_command_t;

/* ---- joints -------------------------------------------------------------- */

/* What a probe contact in a move that is no probe move does. */
enum { PROBE_CONTACT_STOP, PROBE_CONTACT_WARN, PROBE_CONTACT_IGNORE };

typedef struct {
    double nominal;
    float fwd_trim, rev_trim;
    float fwd_slope, rev_slope;
} emcmot_comp_entry_t;

typedef struct {
    int entries; /* points given, without the two sentinels */
    emcmot_comp_entry_t *entry; /* unused by others than compensation */
    emcmot_comp_entry_t array[EMCMOT_COMP_SIZE + 2];
    double swing, slope; /* largest change at once, largest slope of the trims */
    int shared;          /* 1: the joint's limits are shared between its motion and compensation */
    simple_tp_t tp;      /* towards the wanted value */
    int direction;       /* of motion as far as it matters: -1, 1; 0 none yet */
    double back;         /* way against it since */
} emcmot_comp_t;

/* Internal state of a joint; [servo] writes and reads, home modules too (homing.h). */
typedef struct emcmot_joint {
    int type;
    double max_pos_limit, min_pos_limit;
    double max_jog_limit, min_jog_limit;
    double vel_limit, acc_limit, jerk_limit;
    double min_ferror, max_ferror;
    double backlash;
    emcmot_comp_t comp;

    int flag; /* EMCMOT_JOINT_*_BIT */
    double coarse_pos;
    double pos_cmd, vel_cmd, acc_cmd, jerk_cmd;
    double backlash_corr, backlash_filt, backlash_vel;
    double motor_pos_cmd, motor_pos_fb;
    double pos_fb;
    double ferror, ferror_limit, ferror_high_mark;
    simple_tp_t free_tp;
    int kb_jjog_active, wheel_jjog_active;
    double motor_offset;
    int old_jjog_counts;
    int on_pos_limit, on_neg_limit; /* switches as read, 0 or 1 */
    double big_vel;                 /* units/s, where a limit of velocity is not known */
} emcmot_joint_t;

typedef struct {
    int flag;
    bool homed, homing;
    double pos_cmd, pos_fb, vel_cmd, acc_cmd;
    double ferror, ferror_high_mark;
    double backlash;
    double max_pos_limit, min_pos_limit;
    double min_ferror, max_ferror;
} emcmot_joint_status_t;

typedef struct {
    double teleop_vel_cmd;
    double max_pos_limit, min_pos_limit;
} emcmot_axis_status_t;

typedef struct spindle_status {
    double speed;      /* rpm, signed, as commanded; with constant surface speed its bound */
    double rpm;        /* what it shall turn at now, before the override; 0 while it is off */
    double scale, net_scale;
    double css_factor; /* 0 = constant rpm */
    double xoffset;
    int state;         /* 0 off */
    int rests;         /* 1: off, and no move waits until it stands */
    int direction;     /* -1, 0, 1 */
    int brake;
    int locked;
    int orient_fault, orient_state;
    int spindle_index_enable;
    double spindleRevs, spindleSpeedIn; /* revolutions, rev/s */
    int at_speed;
    int fault;
    double max_pos_speed, min_pos_speed, max_neg_speed, min_neg_speed; /* rpm */
    double home_angle, home_search_vel;
    int home_sequence;
    double increment;  /* rpm */
} spindle_status_t;

/* ---- status -------------------------------------------------------------- */

/* Why the effective override is not the one that was asked for. */
enum override_cause {
    EMCMOT_OVERRIDE_FREE,         /* it is */
    EMCMOT_OVERRIDE_DISABLED,     /* M49, M50 P0 */
    EMCMOT_OVERRIDE_PAUSED,
    EMCMOT_OVERRIDE_HELD,         /* motion.feed-hold */
    EMCMOT_OVERRIDE_INHIBITED,    /* motion.feed-inhibit */
    EMCMOT_OVERRIDE_ADAPTIVE,     /* motion.adaptive-feed */
    EMCMOT_OVERRIDE_SPINDLE,      /* the move follows a spindle's position */
    EMCMOT_OVERRIDE_MAXIMUM,      /* [DISPLAY]MAX_FEED_OVERRIDE */
    EMCMOT_OVERRIDE_MACHINE,      /* limits of axes and joints */
    EMCMOT_OVERRIDE_MAX_VELOCITY, /* the limit of speed that the operator sets */
    EMCMOT_OVERRIDE_OFFSETS       /* external offsets need the room */
};

/* What switched motion off, bits; kept until it is enabled again. */
enum emcmot_stop_cause {
    EMCMOT_STOP_LIMIT = 1,     /* a joint's limit switch */
    EMCMOT_STOP_AMPLIFIER = 2, /* joint.N.amp-fault-in */
    EMCMOT_STOP_FOLLOWING = 4, /* following error: its position is lost */
    EMCMOT_STOP_OTHER = 8      /* enable input, spindle, misc error */
};

typedef struct emcmot_status {
    unsigned int head; /* written first; head != tail: being written */
    cmd_code_t commandEcho;
    int commandNumEcho;
    cmd_status_t commandStatus;

    double feed_scale, rapid_scale;
    unsigned char enables_new;
    double net_feed_scale;
    double scale_allowed;    /* by the planner: the highest scale that still makes the executing move faster */
    int scale_bound;         /* what ends it, EMCMOT_OVERRIDE_* */
    double override_effective; /* of the feed or rapid override, while a move executes of the one it has */
    int override_cause;      /* EMCMOT_OVERRIDE_*: why it is not the override that was asked for */
    unsigned char enables_queued;
    motion_state_t motion_state;
    int motionFlag;

    EmcPose carte_pos_cmd;
    int carte_pos_cmd_ok;
    EmcPose carte_pos_fb;
    int carte_pos_fb_ok;
    EmcPose world_home;

    emcmot_joint_status_t joint_status[EMCMOT_MAX_JOINTS];
    emcmot_axis_status_t axis_status[EMCMOT_MAX_AXIS];
    int spindleSync;
    spindle_status_t spindle_status[EMCMOT_MAX_SPINDLES];

    int on_soft_limit;
    int stop_causes; /* EMCMOT_STOP_* */
    int probeVal, probeTripped, probing;
    unsigned char probe_type;
    EmcPose probedPos;

    int synch_di[EMCMOT_MAX_DIO], synch_do[EMCMOT_MAX_DIO];
    double analog_input[EMCMOT_MAX_AIO], analog_output[EMCMOT_MAX_AIO];
    int misc_error[EMCMOT_MAX_MISC_ERROR];

    struct state_tag_t tag;
    uint64_t heartbeat;
    int config_num;
    int id;
    int depth, activeDepth, queueFull;
    int paused;
    int overrideLimitMask; /* bit 2j: joint j negative, bit 2j+1: positive */
    int reverse_run;

    double vel, acc, jerk;
    int planner_type;
    double scurve_peak_scale;
    int motionType;
    double distance_to_go;
    EmcPose dtg;
    double current_vel, requested_vel;
    double current_acc, current_jerk;
    double decel_dist;   /* in which the path comes to rest when held; kept while external offsets are applied */
    PmCartesian current_dir; /* unit vector of the path in xyz */
    unsigned int tcqlen;
    EmcPose tool_offset;
    int atspeed_next_feed;
    int external_offsets_applied;
    EmcPose eoffset_pose;
    /* by the planner, bit n: the move is one to a machine coordinate that axis n's offset must not change */
    int offsets_spare;
    int offsets_leave;   /* such an offset is not gone yet: the move has not ended */
    int numExtraJoints;
    int stepping;
    int jogging_active;
    unsigned int stalls; /* how often the computer stood still for longer than stall_hold */
    double stall_time;   /* s, the last time */
    int stall_ended;     /* STALL_...: what it held or ended */
    unsigned int tail;
} emcmot_status_t;

typedef struct emcmot_config {
    unsigned int head;
    int config_num; /* changes with every change of what follows */
    int numJoints, numExtraJoints, numSpindles;
    KINEMATICS_TYPE kinType;
    int numDIO, numAIO, numMiscError;
    double trajCycleTime, servoCycleTime; /* s */
    int interpolationRate;
    double limitVel; /* cap of the path velocity */
    int debug;
    int arcBlendOptDepth, arcBlendEnable, arcBlendFallbackEnable, arcBlendGapCycles;
    double arcBlendRampFreq, arcBlendTangentKinkRatio;
    double maxFeedScale;
    int inhibit_probe_jog_error, inhibit_probe_home_error;
    int probe_feed_contact, probe_rapid_contact; /* PROBE_CONTACT_... */
    double probe_filter; /* s that a contact outside probe moves must last */
    unsigned int tail;
} emcmot_config_t;

/* What debuggers may look at; no compatibility is promised. */
typedef struct emcmot_internal {
    unsigned int head;
    int enabling, coordinating, teleoperating, overriding;
    int stepping, idForStep;
    emcmot_joint_t joints[EMCMOT_MAX_JOINTS];
    unsigned int tail;
} emcmot_internal_t;

/* ---- error ring (emcmotutil.c) -------------------------------------------- */

/* A slot's turn: equal to its index plus a multiple of the size when free, one more when filled. */
typedef struct {
    unsigned int turn;
    char data[EMCMOT_ERROR_LEN];
} emcmot_error_slot_t;

typedef struct emcmot_error {
    unsigned int put, get; /* counters of producers and of the consumer */
    unsigned int dropped;  /* messages lost to a full ring */
    emcmot_error_slot_t slot[EMCMOT_ERROR_NUM];
} emcmot_error_t;

typedef struct emcmot_struct {
    int command_mutex; /* 0 free, -1 motion, > 0 process id of the writer */
    emcmot_command_t command;
    emcmot_status_t status;
    emcmot_config_t config;
    emcmot_error_t error;
    emcmot_internal_t internal;
} emcmot_struct_t;

#ifdef __cplusplus
}
#endif
#endif
