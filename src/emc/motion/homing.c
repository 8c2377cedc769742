/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * homing.c - homing of joints: the default implementation of homing.h.
 *
 * In:     parameters, requests, home switches, index-enable, joints
 * Out:    free_tp targets, joint positions and offsets, homed, pins joint.N.home-...
 * Thread: servo; a cycle runs at most MAX_EDGES states of a joint
 * Method: one state machine per joint (a table of state functions) and one
 *         for the sequence. homemod.c makes it a module; a custom module includes
 *         this file with CUSTOM_HOMEMODULE defined and replaces functions.
 *
 * Invariants: (1) index_request only in states 16 to 18; (2) homed implies not
 * homing; (3) a joint that fails stops all joints that are homing: nothing of a
 * group moves on after one of it failed.
 */
#include <math.h>
#include <string.h>
#include "hal.h"
#include "homing.h"
#include "rtapi.h"

#define HOME_DELAY_S 0.100      /* rest before a move in another direction */
#define MAX_EDGES 12            /* states entered within one cycle */
#define UNUSED_SEQUENCE 1000    /* before configuration */
#define LAST_SEQUENCE 100       /* higher numbers take no part in home-all */
#define SEARCH_TRAVEL 2.0       /* search distance in parts of the joint's range */

struct home_joint {
    home_state_t state;
    int homing, homed;
    int homing_shown;       /* homing, its falling edge held until all have ended */
    int in_sequence;        /* takes part in what runs now */
    int synchronized_;      /* member of a group with a negative number */
    int sync_ready;         /* waits in FINAL_MOVE_START for the group */
    int delay;              /* cycles left to wait, -1 not waiting */
    int index_request;      /* index-enable set and not yet answered */
    int index_read;         /* index-enable as read this cycle */
    int index_written;      /* a write is due: 1 */
    int switch_read;
    int moved;              /* a homing move was started in this state */
    double offset, home, final_vel, search_vel, latch_vel;
    int flags, sequence;
    bool volatile_home;
};

struct home_pins {
    hal_bool_t home_sw_in, homing, homed, index_enable;
    hal_sint_t home_state;
};

static struct {
    struct home_joint joint[EMCMOT_MAX_JOINTS];
    struct home_pins *pins; /* array */
    emcmot_joint_t *motion; /* joints of the motion controller */
    int joints, extra;
    double period;
    home_sequence_state_t sequence_state;
    int current;            /* sequence number being homed */
    int active;             /* a request is being worked on */
    int group_released;     /* final moves of the present group may run */
    void (*set_unlock)(int joint, int unlock);
    int (*is_unlocked)(int joint);
} H;

static void homing_error(const char *fmt, int a, int b)
{
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
    rtapi_print_msg(RTAPI_MSG_ERR, fmt, a, b);
#pragma GCC diagnostic pop
}

static int abs_sequence(int j) { return H.joint[j].sequence < 0 ? -H.joint[j].sequence : H.joint[j].sequence; }
static int takes_part(int j) { return abs_sequence(j) <= LAST_SEQUENCE; }
static int is_active_joint(int j) { return (H.motion[j].flag & EMCMOT_JOINT_ACTIVE_BIT) != 0; }
static int has(int j, int flag) { return (H.joint[j].flags & flag) != 0; }

/* ---- moves ---- */

static double limited_speed(int j, double vel)
{
    double v = fabs(vel);
    return v < H.motion[j].vel_limit ? v : H.motion[j].vel_limit;
}

/* Moves in the direction of vel over more than the joint's whole range. */
static void start_move(int j, double vel)
{
    emcmot_joint_t *m = &H.motion[j];
    double range = SEARCH_TRAVEL * (m->max_pos_limit - m->min_pos_limit);
    m->free_tp.pos_cmd = m->pos_cmd + (vel > 0.0 ? range : -range);
    m->free_tp.max_vel = limited_speed(j, vel);
    m->free_tp.enable = 1;
}

static void stop_move(int j) { H.motion[j].free_tp.enable = 0; }

/* Waits until the joint rests and then HOME_DELAY_S. 1 when over. */
static int delay_over(int j)
{
    struct home_joint *h = &H.joint[j];
    if (H.motion[j].free_tp.active || h->delay < 0) {
        h->delay = (int)ceil(HOME_DELAY_S / H.period);
        if (H.motion[j].free_tp.active)
            return 0;
    }
    if (h->delay > 0) {
        h->delay--;
        return 0;
    }
    h->delay = -1;
    return 1;
}

/* Ends of a search: limit switch or end of the move. 1 when the state machine has to abort. */
static int search_failed(int j)
{
    const emcmot_joint_t *m = &H.motion[j];
    if ((m->on_pos_limit || m->on_neg_limit) && !has(j, HOME_IGNORE_LIMITS)) {
        homing_error("j%d hit limit in home state %d", j, H.joint[j].state);
        return 1;
    }
    if (!m->free_tp.active) {
        homing_error("j%d end of move in home state %d", j, H.joint[j].state);
        return 1;
    }
    return 0;
}

/* Shifts the joint's coordinate by offset; the motor does not move. */
static void shift_position(int j, double offset)
{
    emcmot_joint_t *m = &H.motion[j];
    m->pos_cmd += offset;
    m->coarse_pos += offset;
    m->pos_fb += offset;
    m->free_tp.curr_pos += offset;
    if (!m->free_tp.enable)
        m->free_tp.pos_cmd += offset;
    m->motor_offset -= offset;
}

static void request_index(int j, int on)
{
    struct home_joint *h = &H.joint[j];
    if (h->index_request == on)
        return;
    h->index_request = on;
    h->index_written = 1;
}

/* ---- states: each returns the next one; another state is entered in the same cycle
 * when the function says so through *again ---- */

typedef home_state_t (*state_function)(int j, int *again);

static home_state_t stay(int j, int *again)
{
    (void)again;
    return H.joint[j].state;
}

/* Entered at once. */
static home_state_t go(home_state_t next, int *again)
{
    *again = 1;
    return next;
}

static home_state_t state_start(int j, int *again)
{
    struct home_joint *h = &H.joint[j];
    if (has(j, HOME_IS_SHARED) && h->switch_read && !has(j, HOME_ABSOLUTE_ENCODER)) {
        homing_error("Cannot home while shared home switch is closed j=%d", j, 0);
        return go(HOME_ABORT, again);
    }
    if (has(j, HOME_NO_REHOME) && h->homed) {
        h->in_sequence = 0;
        return HOME_IDLE;
    }
    h->homing = 1;
    h->homed = 0;
    stop_move(j);
    h->delay = -1;
    h->sync_ready = 0;
    H.group_released = 0;
    if (has(j, HOME_ABSOLUTE_ENCODER))
        return go(HOME_SET_SWITCH_POSITION, again);
    if (has(j, HOME_UNLOCK_FIRST))
        return HOME_UNLOCK;
    return go(HOME_UNLOCK_WAIT, again);
}

static home_state_t state_unlock(int j, int *again)
{
    (void)again;
    H.set_unlock(j, 1);
    return HOME_UNLOCK_WAIT;
}

static home_state_t state_unlock_wait(int j, int *again)
{
    const struct home_joint *h = &H.joint[j];
    if (has(j, HOME_UNLOCK_FIRST) && !H.is_unlocked(j))
        return HOME_UNLOCK_WAIT;
    if (h->search_vel == 0.0) {
        if (h->latch_vel == 0.0)
            return go(HOME_SET_SWITCH_POSITION, again);
        if (has(j, HOME_USE_INDEX))
            return go(HOME_INDEX_ONLY_START, again);
        homing_error("invalid homing config: non-zero LATCH_VEL needs either SEARCH_VEL or USE_INDEX", 0, 0);
        return HOME_ABORT;
    }
    if (h->latch_vel != 0.0)
        return go(HOME_INITIAL_SEARCH_START, again);
    homing_error("invalid homing config: non-zero SEARCH_VEL needs LATCH_VEL", 0, 0);
    return HOME_ABORT;
}

static home_state_t state_initial_backoff_start(int j, int *again)
{
    (void)again;
    if (!delay_over(j))
        return HOME_INITIAL_BACKOFF_START;
    start_move(j, -H.joint[j].search_vel);
    H.motion[j].free_tp.active = 1; /* looked at before the planner runs */
    return HOME_INITIAL_BACKOFF_WAIT;
}

static home_state_t state_initial_backoff_wait(int j, int *again)
{
    if (!H.joint[j].switch_read) {
        stop_move(j);
        return go(HOME_INITIAL_SEARCH_START, again);
    }
    return search_failed(j) ? HOME_ABORT : HOME_INITIAL_BACKOFF_WAIT;
}

static home_state_t state_initial_search_start(int j, int *again)
{
    if (!delay_over(j))
        return HOME_INITIAL_SEARCH_START;
    if (H.joint[j].switch_read)
        return go(HOME_INITIAL_BACKOFF_START, again);
    start_move(j, H.joint[j].search_vel);
    H.motion[j].free_tp.active = 1;
    return HOME_INITIAL_SEARCH_WAIT;
}

static home_state_t state_initial_search_wait(int j, int *again)
{
    if (H.joint[j].switch_read) {
        stop_move(j);
        return go(HOME_SET_COARSE_POSITION, again);
    }
    return search_failed(j) ? HOME_ABORT : HOME_INITIAL_SEARCH_WAIT;
}

static home_state_t state_set_coarse_position(int j, int *again)
{
    const struct home_joint *h = &H.joint[j];
    shift_position(j, h->offset - H.motion[j].pos_fb);
    return go(h->search_vel * h->latch_vel > 0.0 ? HOME_FINAL_BACKOFF_START : HOME_FALL_SEARCH_START, again);
}

static home_state_t state_final_backoff_start(int j, int *again)
{
    if (!delay_over(j))
        return HOME_FINAL_BACKOFF_START;
    if (!H.joint[j].switch_read) {
        homing_error("Home switch inactive before start of backoff move j=%d", j, 0);
        return go(HOME_ABORT, again);
    }
    start_move(j, -H.joint[j].search_vel);
    H.motion[j].free_tp.active = 1;
    return HOME_FINAL_BACKOFF_WAIT;
}

static home_state_t state_final_backoff_wait(int j, int *again)
{
    if (!H.joint[j].switch_read) {
        stop_move(j);
        return go(HOME_RISE_SEARCH_START, again);
    }
    return search_failed(j) ? HOME_ABORT : HOME_FINAL_BACKOFF_WAIT;
}

static home_state_t state_rise_search_start(int j, int *again)
{
    if (!delay_over(j))
        return HOME_RISE_SEARCH_START;
    if (H.joint[j].switch_read) {
        homing_error("Home switch active before start of latch move j=%d", j, 0);
        return go(HOME_ABORT, again);
    }
    start_move(j, H.joint[j].latch_vel);
    H.motion[j].free_tp.active = 1;
    return HOME_RISE_SEARCH_WAIT;
}

static home_state_t latched(int j, int *again)
{
    if (has(j, HOME_USE_INDEX))
        return go(HOME_INDEX_SEARCH_START, again);
    stop_move(j);
    return go(HOME_SET_SWITCH_POSITION, again);
}

static home_state_t state_rise_search_wait(int j, int *again)
{
    if (H.joint[j].switch_read)
        return latched(j, again);
    return search_failed(j) ? HOME_ABORT : HOME_RISE_SEARCH_WAIT;
}

static home_state_t state_fall_search_start(int j, int *again)
{
    if (!delay_over(j))
        return HOME_FALL_SEARCH_START;
    if (!H.joint[j].switch_read) {
        homing_error("Home switch inactive before start of latch move j=%d", j, 0);
        return go(HOME_ABORT, again);
    }
    start_move(j, H.joint[j].latch_vel);
    H.motion[j].free_tp.active = 1;
    return HOME_FALL_SEARCH_WAIT;
}

static home_state_t state_fall_search_wait(int j, int *again)
{
    if (!H.joint[j].switch_read)
        return latched(j, again);
    return search_failed(j) ? HOME_ABORT : HOME_FALL_SEARCH_WAIT;
}

static home_state_t state_set_switch_position(int j, int *again)
{
    struct home_joint *h = &H.joint[j];
    emcmot_joint_t *m = &H.motion[j];
    if (has(j, HOME_ABSOLUTE_ENCODER)) {
        /* joint position = motor position + HOME_OFFSET, however often it is homed */
        shift_position(j, m->motor_offset);
        shift_position(j, h->offset);
        if (has(j, HOME_NO_FINAL_MOVE)) {
            h->homed = 1;
            return go(HOME_FINISHED, again);
        }
    } else {
        shift_position(j, h->offset - m->pos_fb);
    }
    return go(HOME_FINAL_MOVE_START, again);
}

static home_state_t state_index_only_start(int j, int *again)
{
    const struct home_joint *h = &H.joint[j];
    (void)again;
    if (!delay_over(j))
        return HOME_INDEX_ONLY_START;
    shift_position(j, h->offset - H.motion[j].pos_fb);
    request_index(j, 1);
    start_move(j, h->latch_vel);
    H.motion[j].free_tp.active = 1;
    return HOME_INDEX_SEARCH_WAIT;
}

static home_state_t state_index_search_start(int j, int *again)
{
    request_index(j, 1);
    if (search_failed(j))
        return HOME_ABORT;
    (void)again;
    return HOME_INDEX_SEARCH_WAIT; /* the request leaves at the end of this cycle */
}

static home_state_t state_index_search_wait(int j, int *again)
{
    struct home_joint *h = &H.joint[j];
    if (!h->index_read) {
        h->index_request = 0; /* answered: nothing to write */
        stop_move(j);
        return go(HOME_SET_INDEX_POSITION, again);
    }
    return search_failed(j) ? HOME_ABORT : HOME_INDEX_SEARCH_WAIT;
}

static home_state_t state_set_index_position(int j, int *again)
{
    const struct home_joint *h = &H.joint[j];
    emcmot_joint_t *m = &H.motion[j];
    double before = m->pos_cmd, after;
    if (has(j, HOME_INDEX_NO_ENCODER_RESET)) {
        m->pos_fb = m->motor_pos_fb - (m->backlash_filt + m->motor_offset);
        shift_position(j, h->offset - m->pos_fb);
    } else {
        m->motor_offset = -h->offset;
        m->pos_fb = m->motor_pos_fb - (m->backlash_filt + m->motor_offset);
        after = m->pos_fb;
        m->pos_cmd = m->coarse_pos = after;
        m->free_tp.curr_pos += after - before;
        m->free_tp.pos_cmd = m->free_tp.curr_pos;
    }
    return go(HOME_FINAL_MOVE_START, again);
}

/* All members of j's group that are being homed have come to their final move. */
static int group_ready(int j)
{
    for (int k = 0; k < H.joints; k++) {
        const struct home_joint *h = &H.joint[k];
        if (!h->in_sequence || abs_sequence(k) != abs_sequence(j) || has(k, HOME_ABSOLUTE_ENCODER))
            continue;
        if (h->state != HOME_FINAL_MOVE_START || H.motion[k].free_tp.active)
            return 0;
    }
    return 1;
}

static home_state_t state_final_move_start(int j, int *again)
{
    struct home_joint *h = &H.joint[j];
    emcmot_joint_t *m = &H.motion[j];
    (void)again;
    if (m->free_tp.active)
        return HOME_FINAL_MOVE_START;
    if (h->sequence < 0 && !has(j, HOME_ABSOLUTE_ENCODER)) {
        if (!H.group_released && !group_ready(j))
            return HOME_FINAL_MOVE_START;
        H.group_released = 1;
    }
    m->free_tp.pos_cmd = h->home;
    m->free_tp.max_vel = h->final_vel > 0.0 ? limited_speed(j, h->final_vel) : m->vel_limit;
    m->free_tp.enable = 1;
    m->free_tp.active = 1;
    return HOME_FINAL_MOVE_WAIT;
}

static home_state_t state_final_move_wait(int j, int *again)
{
    const emcmot_joint_t *m = &H.motion[j];
    if (!m->free_tp.active) {
        stop_move(j);
        return go(HOME_LOCK, again);
    }
    if ((m->on_pos_limit || m->on_neg_limit) && !has(j, HOME_IGNORE_LIMITS)) {
        homing_error("hit limit in home state j=%d", j, 0);
        return go(HOME_ABORT, again);
    }
    return HOME_FINAL_MOVE_WAIT;
}

static home_state_t state_lock(int j, int *again)
{
    if (!has(j, HOME_UNLOCK_FIRST))
        return go(HOME_LOCK_WAIT, again);
    H.set_unlock(j, 0);
    return HOME_LOCK_WAIT;
}

static home_state_t state_lock_wait(int j, int *again)
{
    if (has(j, HOME_UNLOCK_FIRST) && H.is_unlocked(j))
        return HOME_LOCK_WAIT;
    return go(HOME_FINISHED, again);
}

static home_state_t state_finished(int j, int *again)
{
    struct home_joint *h = &H.joint[j];
    (void)again;
    h->homing = 0;
    h->homed = 1;
    h->in_sequence = 0;
    return HOME_IDLE;
}

/* Ends homing of every joint (invariant 3). Joints that took no part keep their homed flag. */
static void abort_all(void)
{
    for (int j = 0; j < H.joints; j++) {
        struct home_joint *h = &H.joint[j];
        if (h->homing || h->state != HOME_IDLE || h->in_sequence) {
            if (h->homing || (h->state != HOME_IDLE && h->state != HOME_START))
                h->homed = 0;
            stop_move(j);
        }
        h->homing = 0;
        h->in_sequence = 0;
        h->sync_ready = 0;
        h->delay = -1;
        h->state = HOME_IDLE;
        request_index(j, 0);
        if (has(j, HOME_UNLOCK_FIRST) && H.set_unlock)
            H.set_unlock(j, 0);
    }
    H.sequence_state = HOME_SEQUENCE_IDLE;
    H.active = 0;
}

static home_state_t state_abort(int j, int *again)
{
    (void)j;
    (void)again;
    abort_all();
    return HOME_IDLE;
}

static const state_function states[] = {
    [HOME_IDLE] = stay,
    [HOME_START] = state_start,
    [HOME_UNLOCK] = state_unlock,
    [HOME_UNLOCK_WAIT] = state_unlock_wait,
    [HOME_INITIAL_BACKOFF_START] = state_initial_backoff_start,
    [HOME_INITIAL_BACKOFF_WAIT] = state_initial_backoff_wait,
    [HOME_INITIAL_SEARCH_START] = state_initial_search_start,
    [HOME_INITIAL_SEARCH_WAIT] = state_initial_search_wait,
    [HOME_SET_COARSE_POSITION] = state_set_coarse_position,
    [HOME_FINAL_BACKOFF_START] = state_final_backoff_start,
    [HOME_FINAL_BACKOFF_WAIT] = state_final_backoff_wait,
    [HOME_RISE_SEARCH_START] = state_rise_search_start,
    [HOME_RISE_SEARCH_WAIT] = state_rise_search_wait,
    [HOME_FALL_SEARCH_START] = state_fall_search_start,
    [HOME_FALL_SEARCH_WAIT] = state_fall_search_wait,
    [HOME_SET_SWITCH_POSITION] = state_set_switch_position,
    [HOME_INDEX_ONLY_START] = state_index_only_start,
    [HOME_INDEX_SEARCH_START] = state_index_search_start,
    [HOME_INDEX_SEARCH_WAIT] = state_index_search_wait,
    [HOME_SET_INDEX_POSITION] = state_set_index_position,
    [HOME_FINAL_MOVE_START] = state_final_move_start,
    [HOME_FINAL_MOVE_WAIT] = state_final_move_wait,
    [HOME_LOCK] = state_lock,
    [HOME_LOCK_WAIT] = state_lock_wait,
    [HOME_FINISHED] = state_finished,
    [HOME_ABORT] = state_abort,
};

static void run_joint(int j)
{
    struct home_joint *h = &H.joint[j];
    for (int edge = 0; edge < MAX_EDGES; edge++) {
        int again = 0;
        if ((unsigned)h->state >= sizeof(states) / sizeof(states[0])) {
            homing_error("unknown state '%d' during homing j=%d", h->state, j);
            h->state = HOME_ABORT;
        }
        h->state = states[h->state](j, &again);
        if (!again)
            return;
    }
}

/* ---- sequence ---- */

/* Prepares joints for a request; 0 when there is none or one of them is busy. */
static int prepare(int (*chosen)(int j, int arg), int arg)
{
    int any = 0;
    for (int j = 0; j < H.joints; j++)
        if (chosen(j, arg) && H.joint[j].state != HOME_IDLE && H.joint[j].state != HOME_START)
            return 0;
    for (int j = 0; j < H.joints; j++) {
        struct home_joint *h = &H.joint[j];
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
    for (int j = 0; j < H.joints; j++)
        if (takes_part(j) && H.joint[j].sequence > 0)
            for (int k = 0; k < H.joints; k++)
                if (H.joint[k].sequence == -H.joint[j].sequence) {
                    H.joint[j].sequence = -H.joint[j].sequence;
                    break;
                }
}

static void find_synchronized(void)
{
    for (int j = 0; j < H.joints; j++) {
        H.joint[j].synchronized_ = 0;
        for (int k = 0; k < H.joints; k++)
            if (H.joint[k].sequence < 0 && takes_part(k) && abs_sequence(j) == -H.joint[k].sequence)
                H.joint[j].synchronized_ = 1;
    }
}

/* Starts the joints of the present number. Returns how many. */
static int start_joints(void)
{
    int n = 0;
    for (int j = 0; j < H.joints; j++) {
        struct home_joint *h = &H.joint[j];
        if (!h->in_sequence || (H.current >= 0 && abs_sequence(j) != H.current))
            continue;
        stop_move(j);
        h->state = HOME_START;
        n++;
    }
    return n;
}

static int joints_left(void)
{
    for (int j = 0; j < H.joints; j++)
        if (H.joint[j].in_sequence && H.joint[j].state == HOME_IDLE)
            return 1;
    return 0;
}

static int all_idle(void)
{
    for (int j = 0; j < H.joints; j++)
        if (H.joint[j].state != HOME_IDLE)
            return 0;
    return 1;
}

static void finish_sequence(void)
{
    for (int j = 0; j < H.joints; j++)
        H.joint[j].in_sequence = 0;
    H.sequence_state = HOME_SEQUENCE_IDLE;
    H.active = 0;
}

static void run_sequence(void)
{
    switch (H.sequence_state) {
    case HOME_SEQUENCE_IDLE:
        return;
    case HOME_SEQUENCE_START:
    case HOME_SEQUENCE_DO_ONE_JOINT:
    case HOME_SEQUENCE_DO_ONE_SEQUENCE:
        H.current = H.sequence_state == HOME_SEQUENCE_START ? 0 : H.current;
        H.sequence_state = HOME_SEQUENCE_START_JOINTS;
        /* fall through */
    case HOME_SEQUENCE_START_JOINTS:
        if (start_joints() > 0) {
            H.sequence_state = HOME_SEQUENCE_WAIT_JOINTS;
        } else if (H.current == 0 && joints_left()) {
            H.current = 1;
            if (start_joints() > 0)
                H.sequence_state = HOME_SEQUENCE_WAIT_JOINTS;
            else
                finish_sequence();
        } else {
            finish_sequence();
        }
        return;
    case HOME_SEQUENCE_WAIT_JOINTS:
        if (!all_idle())
            return;
        if (H.current < 0) {
            finish_sequence();
            return;
        }
        H.current++;
        H.sequence_state = HOME_SEQUENCE_START_JOINTS;
        return;
    default:
        homing_error("unknown state '%d' during homing sequence", (int)H.sequence_state, 0);
        abort_all();
    }
}

/* ---- interface ---- */

void homeMotFunctions(void (*pSetRotaryUnlock)(int, int), int (*pGetRotaryIsUnlocked)(int))
{
    H.set_unlock = pSetRotaryUnlock;
    H.is_unlocked = pGetRotaryIsUnlocked;
}

static int make_pins(int id, int n)
{
    H.pins = hal_malloc((long)sizeof(struct home_pins) * EMCMOT_MAX_JOINTS);
    if (!H.pins) {
        rtapi_print_msg(RTAPI_MSG_ERR, "HOMING: all_joints_home_data_t malloc failed\n");
        return -1;
    }
    for (int j = 0; j < n; j++) {
        struct home_pins *p = &H.pins[j];
        if (hal_pin_new_bool(id, HAL_IN, &p->home_sw_in, 0, "joint.%d.home-sw-in", j) < 0 ||
            hal_pin_new_bool(id, HAL_OUT, &p->homing, 0, "joint.%d.homing", j) < 0 ||
            hal_pin_new_bool(id, HAL_OUT, &p->homed, 0, "joint.%d.homed", j) < 0 ||
            hal_pin_new_si32(id, HAL_OUT, &p->home_state, 0, "joint.%d.home-state", j) < 0 ||
            hal_pin_new_bool(id, HAL_IO, &p->index_enable, 0, "joint.%d.index-enable", j) < 0)
            return -1;
    }
    return 0;
}

int homing_init(int id, double servo_period, int n_joints, int n_extrajoints, emcmot_joint_t *pjoints)
{
    void (*set_unlock)(int, int) = H.set_unlock;
    int (*is_unlocked)(int) = H.is_unlocked;
    if (!(servo_period >= 1e-9) || n_joints < 0 || n_joints > EMCMOT_MAX_JOINTS) {
        rtapi_print_msg(RTAPI_MSG_ERR, "homing_init: bad servo_period %g or number of joints %d\n", servo_period,
                        n_joints);
        return -1;
    }
    memset(&H, 0, sizeof(H));
    H.set_unlock = set_unlock;
    H.is_unlocked = is_unlocked;
    H.joints = n_joints;
    H.extra = n_extrajoints;
    H.period = servo_period;
    H.motion = pjoints;
    for (int j = 0; j < EMCMOT_MAX_JOINTS; j++) {
        H.joint[j].sequence = UNUSED_SEQUENCE;
        H.joint[j].delay = -1;
    }
    return make_pins(id, n_joints);
}

bool get_allhomed(void)
{
    int any = 0;
    for (int j = 0; j < H.joints; j++) {
        if (!is_active_joint(j))
            continue;
        any = 1;
        if (!H.joint[j].homed)
            return false;
    }
    return any;
}

bool get_homed(int j) { return j >= 0 && j < H.joints && H.joint[j].homed; }
bool get_home_is_idle(int j) { return j < 0 || j >= H.joints || H.joint[j].state == HOME_IDLE; }
bool get_home_is_synchronized(int j) { return j >= 0 && j < H.joints && H.joint[j].synchronized_; }
bool get_home_needs_unlock_first(int j) { return j >= 0 && j < H.joints && has(j, HOME_UNLOCK_FIRST); }
int get_home_sequence(int j) { return j >= 0 && j < H.joints ? H.joint[j].sequence : UNUSED_SEQUENCE; }
bool get_homing(int j) { return j >= 0 && j < H.joints && H.joint[j].homing_shown; }
bool get_homing_at_index_search_wait(int j)
{
    return j >= 0 && j < H.joints && H.joint[j].state == HOME_INDEX_SEARCH_WAIT;
}
bool get_homing_is_active(void) { return H.active; }
bool get_index_enable(int j) { return j >= 0 && j < H.joints && H.joint[j].index_read; }

bool do_homing(void)
{
    bool before = get_allhomed();
    int any = 0;
    for (int j = 0; j < H.joints; j++)
        if (is_active_joint(j) && H.joint[j].state != HOME_IDLE) {
            int was = H.active;
            run_joint(j);
            if (was && !H.active)
                break; /* aborted: every joint has been reset */
        }
    run_sequence();
    for (int j = 0; j < H.joints; j++)
        any |= H.joint[j].homing;
    for (int j = 0; j < H.joints; j++)
        H.joint[j].homing_shown = H.joint[j].homing || (H.joint[j].homing_shown && (any || H.active));
    if (get_allhomed() && !before) {
        finish_sequence();
        for (int j = 0; j < H.joints; j++)
            H.joint[j].homing_shown = 0;
        return true;
    }
    return false;
}

void read_homing_in_pins(int njoints)
{
    for (int j = 0; j < njoints && j < H.joints; j++) {
        H.joint[j].switch_read = hal_get_bool(H.pins[j].home_sw_in);
        H.joint[j].index_read = hal_get_bool(H.pins[j].index_enable);
    }
}

void write_homing_out_pins(int njoints)
{
    for (int j = 0; j < njoints && j < H.joints; j++) {
        struct home_joint *h = &H.joint[j];
        hal_set_bool(H.pins[j].homing, h->homing_shown);
        hal_set_bool(H.pins[j].homed, h->homed);
        hal_set_si32(H.pins[j].home_state, h->state);
        if (h->index_written) {
            hal_set_bool(H.pins[j].index_enable, h->index_request);
            h->index_written = 0;
        }
    }
}

void do_home_joint(int jno)
{
    int ok;
    if (H.active || jno >= H.joints)
        return;
    if (jno < 0) {
        sign_groups();
        find_synchronized();
        ok = prepare(in_home_all, 0);
        H.sequence_state = ok ? HOME_SEQUENCE_START : HOME_SEQUENCE_IDLE;
    } else if (H.joint[jno].sequence < 0 || H.joint[jno].synchronized_) {
        sign_groups();
        H.current = abs_sequence(jno);
        ok = prepare(in_group, H.current);
        H.sequence_state = ok ? HOME_SEQUENCE_DO_ONE_SEQUENCE : HOME_SEQUENCE_IDLE;
    } else {
        H.current = -1; /* whatever its number */
        ok = prepare(is_one, jno);
        H.sequence_state = ok ? HOME_SEQUENCE_DO_ONE_JOINT : HOME_SEQUENCE_IDLE;
    }
    H.active = ok;
    H.group_released = 0;
}

void do_cancel_homing(int jno)
{
    if (jno >= 0 && jno < H.joints && (H.joint[jno].homing || H.joint[jno].in_sequence))
        abort_all();
}

/* Why joint j cannot be unhomed now; 1 when refused (message given). */
static int refuse_unhome(int j, motion_state_t state, int one)
{
    const char *nl = one ? "\n" : "";
    if (one && j >= H.joints - H.extra && state != EMCMOT_MOTION_DISABLED) {
        rtapi_print_msg(RTAPI_MSG_ERR, "Cannot unhome extrajoint <%d> with motion enabled%s", j, nl);
        return 1;
    }
    if (!is_active_joint(j)) {
        if (one)
            rtapi_print_msg(RTAPI_MSG_ERR, "Cannot unhome inactive joint %d%s", j, nl);
        return one;
    }
    if (H.joint[j].homing) {
        rtapi_print_msg(RTAPI_MSG_ERR, "Cannot unhome while homing, joint %d%s", j, nl);
        return 1;
    }
    if (!(H.motion[j].flag & EMCMOT_JOINT_INPOS_BIT)) {
        rtapi_print_msg(RTAPI_MSG_ERR, "Cannot unhome while moving, joint %d%s", j, nl);
        return 1;
    }
    if (!one && j >= H.joints - H.extra && state != EMCMOT_MOTION_DISABLED) {
        rtapi_print_msg(RTAPI_MSG_ERR, "Cannot unhome extrajoint <%d> with motion enabled%s", j, nl);
        return 1;
    }
    return 0;
}

void set_unhomed(int jno, motion_state_t motstate)
{
    if (jno >= H.joints) {
        rtapi_print_msg(RTAPI_MSG_ERR, "Cannot unhome invalid joint %d (max %d)\n", jno, H.joints - 1);
        return;
    }
    if (jno >= 0) {
        if (!refuse_unhome(jno, motstate, 1))
            H.joint[jno].homed = 0;
        return;
    }
    for (int j = 0; j < H.joints; j++)
        if (refuse_unhome(j, motstate, 0))
            return;
    for (int j = 0; j < H.joints; j++)
        if (is_active_joint(j) && (jno == -1 || H.joint[j].volatile_home))
            H.joint[j].homed = 0;
}

void set_joint_homing_params(int jno, double offset, double home, double home_final_vel, double home_search_vel,
                             double home_latch_vel, int home_flags, int home_sequence, bool volatile_home)
{
    if (jno < 0 || jno >= H.joints)
        return;
    struct home_joint *h = &H.joint[jno];
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

void update_joint_homing_params(int jno, double offset, double home, int home_sequence)
{
    if (jno < 0 || jno >= H.joints)
        return;
    H.joint[jno].offset = offset;
    H.joint[jno].home = home;
    H.joint[jno].sequence = home_sequence;
    find_synchronized();
}

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
