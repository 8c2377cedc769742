/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * homing.h - what a homing module (homemod) exports to motmod.
 *
 * Order: homeMotFunctions and homing_init once [init]; then per servo cycle
 * read_homing_in_pins, do_homing (only in free mode), write_homing_out_pins.
 */
#ifndef KERF_HOMING_H
#define KERF_HOMING_H

#include "motion.h"

#ifdef __cplusplus
extern "C" {
#endif

/* States, as joint.N.home-state shows them. */
typedef enum {
    HOME_IDLE = 0,
    HOME_START,
    HOME_UNLOCK,
    HOME_UNLOCK_WAIT,
    HOME_INITIAL_BACKOFF_START,
    HOME_INITIAL_BACKOFF_WAIT,
    HOME_INITIAL_SEARCH_START,
    HOME_INITIAL_SEARCH_WAIT,
    HOME_SET_COARSE_POSITION,
    HOME_FINAL_BACKOFF_START,
    HOME_FINAL_BACKOFF_WAIT,
    HOME_RISE_SEARCH_START,
    HOME_RISE_SEARCH_WAIT,
    HOME_FALL_SEARCH_START,
    HOME_FALL_SEARCH_WAIT,
    HOME_SET_SWITCH_POSITION,
    HOME_INDEX_ONLY_START,
    HOME_INDEX_SEARCH_START,
    HOME_INDEX_SEARCH_WAIT,
    HOME_SET_INDEX_POSITION,
    HOME_FINAL_MOVE_START,
    HOME_FINAL_MOVE_WAIT,
    HOME_LOCK,
    HOME_LOCK_WAIT,
    HOME_FINISHED,
    HOME_ABORT
} home_state_t;

typedef enum {
    HOME_SEQUENCE_IDLE = 0,
    HOME_SEQUENCE_START,
    HOME_SEQUENCE_DO_ONE_JOINT,
    HOME_SEQUENCE_DO_ONE_SEQUENCE,
    HOME_SEQUENCE_START_JOINTS,
    HOME_SEQUENCE_WAIT_JOINTS
} home_sequence_state_t;

/* [init] Access to the unlock pins of motmod. */
extern void homeMotFunctions(void (*pSetRotaryUnlock)(int, int), int (*pGetRotaryIsUnlocked)(int));

/* [init] Creates the pins under component id. servo_period (s) >= 1e-9. Returns 0, or < 0. */
extern int homing_init(int id, double servo_period, int n_joints, int n_extrajoints, emcmot_joint_t *pjoints);

/* [servo] One cycle; true when "all homed" became true in this call. */
extern bool do_homing(void);
extern bool get_allhomed(void);
extern bool get_homed(int jno);
extern bool get_home_is_idle(int jno);
extern bool get_home_is_synchronized(int jno);
extern bool get_home_needs_unlock_first(int jno);
extern int get_home_sequence(int jno);
extern bool get_homing(int jno);
extern bool get_homing_at_index_search_wait(int jno);
extern bool get_homing_is_active(void);
extern bool get_index_enable(int jno);
extern void read_homing_in_pins(int njoints);
extern void do_home_joint(int jno);    /* -1 all */
extern void do_cancel_homing(int jno);
extern void set_unhomed(int jno, motion_state_t motstate); /* -1 all, -2 volatile */
extern void set_joint_homing_params(int jno, double offset, double home, double home_final_vel,
                                    double home_search_vel, double home_latch_vel, int home_flags,
                                    int home_sequence, bool volatile_home);
extern void update_joint_homing_params(int jno, double offset, double home, int home_sequence);
extern void write_homing_out_pins(int njoints);

#ifdef __cplusplus
}
#endif
#endif
