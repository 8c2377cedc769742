/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * homing.c - homing of joints, the default implementation of homing.h: requests,
 * the sequence in which joints home, parameters, pins.
 *
 * In:     parameters, requests, pins joint.N.home-sw-in, index-enable
 * Out:    homed and homing of each joint, pins joint.N.home-...
 * Thread: servo
 * Method: one state machine for the sequence of joints here, one per joint in
 *         homing_joint.c. homemod.c makes them a module; a custom module includes
 *         this file, see homing_custom.h.
 */
#include <string.h>
#include "homing_custom.h"
#include "homing_priv.h"
#ifdef CUSTOM_HOMEMODULE
#include "homing_joint.c"
#endif

#define UNUSED_SEQUENCE 1000    /* before configuration */

struct homing homes;
int homing_owner;

/* ---- sequence ---- */

/* Prepares joints for a request; 0 when there is none or one of them is busy. */
static int prepare(int (*chosen)(int j, int arg), int arg)
{
    int any = 0;
    for (int j = 0; j < homes.joints; j++)
        if (chosen(j, arg) && homes.joint[j].state != HOME_IDLE && homes.joint[j].state != HOME_START)
            return 0;
    for (int j = 0; j < homes.joints; j++) {
        struct home_joint *h = &homes.joint[j];
        h->in_sequence = 0;
        if (!chosen(j, arg) || !is_active_joint(j))
            continue;
        if (has(j, HOME_NO_REHOME) && h->homed)
            continue;
        h->in_sequence = 1;
        h->homed = 0;
        any = 1;
    }
    return any;
}

static int in_home_all(int j, int arg)
{
    (void)arg;
    return takes_part(j);
}
static int in_group(int j, int number) { return takes_part(j) && abs_sequence(j) == number; }
static int is_one(int j, int one) { return j == one; }

/* A negative number makes the whole group negative. */
static void sign_groups(void)
{
    for (int j = 0; j < homes.joints; j++)
        if (takes_part(j) && homes.joint[j].sequence > 0)
            for (int k = 0; k < homes.joints; k++)
                if (homes.joint[k].sequence == -homes.joint[j].sequence) {
                    homes.joint[j].sequence = -homes.joint[j].sequence;
                    break;
                }
}

static void find_synchronized(void)
{
    for (int j = 0; j < homes.joints; j++) {
        homes.joint[j].grouped = 0;
        for (int k = 0; k < homes.joints; k++)
            if (homes.joint[k].sequence < 0 && takes_part(k) && abs_sequence(j) == -homes.joint[k].sequence)
                homes.joint[j].grouped = 1;
    }
}

/* Starts the joints of the present number. Returns how many. */
static int start_joints(void)
{
    int n = 0;
    for (int j = 0; j < homes.joints; j++) {
        struct home_joint *h = &homes.joint[j];
        if (!h->in_sequence || (homes.current >= 0 && abs_sequence(j) != homes.current))
            continue;
        homes.motion[j].free_tp.enable = 0;
        h->state = HOME_START;
        n++;
    }
    return n;
}

static int joints_left(void)
{
    for (int j = 0; j < homes.joints; j++)
        if (homes.joint[j].in_sequence && homes.joint[j].state == HOME_IDLE)
            return 1;
    return 0;
}

static int all_idle(void)
{
    for (int j = 0; j < homes.joints; j++)
        if (homes.joint[j].state != HOME_IDLE)
            return 0;
    return 1;
}

static void finish_sequence(void)
{
    for (int j = 0; j < homes.joints; j++)
        homes.joint[j].in_sequence = 0;
    homes.sequence_state = HOME_SEQUENCE_IDLE;
    homes.active = 0;
}

static void run_sequence(void)
{
    switch (homes.sequence_state) {
    case HOME_SEQUENCE_IDLE:
        return;
    case HOME_SEQUENCE_START:
    case HOME_SEQUENCE_DO_ONE_JOINT:
    case HOME_SEQUENCE_DO_ONE_SEQUENCE:
        homes.current = homes.sequence_state == HOME_SEQUENCE_START ? 0 : homes.current;
        homes.sequence_state = HOME_SEQUENCE_START_JOINTS;
        /* fall through */
    case HOME_SEQUENCE_START_JOINTS:
        if (start_joints() > 0) {
            homes.sequence_state = HOME_SEQUENCE_WAIT_JOINTS;
        } else if (homes.current == 0 && joints_left()) {
            homes.current = 1;
            if (start_joints() > 0)
                homes.sequence_state = HOME_SEQUENCE_WAIT_JOINTS;
            else
                finish_sequence();
        } else {
            finish_sequence();
        }
        return;
    case HOME_SEQUENCE_WAIT_JOINTS:
        if (!all_idle())
            return;
        if (homes.current < 0) {
            finish_sequence();
            return;
        }
        homes.current++;
        homes.sequence_state = HOME_SEQUENCE_START_JOINTS;
        return;
    default:
        homing_error("unknown state '%d' during homing sequence", (int)homes.sequence_state, 0);
        homing_abort_all();
    }
}

/* ---- interface ---- */

void HOMING(homeMotFunctions)(void (*pSetRotaryUnlock)(int, int), int (*pGetRotaryIsUnlocked)(int))
{
    homes.set_unlock = pSetRotaryUnlock;
    homes.is_unlocked = pGetRotaryIsUnlocked;
}

static int make_pins(int id, int n)
{
    homes.pins = hal_malloc((long)sizeof(struct home_pins) * EMCMOT_MAX_JOINTS);
    if (!homes.pins) {
        rtapi_print_msg(RTAPI_MSG_ERR, "HOMING: all_joints_home_data_t malloc failed\n");
        return -1;
    }
    for (int j = 0; j < n; j++) {
        struct home_pins *p = &homes.pins[j];
        if (hal_pin_new_bool(id, HAL_IN, &p->home_sw_in, 0, "joint.%d.home-sw-in", j) < 0 ||
            hal_pin_new_bool(id, HAL_OUT, &p->homing, 0, "joint.%d.homing", j) < 0 ||
            hal_pin_new_bool(id, HAL_OUT, &p->homed, 0, "joint.%d.homed", j) < 0 ||
            hal_pin_new_si32(id, HAL_OUT, &p->home_state, 0, "joint.%d.home-state", j) < 0 ||
            hal_pin_new_bool(id, HAL_IO, &p->index_enable, 0, "joint.%d.index-enable", j) < 0)
            return -1;
    }
    return 0;
}

/* Bounds of the moves, parameters of the homing module itself: what motmod shows is documented. */
static int make_params(int id, int n)
{
    int owner = homing_owner > 0 ? homing_owner : id;
    if (owner != id && hal_set_unready(owner) < 0)
        return -1;
    for (int j = 0; j < n; j++) {
        struct home_pins *p = &homes.pins[j];
        if (hal_param_new_real(owner, HAL_RW, &p->search_max, 0.0, "joint.%d.home-search-max", j) < 0 ||
            hal_param_new_real(owner, HAL_RW, &p->backoff_max, 0.0, "joint.%d.home-backoff-max", j) < 0 ||
            hal_param_new_real(owner, HAL_RW, &p->latch_max, 0.0, "joint.%d.home-latch-max", j) < 0 ||
            hal_param_new_real(owner, HAL_RW, &p->rack_max, 0.0, "joint.%d.home-rack-max", j) < 0)
            return -1;
    }
    return owner != id ? hal_ready(owner) : 0;
}

int HOMING(homing_init)(int id, double servo_period, int n_joints, int n_extrajoints, emcmot_joint_t *pjoints)
{
    void (*set_unlock)(int, int) = homes.set_unlock;
    int (*is_unlocked)(int) = homes.is_unlocked;
    if (!(servo_period >= 1e-9) || n_joints < 0 || n_joints > EMCMOT_MAX_JOINTS) {
        rtapi_print_msg(RTAPI_MSG_ERR, "homing_init: bad servo_period %g or number of joints %d\n", servo_period,
                        n_joints);
        return -1;
    }
    memset(&homes, 0, sizeof(homes));
    homes.set_unlock = set_unlock;
    homes.is_unlocked = is_unlocked;
    homes.joints = n_joints;
    homes.extra = n_extrajoints;
    homes.period = servo_period;
    homes.motion = pjoints;
    for (int j = 0; j < EMCMOT_MAX_JOINTS; j++) {
        homes.joint[j].sequence = UNUSED_SEQUENCE;
        homes.joint[j].delay = -1;
    }
    return make_pins(id, n_joints) < 0 || make_params(id, n_joints) < 0 ? -1 : 0;
}

bool HOMING(get_allhomed)(void)
{
    int any = 0;
    for (int j = 0; j < homes.joints; j++) {
        if (!is_active_joint(j))
            continue;
        any = 1;
        if (!homes.joint[j].homed)
            return false;
    }
    return any;
}

bool HOMING(get_homed)(int j) { return j >= 0 && j < homes.joints && homes.joint[j].homed; }
bool HOMING(get_home_is_idle)(int j) { return j < 0 || j >= homes.joints || homes.joint[j].state == HOME_IDLE; }
bool HOMING(get_home_is_synchronized)(int j) { return j >= 0 && j < homes.joints && homes.joint[j].grouped; }
bool HOMING(get_home_needs_unlock_first)(int j) { return j >= 0 && j < homes.joints && has(j, HOME_UNLOCK_FIRST); }
int HOMING(get_home_sequence)(int j) { return j >= 0 && j < homes.joints ? homes.joint[j].sequence : UNUSED_SEQUENCE; }
bool HOMING(get_homing)(int j) { return j >= 0 && j < homes.joints && homes.joint[j].homing_shown; }
bool HOMING(get_homing_at_index_search_wait)(int j)
{
    return j >= 0 && j < homes.joints && homes.joint[j].state == HOME_INDEX_SEARCH_WAIT;
}
bool HOMING(get_homing_is_active)(void) { return homes.active; }
bool HOMING(get_index_enable)(int j) { return j >= 0 && j < homes.joints && homes.joint[j].index_read; }

bool HOMING(do_homing)(void)
{
    bool before = HOMING(get_allhomed)();
    homing_release_groups();
    for (int j = 0; j < homes.joints; j++)
        if (homes.joint[j].state != HOME_IDLE) {
            int was = homes.active;
            if (is_active_joint(j))
                homing_run_joint(j);
            else
                homing_abort_all(); /* deactivated under way: nobody would wait for it in vain */
            if (was && !homes.active)
                break; /* aborted: every joint has been reset */
        }
    run_sequence();
    if (get_allhomed() && !before)
        finish_sequence();
    if (!homing_invariants_hold()) {
        homing_error("homing of %d joints lost its way in sequence %d: stopped", homes.joints, homes.current);
        homing_abort_all();
    }
    for (int j = 0; j < homes.joints; j++)
        homes.joint[j].homing_shown =
            homes.active && (homes.joint[j].homing || homes.joint[j].homing_shown);
    return HOMING(get_allhomed)() && !before;
}

void HOMING(read_homing_in_pins)(int njoints)
{
    for (int j = 0; j < njoints && j < homes.joints; j++) {
        homes.joint[j].switch_read = hal_get_bool(homes.pins[j].home_sw_in);
        homes.joint[j].index_read = hal_get_bool(homes.pins[j].index_enable);
    }
}

void HOMING(write_homing_out_pins)(int njoints)
{
    for (int j = 0; j < njoints && j < homes.joints; j++) {
        struct home_joint *h = &homes.joint[j];
        hal_set_bool(homes.pins[j].homing, h->homing_shown);
        hal_set_bool(homes.pins[j].homed, h->homed);
        hal_set_si32(homes.pins[j].home_state, h->state);
        if (h->index_written) {
            hal_set_bool(homes.pins[j].index_enable, h->index_request);
            h->index_written = 0;
        }
    }
}

void HOMING(do_home_joint)(int jno)
{
    int ok;
    if (homes.active || jno >= homes.joints)
        return;
    if (jno < 0) {
        sign_groups();
        find_synchronized();
        ok = prepare(in_home_all, 0);
        homes.sequence_state = ok ? HOME_SEQUENCE_START : HOME_SEQUENCE_IDLE;
    } else if (homes.joint[jno].sequence < 0 || homes.joint[jno].grouped) {
        sign_groups();
        homes.current = abs_sequence(jno);
        ok = prepare(in_group, homes.current);
        homes.sequence_state = ok ? HOME_SEQUENCE_DO_ONE_SEQUENCE : HOME_SEQUENCE_IDLE;
    } else {
        homes.current = -1; /* whatever its number */
        ok = prepare(is_one, jno);
        homes.sequence_state = ok ? HOME_SEQUENCE_DO_ONE_JOINT : HOME_SEQUENCE_IDLE;
    }
    homes.active = ok;
}

void HOMING(do_cancel_homing)(int jno)
{
    if (jno >= 0 && jno < homes.joints && (homes.joint[jno].homing || homes.joint[jno].in_sequence))
        homing_abort_all();
}

/* Why joint j cannot be unhomed now; 1 when refused (message given). */
static int refuse_unhome(int j, motion_state_t state, int one)
{
    const char *nl = one ? "\n" : "";
    if (one && j >= homes.joints - homes.extra && state != EMCMOT_MOTION_DISABLED) {
        rtapi_print_msg(RTAPI_MSG_ERR, "Cannot unhome extrajoint <%d> with motion enabled%s", j, nl);
        return 1;
    }
    if (!is_active_joint(j)) {
        if (one)
            rtapi_print_msg(RTAPI_MSG_ERR, "Cannot unhome inactive joint %d%s", j, nl);
        return one;
    }
    if (homes.joint[j].homing) {
        rtapi_print_msg(RTAPI_MSG_ERR, "Cannot unhome while homing, joint %d%s", j, nl);
        return 1;
    }
    if (!(homes.motion[j].flag & EMCMOT_JOINT_INPOS_BIT)) {
        rtapi_print_msg(RTAPI_MSG_ERR, "Cannot unhome while moving, joint %d%s", j, nl);
        return 1;
    }
    if (!one && j >= homes.joints - homes.extra && state != EMCMOT_MOTION_DISABLED) {
        rtapi_print_msg(RTAPI_MSG_ERR, "Cannot unhome extrajoint <%d> with motion enabled%s", j, nl);
        return 1;
    }
    return 0;
}

void HOMING(set_unhomed)(int jno, motion_state_t motstate)
{
    if (jno >= homes.joints) {
        rtapi_print_msg(RTAPI_MSG_ERR, "Cannot unhome invalid joint %d (max %d)\n", jno, homes.joints - 1);
        return;
    }
    if (jno >= 0) {
        if (!refuse_unhome(jno, motstate, 1))
            homes.joint[jno].homed = 0;
        return;
    }
    for (int j = 0; j < homes.joints; j++)
        if (refuse_unhome(j, motstate, 0))
            return;
    for (int j = 0; j < homes.joints; j++)
        if (is_active_joint(j) && (jno == -1 || homes.joint[j].volatile_home))
            homes.joint[j].homed = 0;
}

void HOMING(set_joint_homing_params)(int jno, double offset, double home, double home_final_vel, double home_search_vel,
                             double home_latch_vel, int home_flags, int home_sequence, bool volatile_home)
{
    if (jno < 0 || jno >= homes.joints)
        return;
    struct home_joint *h = &homes.joint[jno];
    h->offset = offset;
    h->home = home;
    h->final_vel = home_final_vel;
    h->search_vel = home_search_vel;
    h->latch_vel = home_latch_vel;
    h->flags = home_flags;
    h->sequence = home_sequence;
    h->volatile_home = volatile_home;
    find_synchronized();
}

void HOMING(update_joint_homing_params)(int jno, double offset, double home, int home_sequence)
{
    if (jno < 0 || jno >= homes.joints)
        return;
    homes.joint[jno].offset = offset;
    homes.joint[jno].home = home;
    homes.joint[jno].sequence = home_sequence;
    find_synchronized();
}

#define HOMING_EXPORTS
#include "homing_custom.h"
