/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * homing_priv.h - what the two halves of the default homing module share:
 * homing.c (requests, sequence of joints, pins) and homing_joint.c (one joint).
 *
 * Units: joint units and seconds. Everything is [servo], one writer: the servo thread.
 */
#ifndef KERF_HOMING_PRIV_H
#define KERF_HOMING_PRIV_H

#include "hal.h"
#include "homing.h"
#include "rtapi.h"

#define LAST_SEQUENCE 100       /* higher numbers take no part in home-all */

struct home_joint {
    home_state_t state;
    int homing, homed;
    int homing_shown;       /* homing, its falling edge held until all have ended */
    int in_sequence;        /* takes part in what runs now */
    int grouped;            /* member of a group with a negative number */
    int ready;              /* has rested and waits for its group */
    int go;                 /* so have all others: starts in this cycle */
    int delay;              /* cycles left to wait, -1 not waiting */
    int limit_off;          /* cycles of the final move since a limit switch was on */
    int index_request;      /* index-enable set and not yet answered */
    int index_read;         /* index-enable as read this cycle */
    int index_written;      /* a write is due */
    int switch_read;
    int partner_tripped;    /* the move was cut because a partner's switch came first */
    double lag;             /* following error while the index is awaited */
    double offset, home, final_vel, search_vel, latch_vel;
    int flags, sequence;
    bool volatile_home;
};

struct home_pins {
    hal_bool_t home_sw_in, homing, homed, index_enable;
    hal_sint_t home_state;
    hal_real_t search_max, backoff_max, latch_max, rack_max; /* parameters, units; 0: default */
};

struct homing {
    struct home_joint joint[EMCMOT_MAX_JOINTS];
    struct home_pins *pins; /* array */
    emcmot_joint_t *motion; /* joints of the motion controller */
    int joints, extra;
    double period;
    home_sequence_state_t sequence_state;
    int current;            /* sequence number being homed, -1: of one joint, whatever its number */
    int active;             /* a request is being worked on */
    void (*set_unlock)(int joint, int unlock);
    int (*is_unlocked)(int joint);
};

extern struct homing homes;
/* [init] The component that offers joint.N.home-...-max: set before homing_init; 0: motmod. */
extern int homing_owner;

static inline int abs_sequence(int j)
{
    int n = homes.joint[j].sequence;
    return n < 0 ? -n : n;
}
static inline int takes_part(int j) { return abs_sequence(j) <= LAST_SEQUENCE; }
static inline int is_active_joint(int j) { return (homes.motion[j].flag & EMCMOT_JOINT_ACTIVE_BIT) != 0; }
static inline int has(int j, int flag) { return (homes.joint[j].flags & flag) != 0; }

/* Operator error with up to two numbers. */
void homing_error(const char *fmt, int a, int b);
/* Decides which joints of groups start a move in this cycle. Before the joints run. */
void homing_release_groups(void);
/* One cycle of joint j's state machine. */
void homing_run_joint(int j);
/* Ends homing of every joint: all stop. What was homed before the request, or has finished, stays homed. */
void homing_abort_all(void);
/* 1 when the promises numbered at the head of homing_joint.c hold. */
int homing_invariants_hold(void);
/* index-enable is to be written: 1 asks for the index, 0 takes the request back. */
void homing_request_index(int j, int on);

#endif
