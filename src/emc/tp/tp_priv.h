/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * tp_priv.h - what the parts of the planner's interface share: tp.c (settings, queue), tp_cycle.c
 * (the servo cycle), tp_sync.c (following a spindle), tp_tap.c (rigid tapping). Context: [servo].
 */
#ifndef KERF_TP_TP_PRIV_H
#define KERF_TP_TP_PRIV_H

#include <stddef.h>

#include "follow.h"
#include "hal.h"
#include "tp.h"
#include "traj.h"

#define NUM_OUT 64        /* synchronised outputs of a kind */
#define OUTPUT_LAG 2      /* cycles from the planner to a joint's command: motmod's interpolator */

/* Outputs that a move switches when it starts. */
struct outputs {
    uint64_t digital;       /* channels to write */
    uint64_t digital_value;
    uint64_t analog;
    double analog_value[NUM_OUT];
};

/* How moves follow a spindle. */
struct sync {
    enum { SYNC_OFF, SYNC_SPEED, SYNC_POSITION } mode;
    int spindle;
    double upr; /* units per revolution */
};

/* What a spindle's encoder does at its index, as far as it was seen. */
enum encoder { ENCODER_UNKNOWN, ENCODER_RESETS, ENCODER_COUNTS_ON };

/* Whether the answer to a request came from a real index: a whole number of revolutions after the one before. */
struct index_watch {
    double revs;    /* of the last cycle, growing while the spindle turns as commanded */
    double step;    /* its last change, revolutions a cycle */
    double gap;     /* revolutions that the last new origin of the count took back */
    double turned;  /* revolutions since the move asked for an index first */
};

/* The start of a move that follows a spindle's position waits for the index, then for a good estimate of the speed. */
enum sync_start { START_NONE, START_INDEX, START_SPEED };

/* Rigid tapping: one axis of motion, u, from the start of the hole. */
enum tap_state { TAP_IDLE, TAP_IN, TAP_REVERSING, TAP_OUT, TAP_FINAL_REVERSAL, TAP_PLACE };
struct tap {
    enum tap_state state;
    double x, v;        /* place and speed along the hole */
    double place;       /* behind the filter */
    struct traj_filter filter;
    double depth;
    double dir[PATH_AXES];
    double start[PATH_AXES];
    double abort_time;  /* s since an abort */
};

/* What belongs to a move beside its path. */
struct move_info {
    int id;
    int canon;              /* EMC_MOTION_TYPE_* */
    unsigned char enables;
    char atspeed;           /* wait for all spindles before it */
    int indexer;            /* joint to unlock for it, -1 none */
    struct sync sync;       /* what it follows */
    int tap;                /* rigid tap: a mark in the path */
    double tap_scale;       /* factor of the spindle's speed while retracting */
    double tap_vmax, tap_acc, tap_feed;
    int tap_window;         /* cycles of the filter */
    double tap_end[PATH_AXES];
    struct state_tag_t tag;
    int has_outputs;
    struct outputs outputs;
};

struct planner {
    struct traj tj;
    struct move_info info[TRAJ_SEGS];
    double cycle;           /* s */
    double pos[PATH_AXES];  /* last position given to motmod */
    double goal[PATH_AXES]; /* end of the last move of the queue */
    int next_id;
    int exec_id;
    struct state_tag_t exec_tag;
    int canon;              /* of the executing move, 0 idle */
    enum traj_end term;     /* of moves to come */
    double tolerance;
    double vmax, ini_maxvel, vlimit, amax;
    int pausing, aborting;
    double excess;          /* s of a spindle too fast to follow */
    double waited;          /* s of waiting for a spindle */
    double standing;        /* s without motion though nothing holds it */
    int done;
    int64_t entered;        /* last move whose start was reported, -1 none */
    int unlocked_joint;     /* rotary joint that was unlocked for the executing move, -1 none */
    int resting;            /* cycles since motion came to rest */
    uint32_t unlocked_for;  /* the move it was unlocked for */
    struct sync sync;       /* of moves to come */
    enum sync_start starting; /* a move that follows a spindle's position, how far it came */
    enum encoder encoder[EMCMOT_MAX_SPINDLES];
    char from_index[EMCMOT_MAX_SPINDLES]; /* 1: the encoder counts from an index */
    struct index_watch index; /* of the followed spindle */
    int followed;           /* spindle of `follow`, -1 none */
    int out_of_phase;       /* line of the move that follows and has not been where it belongs, -1 none */
    struct follower follow;
    struct tap tap;
    struct outputs pending; /* of the next move appended */
    struct move_info scratch; /* a move on its way into the queue */
};

/* What motmod gave to the planner. */
struct tp_mot {
    void (*dio_write)(int idx, char val);
    void (*aio_write)(int idx, double val);
    void (*set_rotary_unlock)(int joint, int unlock);
    int (*get_rotary_is_unlocked)(int joint);
    double (*axis_vel_limit)(int axis);
    double (*axis_acc_limit)(int axis);
    const struct tp_machine *machine;
    emcmot_status_t *status;
    emcmot_config_t *config;
};
extern struct tp_mot tp_mot;
/* Parameters axis.L.eoffset-work-only, one an axis; NULL outside the module. */
extern hal_bool_t *tp_work_only;

static inline struct planner *planner_of(const TP_STRUCT *tp)
{
    return tp ? tp->impl : NULL;
}

static inline const struct move_info *info_of(const struct planner *pl, uint32_t index)
{
    return &pl->info[index & (TRAJ_SEGS - 1)];
}

static inline void to_pose(const double p[PATH_AXES], EmcPose *pose)
{
    pose->tran.x = p[PATH_X], pose->tran.y = p[PATH_Y], pose->tran.z = p[PATH_Z];
    pose->a = p[PATH_A], pose->b = p[PATH_B], pose->c = p[PATH_C];
    pose->u = p[PATH_U], pose->v = p[PATH_V], pose->w = p[PATH_W];
}

/* ---- tp.c ---- */

/* Axes whose external offset must not change a move with this tag (axis.L.eoffset-work-only), a bit each. */
int tp_spared_axes(const struct state_tag_t *tag);

/* Back to an empty queue at rest where the planner is; `keep_tag`: the tag of the last move stays readable. */
void tp_forget_moves(TP_STRUCT *tp, struct planner *pl, int keep_tag);
/* Moves in the queue, with the executing one. */
uint32_t tp_depth(const struct planner *pl);
/* Ends the path with the motion error flag; the caller has said why. */
void tp_fail(struct planner *pl);

/* ---- tp_sync.c ---- */

/* All spindles of the machine turn as commanded. */
int tp_spindles_at_speed(const struct move_info *info);
void tp_stops_waited_for(void); /* a move passed the wait: later ones wait only for spindles that turn */
/* Takes the position of the followed spindle in, once a cycle. */
void tp_measure_spindle(struct planner *pl);
/* Seconds by which the reference is taken ahead. */
double tp_follow_lead(const struct planner *pl, const struct move_info *info);
/* Goes on with the start of a move that follows a spindle's position: index, then phase. 1: may start. */
int tp_sync_start(TP_STRUCT *tp, struct planner *pl, const struct move_info *info, double acc, double vmax);
/* Speed asked for by the spindle that the executing move follows. */
double tp_sync_speed(struct planner *pl);
/* A thread, or its first move, has ended: tells the operator if the axis did not get in phase before. */
void tp_check_phase(struct planner *pl);
/* The executing move changed from `from` to the present one: the reference goes on from its end. */
void tp_follow_moves(struct planner *pl, uint32_t from);
/* A wait for a spindle that takes long is named in the log, once. */
void tp_watch_waiting(const TP_STRUCT *tp, struct planner *pl);

/* ---- tp_tap.c ---- */

/* One cycle of a rigid tap. Ends the mark when the tool is back at the start. */
void tp_run_tap(struct planner *pl, const struct move_info *info);
/* No tap, or an aborted one that came to rest. */
int tp_tap_at_rest(const struct planner *pl);

#endif
