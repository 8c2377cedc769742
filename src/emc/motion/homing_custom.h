/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * homing_custom.h - how a homing module is made out of homing.c with parts of its own.
 *
 * homemod compiles homing.c as it is. A custom module, for instance a .comp file with
 * `option homemod;`, says
 *
 *     #define CUSTOM_HOMEMODULE
 *     #define CUSTOM_do_home_joint      (one line for each function that it replaces)
 *     #include "homing.c"
 *     void do_home_joint(int jno) { ...; base_do_home_joint(jno); }
 *
 * Every function of homing.h then exists as base_NAME; those that are not replaced are
 * exported as they are. EXPORT_SYMBOL of the replaced ones is done here too.
 */
#ifndef KERF_HOMING_CUSTOM_H
#define KERF_HOMING_CUSTOM_H

#include "homing.h"

#ifdef CUSTOM_HOMEMODULE
#define HOMING(name) base_##name
static void base_homeMotFunctions(void (*pSetRotaryUnlock)(int, int), int (*pGetRotaryIsUnlocked)(int))
                                  __attribute__((unused));
static int base_homing_init(int id, double servo_period, int n_joints, int n_extrajoints, emcmot_joint_t *pjoints)
                            __attribute__((unused));
static bool base_do_homing(void) __attribute__((unused));
static bool base_get_allhomed(void) __attribute__((unused));
static bool base_get_homed(int jno) __attribute__((unused));
static bool base_get_home_is_idle(int jno) __attribute__((unused));
static bool base_get_home_is_synchronized(int jno) __attribute__((unused));
static bool base_get_home_needs_unlock_first(int jno) __attribute__((unused));
static int base_get_home_sequence(int jno) __attribute__((unused));
static bool base_get_homing(int jno) __attribute__((unused));
static bool base_get_homing_at_index_search_wait(int jno) __attribute__((unused));
static bool base_get_homing_is_active(void) __attribute__((unused));
static bool base_get_index_enable(int jno) __attribute__((unused));
static void base_read_homing_in_pins(int njoints) __attribute__((unused));
static void base_do_home_joint(int jno) __attribute__((unused));
static void base_do_cancel_homing(int jno) __attribute__((unused));
static void base_set_unhomed(int jno, motion_state_t motstate) __attribute__((unused));
static void base_set_joint_homing_params(int jno, double offset, double home, double home_final_vel, double
                                         home_search_vel, double home_latch_vel, int home_flags, int home_sequence,
                                         bool volatile_home) __attribute__((unused));
static void base_update_joint_homing_params(int jno, double offset, double home, int home_sequence)
                                            __attribute__((unused));
static void base_write_homing_out_pins(int njoints) __attribute__((unused));
#else
#define HOMING(name) name
#endif

#endif

#if defined(HOMING_EXPORTS) && !defined(KERF_HOMING_EXPORTED)
#define KERF_HOMING_EXPORTED
#ifdef CUSTOM_HOMEMODULE
#ifndef CUSTOM_homeMotFunctions
void homeMotFunctions(void (*pSetRotaryUnlock)(int, int), int (*pGetRotaryIsUnlocked)(int))
{
    base_homeMotFunctions(pSetRotaryUnlock, pGetRotaryIsUnlocked);
}
#endif
#ifndef CUSTOM_homing_init
int homing_init(int id, double servo_period, int n_joints, int n_extrajoints, emcmot_joint_t *pjoints)
{
    return base_homing_init(id, servo_period, n_joints, n_extrajoints, pjoints);
}
#endif
#ifndef CUSTOM_do_homing
bool do_homing(void) { return base_do_homing(); }
#endif
#ifndef CUSTOM_get_allhomed
bool get_allhomed(void) { return base_get_allhomed(); }
#endif
#ifndef CUSTOM_get_homed
bool get_homed(int jno) { return base_get_homed(jno); }
#endif
#ifndef CUSTOM_get_home_is_idle
bool get_home_is_idle(int jno) { return base_get_home_is_idle(jno); }
#endif
#ifndef CUSTOM_get_home_is_synchronized
bool get_home_is_synchronized(int jno) { return base_get_home_is_synchronized(jno); }
#endif
#ifndef CUSTOM_get_home_needs_unlock_first
bool get_home_needs_unlock_first(int jno) { return base_get_home_needs_unlock_first(jno); }
#endif
#ifndef CUSTOM_get_home_sequence
int get_home_sequence(int jno) { return base_get_home_sequence(jno); }
#endif
#ifndef CUSTOM_get_homing
bool get_homing(int jno) { return base_get_homing(jno); }
#endif
#ifndef CUSTOM_get_homing_at_index_search_wait
bool get_homing_at_index_search_wait(int jno) { return base_get_homing_at_index_search_wait(jno); }
#endif
#ifndef CUSTOM_get_homing_is_active
bool get_homing_is_active(void) { return base_get_homing_is_active(); }
#endif
#ifndef CUSTOM_get_index_enable
bool get_index_enable(int jno) { return base_get_index_enable(jno); }
#endif
#ifndef CUSTOM_read_homing_in_pins
void read_homing_in_pins(int njoints) { base_read_homing_in_pins(njoints); }
#endif
#ifndef CUSTOM_do_home_joint
void do_home_joint(int jno) { base_do_home_joint(jno); }
#endif
#ifndef CUSTOM_do_cancel_homing
void do_cancel_homing(int jno) { base_do_cancel_homing(jno); }
#endif
#ifndef CUSTOM_set_unhomed
void set_unhomed(int jno, motion_state_t motstate) { base_set_unhomed(jno, motstate); }
#endif
#ifndef CUSTOM_set_joint_homing_params
void set_joint_homing_params(int jno, double offset, double home, double home_final_vel, double home_search_vel,
                             double home_latch_vel, int home_flags, int home_sequence, bool volatile_home)
{
    base_set_joint_homing_params(jno, offset, home, home_final_vel, home_search_vel, home_latch_vel, home_flags,
                                 home_sequence, volatile_home);
}
#endif
#ifndef CUSTOM_update_joint_homing_params
void update_joint_homing_params(int jno, double offset, double home, int home_sequence)
{
    base_update_joint_homing_params(jno, offset, home, home_sequence);
}
#endif
#ifndef CUSTOM_write_homing_out_pins
void write_homing_out_pins(int njoints) { base_write_homing_out_pins(njoints); }
#endif
#endif
EXPORT_SYMBOL(homeMotFunctions);
EXPORT_SYMBOL(homing_init);
EXPORT_SYMBOL(do_homing);
EXPORT_SYMBOL(get_allhomed);
EXPORT_SYMBOL(get_homed);
EXPORT_SYMBOL(get_home_is_idle);
EXPORT_SYMBOL(get_home_is_synchronized);
EXPORT_SYMBOL(get_home_needs_unlock_first);
EXPORT_SYMBOL(get_home_sequence);
EXPORT_SYMBOL(get_homing);
EXPORT_SYMBOL(get_homing_at_index_search_wait);
EXPORT_SYMBOL(get_homing_is_active);
EXPORT_SYMBOL(get_index_enable);
EXPORT_SYMBOL(read_homing_in_pins);
EXPORT_SYMBOL(do_home_joint);
EXPORT_SYMBOL(do_cancel_homing);
EXPORT_SYMBOL(set_unhomed);
EXPORT_SYMBOL(set_joint_homing_params);
EXPORT_SYMBOL(update_joint_homing_params);
EXPORT_SYMBOL(write_homing_out_pins);
#endif
