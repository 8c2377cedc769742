// SPDX-License-Identifier: GPL-2.0-or-later
component homecomp "Template of a homing module";
description """
A starting point for a homing module of one's own: copy this file, rename the component, build it with
*halcompile --install* and name it in the INI file, [EMCMOT]HOMEMOD, or as *linuxcnc -m*.

As it stands it does not move joints. While *motion.allow-sim-homed* is TRUE every joint says that it is
homed; otherwise a joint is homed while its *joint.N.home-sw-in* is TRUE.

With CUSTOM_HOMEMODULE defined it is the default homing with one thing added: a joint whose pin
*joint.N.request-custom-homing* is TRUE when it is to be homed takes its present position as HOME, without
a search, and says so on *joint.N.is-custom-homing*. HOMING_BASE names the source of the default homing.""";
pin out bit is_module = 1;
option homemod;
license "GPL";
author "Kerf developers";
see_also "halcompile(1)";
;;
// #define CUSTOM_HOMEMODULE

#ifdef CUSTOM_HOMEMODULE

#ifndef HOMING_BASE
#define HOMING_BASE "homing.c"
#endif
#define CUSTOM_homing_init
#define CUSTOM_do_home_joint
#define CUSTOM_write_homing_out_pins
#include HOMING_BASE

static struct custom {
    hal_bit_t *request, *is_custom;
    int active; // homing as it is without a search; then the settings come back
    double home, search_vel, latch_vel;
} *custom; // of each joint

int homing_init(int id, double servo_period, int n_joints, int n_extrajoints, emcmot_joint_t *pjoints)
{
    custom = hal_malloc(sizeof(*custom) * EMCMOT_MAX_JOINTS);
    if(!custom) return -1;
    for(int j = 0; j < n_joints; j++)
        if(hal_pin_bit_newf(HAL_IN, &custom[j].request, id, "joint.%d.request-custom-homing", j) < 0 ||
           hal_pin_bit_newf(HAL_OUT, &custom[j].is_custom, id, "joint.%d.is-custom-homing", j) < 0)
            return -1;
    return base_homing_init(id, servo_period, n_joints, n_extrajoints, pjoints);
}

void do_home_joint(int jno)
{
    if(jno >= 0 && *custom[jno].request && !homes.active) {
        struct home_joint *h = &homes.joint[jno];
        struct custom *c = &custom[jno];
        c->home = h->home;
        c->search_vel = h->search_vel;
        c->latch_vel = h->latch_vel;
        h->home = h->offset;
        h->search_vel = h->latch_vel = 0;
        c->active = *c->is_custom = 1;
    }
    base_do_home_joint(jno);
}

void write_homing_out_pins(int njoints)
{
    for(int j = 0; j < njoints; j++) {
        struct home_joint *h = &homes.joint[j];
        struct custom *c = &custom[j];
        if(c->active && !homes.active) {
            h->home = c->home;
            h->search_vel = c->search_vel;
            h->latch_vel = c->latch_vel;
            c->active = 0;
        }
        if(!h->homed && !c->active) *c->is_custom = 0;
    }
    base_write_homing_out_pins(njoints);
}

#else // the skeleton

#include "homing.h"

static struct {
    hal_bit_t *allow_sim_homed;
    struct {
        hal_bit_t *home_sw_in, *homing, *homed, *index_enable;
        hal_s32_t *home_state;
    } joint[EMCMOT_MAX_JOINTS];
} *pins;
static int joints;
static emcmot_joint_t *joint; // of the motion controller
static bool homed[EMCMOT_MAX_JOINTS];
static int sequence[EMCMOT_MAX_JOINTS];

void homeMotFunctions(void (*set_unlock)(int, int), int (*is_unlocked)(int))
{
    (void)set_unlock;
    (void)is_unlocked;
}

int homing_init(int id, double servo_period, int n_joints, int n_extrajoints, emcmot_joint_t *pjoints)
{
    (void)n_extrajoints;
    if(!(servo_period >= 1e-9) || n_joints > EMCMOT_MAX_JOINTS) return -1;
    pins = hal_malloc(sizeof(*pins));
    if(!pins) return -1;
    joints = n_joints;
    joint = pjoints;
    if(hal_pin_bit_newf(HAL_IO, &pins->allow_sim_homed, id, "motion.allow-sim-homed") < 0) return -1;
    *pins->allow_sim_homed = 1;
    for(int j = 0; j < joints; j++)
        if(hal_pin_bit_newf(HAL_IN, &pins->joint[j].home_sw_in, id, "joint.%d.home-sw-in", j) < 0 ||
           hal_pin_bit_newf(HAL_OUT, &pins->joint[j].homing, id, "joint.%d.homing", j) < 0 ||
           hal_pin_bit_newf(HAL_OUT, &pins->joint[j].homed, id, "joint.%d.homed", j) < 0 ||
           hal_pin_s32_newf(HAL_OUT, &pins->joint[j].home_state, id, "joint.%d.home-state", j) < 0 ||
           hal_pin_bit_newf(HAL_IO, &pins->joint[j].index_enable, id, "joint.%d.index-enable", j) < 0)
            return -1;
    return 0;
}

void read_homing_in_pins(int njoints)
{
    for(int j = 0; j < njoints && j < joints; j++)
        homed[j] = *pins->allow_sim_homed || *pins->joint[j].home_sw_in;
}

void write_homing_out_pins(int njoints)
{
    for(int j = 0; j < njoints && j < joints; j++) {
        *pins->joint[j].homing = 0;
        *pins->joint[j].homed = homed[j];
        *pins->joint[j].home_state = 0;
    }
}

bool get_allhomed(void)
{
    for(int j = 0; j < joints; j++)
        if((joint[j].flag & EMCMOT_JOINT_ACTIVE_BIT) && !homed[j]) return false;
    return true;
}

bool do_homing(void)
{
    static bool before;
    bool now = get_allhomed(), became = now && !before;
    before = now;
    return became;
}

void set_joint_homing_params(int j, double offset, double home, double final_vel, double search_vel,
                             double latch_vel, int flags, int home_sequence, bool volatile_home)
{
    (void)offset, (void)home, (void)final_vel, (void)search_vel, (void)latch_vel, (void)flags, (void)volatile_home;
    sequence[j] = home_sequence;
}

void update_joint_homing_params(int j, double offset, double home, int home_sequence)
{
    (void)offset, (void)home;
    sequence[j] = home_sequence;
}

bool get_homed(int j) { return homed[j]; }
bool get_home_is_idle(int j) { return (void)j, true; }
bool get_home_is_synchronized(int j) { return (void)j, false; }
bool get_home_needs_unlock_first(int j) { return (void)j, false; }
int get_home_sequence(int j) { return (void)j, 0; }
bool get_homing(int j) { return (void)j, false; }
bool get_homing_at_index_search_wait(int j) { return (void)j, false; }
bool get_homing_is_active(void) { return false; }
bool get_index_enable(int j) { return *pins->joint[j].index_enable; }
void do_home_joint(int j) { (void)j; }
void do_cancel_homing(int j) { (void)j; }
void set_unhomed(int j, motion_state_t state) { (void)j, (void)state; }

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
