/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * homing_joint.c - homing of one joint: a state machine.
 *
 * In:     parameters, home switch, index-enable, joint                 homing_priv.h
 * Out:    free_tp target, positions and motor offset of the joint, homed
 * Thread: servo; a cycle follows at most MAX_EDGES edges of a joint
 * Method: looks[] turns the inputs into an event, edges[] says what the event does.
 *
 * Invariants, checked every cycle by homing_invariants_hold():
 * (1) an index is requested only in states 17 and 18;
 * (2) a joint that is homed is not homing;
 * (3) a joint that is homing takes part in the running sequence;
 * (4) without a running sequence every joint is idle.
 * And: every state that moves has edges for a limit switch and for the end of the move;
 * ABORT ends homing of all joints, so nothing of a sequence moves on after one failed.
 */
#include <math.h>
#include "homing_priv.h"

#define HOME_DELAY_S 0.100      /* rest before a move in another direction; contacts have settled then */
#define MAX_EDGES 12            /* states entered within one cycle */
#define SEARCH_TRAVEL 2.0       /* default length of a homing move in parts of the joint's range */

/* What the inputs mean in a state. */
enum event {
    EV_NONE,     /* stay */
    EV_NEXT,     /* the work of the state is done */
    EV_SWITCH,   /* the awaited edge of the home switch */
    EV_INDEX,    /* the encoder's index, or a search for it */
    EV_BACKOFF,  /* the switch is closed: off it first */
    EV_IMMEDIATE, EV_SEARCH, EV_ABSOLUTE, EV_LOCKED, EV_KEEP, /* kinds of homing */
    EV_LIMIT,    /* a limit switch */
    EV_END,      /* the move is over */
    EV_WRONG,    /* the home switch is not as it has to be */
    EV_NO_SOURCE, EV_NO_LATCH, /* impossible settings */
};

void homing_error(const char *fmt, int a, int b)
{
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
    rtapi_print_msg(RTAPI_MSG_ERR, fmt, a, b);
#pragma GCC diagnostic pop
}

/* ---- groups: joints with the same negative number go through the phases together ---- */

/* Phase of each state. A joint starts the move of a phase when no partner is in an earlier one,
 * and none is homed before all have come to rest. */
enum phase { PHASE_NONE, PHASE_BACK_OFF, PHASE_SEARCH, PHASE_LEAVE, PHASE_LATCH, PHASE_FINAL, PHASE_REST, PHASE_END };

static const enum phase phase_of[HOME_ABORT + 1] = {
    [HOME_INITIAL_BACKOFF_START] = PHASE_BACK_OFF, [HOME_INITIAL_BACKOFF_WAIT] = PHASE_BACK_OFF,
    [HOME_INITIAL_SEARCH_START] = PHASE_SEARCH,    [HOME_INITIAL_SEARCH_WAIT] = PHASE_SEARCH,
    [HOME_SET_COARSE_POSITION] = PHASE_SEARCH,     [HOME_FINAL_BACKOFF_START] = PHASE_LEAVE,
    [HOME_FINAL_BACKOFF_WAIT] = PHASE_LEAVE,       [HOME_RISE_SEARCH_START] = PHASE_LATCH,
    [HOME_RISE_SEARCH_WAIT] = PHASE_LATCH,         [HOME_FALL_SEARCH_START] = PHASE_LATCH,
    [HOME_FALL_SEARCH_WAIT] = PHASE_LATCH,         [HOME_SET_SWITCH_POSITION] = PHASE_LATCH,
    [HOME_INDEX_ONLY_START] = PHASE_LATCH,         [HOME_INDEX_SEARCH_START] = PHASE_LATCH,
    [HOME_INDEX_SEARCH_WAIT] = PHASE_LATCH,        [HOME_SET_INDEX_POSITION] = PHASE_LATCH,
    [HOME_FINAL_MOVE_START] = PHASE_FINAL,         [HOME_FINAL_MOVE_WAIT] = PHASE_FINAL,
    [HOME_LOCK] = PHASE_REST,                      [HOME_LOCK_WAIT] = PHASE_END,
    [HOME_FINISHED] = PHASE_END,                   [HOME_ABORT] = PHASE_END,
};

static int waits_for_group(int j) { return homes.joint[j].grouped && takes_part(j) && !has(j, HOME_ABSOLUTE_ENCODER); }
static int is_partner(int j, int k)
{
    return k != j && homes.joint[k].in_sequence && abs_sequence(k) == abs_sequence(j) && waits_for_group(k) &&
           homes.joint[k].state != HOME_IDLE;
}

/* Joint j waits at the start of its phase; 1 when it does not have to wait any more. */
static int partners_ready(int j)
{
    enum phase p = phase_of[homes.joint[j].state];
    for (int k = 0; k < homes.joints; k++) {
        const struct home_joint *h = &homes.joint[k];
        if (is_partner(j, k) && phase_of[h->state] <= p && !(phase_of[h->state] == p && h->ready))
            return 0;
    }
    return 1;
}

void homing_release_groups(void)
{
    for (int j = 0; j < homes.joints; j++)
        homes.joint[j].go = waits_for_group(j) && homes.joint[j].ready && partners_ready(j);
}

/* The joint has come to the start of a move: 1 when it may go. */
static int may_start(int j)
{
    struct home_joint *h = &homes.joint[j];
    h->ready = 1;
    return h->go || !waits_for_group(j);
}

/* ---- moves ---- */

static double limited_speed(int j, double vel)
{
    double v = fabs(vel);
    return v < homes.motion[j].vel_limit ? v : homes.motion[j].vel_limit;
}

/* Moves in the direction of vel by at most max (units); 0: over more than the joint's whole range. */
static void start_move(int j, double vel, double max)
{
    emcmot_joint_t *m = &homes.motion[j];
    double way = max > 0.0 ? max : SEARCH_TRAVEL * (m->max_pos_limit - m->min_pos_limit);
    m->free_tp.pos_cmd = m->pos_cmd + (vel > 0.0 ? way : -way);
    m->free_tp.max_vel = limited_speed(j, vel);
    m->free_tp.enable = 1;
    m->free_tp.active = 1; /* looked at before the planner runs */
    homes.joint[j].partner_tripped = 0;
}

static void move_to_search(int j) { start_move(j, homes.joint[j].search_vel, hal_get_real(homes.pins[j].search_max)); }
static void move_back(int j) { start_move(j, -homes.joint[j].search_vel, hal_get_real(homes.pins[j].backoff_max)); }
static void move_to_latch(int j) { start_move(j, homes.joint[j].latch_vel, hal_get_real(homes.pins[j].latch_max)); }
static void stop_move(int j) { homes.motion[j].free_tp.enable = 0; }

/* The switch of j came: partners in the same phase may go on by home-rack-max only. */
static void limit_rack(int j)
{
    for (int k = 0; k < homes.joints; k++) {
        emcmot_joint_t *m = &homes.motion[k];
        double max = hal_get_real(homes.pins[k].rack_max), way = m->free_tp.pos_cmd - m->pos_cmd;
        if (max > 0.0 && is_partner(j, k) && m->free_tp.enable && homes.joint[k].state == homes.joint[j].state &&
            fabs(way) > max) {
            m->free_tp.pos_cmd = m->pos_cmd + copysign(max, way);
            homes.joint[k].partner_tripped = 1;
        }
    }
}

static void stop_at_switch(int j)
{
    if (waits_for_group(j))
        limit_rack(j);
    stop_move(j);
}

/* 1 while the motor moves: the joint, or its backlash that is still taken up. */
static int motor_moves(int j)
{
    const emcmot_joint_t *m = &homes.motion[j];
    return m->free_tp.active || m->backlash_filt != m->backlash_corr;
}

static int delay_cycles(void) { return (int)ceil(HOME_DELAY_S / homes.period); }

/* Waits until the joint rests and then HOME_DELAY_S. 1 when over. */
static int delay_over(int j)
{
    struct home_joint *h = &homes.joint[j];
    if (h->ready)
        return 1;
    if (motor_moves(j) || h->delay < 0) {
        h->delay = delay_cycles();
        if (motor_moves(j))
            return 0;
    }
    if (h->delay > 0) {
        h->delay--;
        return 0;
    }
    h->delay = -1;
    return 1;
}

/* A limit switch that ends homing wherever the joint is. */
static int limit_trips(int j)
{
    const emcmot_joint_t *m = &homes.motion[j];
    return (m->on_pos_limit || m->on_neg_limit) && !has(j, HOME_IGNORE_LIMITS);
}

/* Rests before a move: EV_NEXT when over. The partners of a joint may move meanwhile, so that its
 * limit switch counts at once. */
static enum event rest(int j)
{
    if (waits_for_group(j) && limit_trips(j))
        return EV_LIMIT;
    return delay_over(j) ? EV_NEXT : EV_NONE;
}

/* A limit switch that forbids a move in the direction of vel. With HOME_IGNORE_LIMITS only the
 * end the joint stands at, if that is known: both switches may be wired together. */
static int is_blocked(int j, double vel)
{
    const emcmot_joint_t *m = &homes.motion[j];
    if (!has(j, HOME_IGNORE_LIMITS))
        return limit_trips(j);
    return (m->on_pos_limit && !m->on_neg_limit && vel > 0.0) || (m->on_neg_limit && !m->on_pos_limit && vel < 0.0);
}

/* Limits are ignored and both are on: one switch stands for both ends, and nothing tells which one this is. */
static int end_unknown(int j)
{
    return has(j, HOME_IGNORE_LIMITS) && homes.motion[j].on_pos_limit && homes.motion[j].on_neg_limit;
}

/* What ends a search without success. */
static enum event search_over(int j)
{
    if (limit_trips(j))
        return EV_LIMIT;
    return homes.motion[j].free_tp.active ? EV_NONE : EV_END;
}

/* Shifts the joint's coordinate by offset; the motor does not move. */
static void shift_position(int j, double offset)
{
    emcmot_joint_t *m = &homes.motion[j];
    m->pos_cmd += offset;
    m->coarse_pos += offset;
    m->pos_fb += offset;
    m->free_tp.curr_pos += offset;
    if (!m->free_tp.enable)
        m->free_tp.pos_cmd += offset;
    m->motor_offset -= offset;
}

void homing_request_index(int j, int on)
{
    struct home_joint *h = &homes.joint[j];
    if (h->index_request == on)
        return;
    h->index_request = h->index_read = on;
    h->index_written = 1;
}

/* ---- looks: inputs to events ---- */

static enum event look_next(int j)
{
    (void)j;
    return EV_NEXT;
}

static enum event look_start(int j)
{
    const struct home_joint *h = &homes.joint[j];
    if (has(j, HOME_ABSOLUTE_ENCODER)) /* needs no switch */
        return has(j, HOME_NO_REHOME) && h->homed ? EV_KEEP : EV_ABSOLUTE;
    if (has(j, HOME_IS_SHARED) && h->switch_read) /* may bounce: the joint before has just left it */
        return delay_over(j) ? EV_WRONG : EV_NONE;
    if (has(j, HOME_NO_REHOME) && h->homed)
        return EV_KEEP;
    return has(j, HOME_UNLOCK_FIRST) ? EV_LOCKED : EV_NEXT;
}

static enum event look_coarse(int j)
{
    const struct home_joint *h = &homes.joint[j];
    return h->search_vel * h->latch_vel > 0.0 ? EV_BACKOFF : EV_NEXT;
}

static enum event look_unlocked(int j)
{
    const struct home_joint *h = &homes.joint[j];
    if (has(j, HOME_UNLOCK_FIRST) && !homes.is_unlocked(j))
        return EV_NONE;
    if (h->search_vel != 0.0)
        return h->latch_vel != 0.0 ? EV_SEARCH : EV_NO_LATCH;
    if (h->latch_vel == 0.0)
        return EV_IMMEDIATE;
    return has(j, HOME_USE_INDEX) ? EV_INDEX : EV_NO_SOURCE;
}

static enum event look_initial_backoff(int j)
{
    enum event e = rest(j);
    if (e != EV_NEXT)
        return e;
    if (is_blocked(j, -homes.joint[j].search_vel) || end_unknown(j))
        return EV_LIMIT;
    return may_start(j) ? EV_NEXT : EV_NONE;
}

static enum event look_search(int j)
{
    enum event e = rest(j);
    if (e != EV_NEXT)
        return e;
    if (homes.joint[j].switch_read)
        return EV_BACKOFF;
    if (is_blocked(j, homes.joint[j].search_vel) || end_unknown(j))
        return EV_LIMIT;
    return may_start(j) ? EV_NEXT : EV_NONE;
}

/* Rested before a move that begins with the switch closed (or open). */
static enum event look_begin(int j, int closed, double vel)
{
    enum event e = rest(j);
    if (e != EV_NEXT)
        return e;
    if (!homes.joint[j].switch_read != !closed)
        return EV_WRONG;
    if (is_blocked(j, vel))
        return EV_LIMIT;
    return may_start(j) ? EV_NEXT : EV_NONE;
}

static enum event look_final_backoff(int j) { return look_begin(j, 1, -homes.joint[j].search_vel); }
static enum event look_rise_search(int j) { return look_begin(j, 0, homes.joint[j].latch_vel); }
static enum event look_fall_search(int j) { return look_begin(j, 1, homes.joint[j].latch_vel); }

static enum event look_closed(int j) { return homes.joint[j].switch_read ? EV_SWITCH : search_over(j); }
static enum event look_open(int j) { return homes.joint[j].switch_read ? search_over(j) : EV_SWITCH; }

static enum event look_latch_closed(int j)
{
    enum event e = look_closed(j);
    return e == EV_SWITCH && has(j, HOME_USE_INDEX) ? EV_INDEX : e;
}

static enum event look_latch_open(int j)
{
    enum event e = look_open(j);
    return e == EV_SWITCH && has(j, HOME_USE_INDEX) ? EV_INDEX : e;
}

static enum event look_index_only(int j)
{
    enum event e = rest(j);
    if (e != EV_NEXT)
        return e;
    if (is_blocked(j, homes.joint[j].latch_vel) || end_unknown(j))
        return EV_LIMIT;
    return may_start(j) ? EV_NEXT : EV_NONE;
}

static enum event look_index_start(int j)
{
    enum event e = search_over(j);
    return e == EV_NONE ? EV_NEXT : e;
}

static enum event look_index(int j)
{
    const emcmot_joint_t *m = &homes.motion[j];
    if (!homes.joint[j].index_read)
        return EV_INDEX;
    homes.joint[j].lag = m->pos_cmd - m->pos_fb;
    return search_over(j);
}

static enum event look_switch_position(int j)
{
    return has(j, HOME_ABSOLUTE_ENCODER) && has(j, HOME_NO_FINAL_MOVE) ? EV_KEEP : EV_NEXT;
}

static enum event look_final_start(int j)
{
    if (waits_for_group(j) && limit_trips(j))
        return EV_LIMIT;
    if (homes.motion[j].free_tp.active)
        return EV_NONE;
    return may_start(j) ? EV_NEXT : EV_NONE;
}

static enum event look_final(int j)
{
    struct home_joint *h = &homes.joint[j];
    const emcmot_joint_t *m = &homes.motion[j];
    h->limit_off = m->on_pos_limit || m->on_neg_limit ? 0 : h->limit_off + 1;
    if (!motor_moves(j))
        return EV_NEXT;
    return limit_trips(j) ? EV_LIMIT : EV_NONE;
}

/* Partners that have come to rest are homed in the same cycle, or none of them. An ignored limit
 * switch that was left a moment ago may bounce: as soon as the joint is homed it would be a fault. */
static enum event look_lock(int j)
{
    if (has(j, HOME_IGNORE_LIMITS) && homes.joint[j].limit_off < delay_cycles() && !delay_over(j))
        return EV_NONE;
    if (!may_start(j))
        return limit_trips(j) ? EV_LIMIT : EV_NONE;
    return has(j, HOME_UNLOCK_FIRST) ? EV_LOCKED : EV_NEXT;
}

static enum event look_locked(int j) { return has(j, HOME_UNLOCK_FIRST) && homes.is_unlocked(j) ? EV_NONE : EV_NEXT; }

static enum event (*const looks[HOME_ABORT + 1])(int j) = {
    [HOME_START] = look_start,
    [HOME_UNLOCK] = look_next,
    [HOME_UNLOCK_WAIT] = look_unlocked,
    [HOME_INITIAL_BACKOFF_START] = look_initial_backoff,
    [HOME_INITIAL_BACKOFF_WAIT] = look_open,
    [HOME_INITIAL_SEARCH_START] = look_search,
    [HOME_INITIAL_SEARCH_WAIT] = look_closed,
    [HOME_SET_COARSE_POSITION] = look_coarse,
    [HOME_FINAL_BACKOFF_START] = look_final_backoff,
    [HOME_FINAL_BACKOFF_WAIT] = look_open,
    [HOME_RISE_SEARCH_START] = look_rise_search,
    [HOME_RISE_SEARCH_WAIT] = look_latch_closed,
    [HOME_FALL_SEARCH_START] = look_fall_search,
    [HOME_FALL_SEARCH_WAIT] = look_latch_open,
    [HOME_SET_SWITCH_POSITION] = look_switch_position,
    [HOME_INDEX_ONLY_START] = look_index_only,
    [HOME_INDEX_SEARCH_START] = look_index_start,
    [HOME_INDEX_SEARCH_WAIT] = look_index,
    [HOME_SET_INDEX_POSITION] = look_next,
    [HOME_FINAL_MOVE_START] = look_final_start,
    [HOME_FINAL_MOVE_WAIT] = look_final,
    [HOME_LOCK] = look_lock,
    [HOME_LOCK_WAIT] = look_locked,
    [HOME_FINISHED] = look_next,
    [HOME_ABORT] = look_next,
};

/* ---- actions ---- */

static void begin(int j)
{
    struct home_joint *h = &homes.joint[j];
    h->homing = 1;
    h->homed = 0;
    h->delay = -1;
    h->ready = 0;
    stop_move(j);
}

static void leave_sequence(int j) { homes.joint[j].in_sequence = 0; }
static void unlock(int j) { homes.set_unlock(j, 1); }
static void lock(int j) { homes.set_unlock(j, 0); }

/* Where the slide is: it moves with all of the backlash behind it, also while the command still takes it up. */
static double slide_position(int j)
{
    const emcmot_joint_t *m = &homes.motion[j];
    return m->pos_fb + m->backlash_filt - m->backlash_corr;
}

/* Position of the switch, or where the joint is when it is homed at once. */
static void set_position(int j) { shift_position(j, homes.joint[j].offset - slide_position(j)); }

static void set_switch_position(int j)
{
    if (!has(j, HOME_ABSOLUTE_ENCODER)) {
        set_position(j);
        return;
    }
    /* joint position = motor position + HOME_OFFSET, however often it is homed */
    shift_position(j, homes.motion[j].motor_offset);
    shift_position(j, homes.joint[j].offset);
}

static void arm_index(int j) { homing_request_index(j, 1); }

static void search_index(int j)
{
    set_position(j);
    homing_request_index(j, 1);
    move_to_latch(j);
}

static void index_seen(int j)
{
    homes.joint[j].index_request = 0; /* answered: nothing to write */
    stop_at_switch(j);
}

/* The encoder counts from the index, or the index is where it is now. The command keeps its
 * distance from the feedback, so that the motor sees no step. */
static void set_index_position(int j)
{
    const struct home_joint *h = &homes.joint[j];
    emcmot_joint_t *m = &homes.motion[j];
    double before = m->pos_cmd;
    if (has(j, HOME_INDEX_NO_ENCODER_RESET)) {
        m->pos_fb = m->motor_pos_fb - (m->backlash_filt + m->motor_offset);
        set_position(j);
        return;
    }
    m->motor_offset = -h->offset;
    m->pos_fb = m->motor_pos_fb - (m->backlash_filt + m->motor_offset);
    m->pos_cmd = m->coarse_pos = m->pos_fb + h->lag;
    m->free_tp.curr_pos += m->pos_cmd - before;
    m->free_tp.pos_cmd = m->free_tp.curr_pos;
}

static void move_home(int j)
{
    struct home_joint *h = &homes.joint[j];
    emcmot_joint_t *m = &homes.motion[j];
    h->limit_off = 0;
    m->free_tp.pos_cmd = h->home;
    m->free_tp.max_vel = h->final_vel > 0.0 ? limited_speed(j, h->final_vel) : m->vel_limit;
    m->free_tp.enable = 1;
    m->free_tp.active = 1;
}

static void finish(int j)
{
    struct home_joint *h = &homes.joint[j];
    h->homing = 0;
    h->homed = 1;
    h->in_sequence = 0;
}

static void end_all(int j)
{
    (void)j;
    homing_abort_all();
}

/* Errors. One before a move names the state in which the joint would have moved; a request for the
 * index ends with its move. */
static int state_of_move(home_state_t state)
{
    switch (state) {
    case HOME_INITIAL_BACKOFF_START:
    case HOME_INITIAL_SEARCH_START:
    case HOME_FINAL_BACKOFF_START:
    case HOME_RISE_SEARCH_START:
    case HOME_FALL_SEARCH_START:
        return state + 1;
    case HOME_INDEX_ONLY_START:
        return HOME_INDEX_SEARCH_WAIT;
    default:
        return state;
    }
}

static void error_limit(int j)
{
    home_state_t state = homes.joint[j].state;
    homing_request_index(j, 0);
    if (state >= HOME_FINAL_MOVE_START)
        homing_error("hit limit in home state j=%d", j, 0);
    else
        homing_error("j%d hit limit in home state %d", j, state_of_move(state));
    if (end_unknown(j))
        homing_error("joint %d stands on a limit switch of either end: choose the direction, jog it off first", j, 0);
    else if (has(j, HOME_IGNORE_LIMITS))
        homing_error("joint %d would move farther onto the limit switch it stands on: jog it off first", j, 0);
}

static void error_end(int j)
{
    int state = homes.joint[j].state, open = state == HOME_INITIAL_BACKOFF_WAIT || state == HOME_FINAL_BACKOFF_WAIT ||
                                         state == HOME_FALL_SEARCH_WAIT;
    homing_request_index(j, 0);
    homing_error("j%d end of move in home state %d", j, state);
    if (homes.joint[j].partner_tripped)
        homing_error("joint.%d.home-sw-in is later than its partner's by more than joint.%d.home-rack-max", j, j);
    else if (state == HOME_INDEX_SEARCH_START || state == HOME_INDEX_SEARCH_WAIT)
        homing_error("joint.%d.index-enable stayed TRUE over the whole move: no index came", j, 0);
    else if (open)
        homing_error("joint.%d.home-sw-in stayed TRUE over the whole move: switch or its wiring", j, 0);
    else
        homing_error("joint.%d.home-sw-in stayed FALSE over the whole move: switch, its wiring or the direction", j, 0);
}

static void error_shared(int j) { homing_error("Cannot home while shared home switch is closed j=%d", j, 0); }
static void error_backoff(int j) { homing_error("Home switch inactive before start of backoff move j=%d", j, 0); }
static void error_rise(int j) { homing_error("Home switch active before start of latch move j=%d", j, 0); }
static void error_fall(int j) { homing_error("Home switch inactive before start of latch move j=%d", j, 0); }
static void error_no_source(int j)
{
    (void)j;
    homing_error("invalid homing config: non-zero LATCH_VEL needs either SEARCH_VEL or USE_INDEX", 0, 0);
}
static void error_no_latch(int j)
{
    (void)j;
    homing_error("invalid homing config: non-zero SEARCH_VEL needs LATCH_VEL", 0, 0);
}

/* ---- edges ---- */

#define LATER 0
#define NOW 1 /* the next state looks in the same cycle */

static const struct edge {
    home_state_t from;
    enum event event;
    home_state_t to;
    int now;
    void (*action)(int j); /* in the old state; null: none */
} edges[] = {
    {HOME_START, EV_WRONG, HOME_ABORT, NOW, error_shared},
    {HOME_START, EV_KEEP, HOME_IDLE, LATER, leave_sequence},
    {HOME_START, EV_ABSOLUTE, HOME_SET_SWITCH_POSITION, NOW, begin},
    {HOME_START, EV_LOCKED, HOME_UNLOCK, LATER, begin},
    {HOME_START, EV_NEXT, HOME_UNLOCK_WAIT, NOW, begin},

    {HOME_UNLOCK, EV_NEXT, HOME_UNLOCK_WAIT, LATER, unlock},
    {HOME_UNLOCK_WAIT, EV_IMMEDIATE, HOME_SET_SWITCH_POSITION, NOW, NULL},
    {HOME_UNLOCK_WAIT, EV_INDEX, HOME_INDEX_ONLY_START, NOW, NULL},
    {HOME_UNLOCK_WAIT, EV_SEARCH, HOME_INITIAL_SEARCH_START, NOW, NULL},
    {HOME_UNLOCK_WAIT, EV_NO_SOURCE, HOME_ABORT, LATER, error_no_source},
    {HOME_UNLOCK_WAIT, EV_NO_LATCH, HOME_ABORT, LATER, error_no_latch},

    {HOME_INITIAL_BACKOFF_START, EV_NEXT, HOME_INITIAL_BACKOFF_WAIT, LATER, move_back},
    {HOME_INITIAL_BACKOFF_START, EV_LIMIT, HOME_ABORT, LATER, error_limit},
    {HOME_INITIAL_BACKOFF_WAIT, EV_SWITCH, HOME_INITIAL_SEARCH_START, NOW, stop_move},
    {HOME_INITIAL_BACKOFF_WAIT, EV_LIMIT, HOME_ABORT, LATER, error_limit},
    {HOME_INITIAL_BACKOFF_WAIT, EV_END, HOME_ABORT, LATER, error_end},

    {HOME_INITIAL_SEARCH_START, EV_BACKOFF, HOME_INITIAL_BACKOFF_START, NOW, NULL},
    {HOME_INITIAL_SEARCH_START, EV_NEXT, HOME_INITIAL_SEARCH_WAIT, LATER, move_to_search},
    {HOME_INITIAL_SEARCH_START, EV_LIMIT, HOME_ABORT, LATER, error_limit},
    {HOME_INITIAL_SEARCH_WAIT, EV_SWITCH, HOME_SET_COARSE_POSITION, NOW, stop_at_switch},
    {HOME_INITIAL_SEARCH_WAIT, EV_LIMIT, HOME_ABORT, LATER, error_limit},
    {HOME_INITIAL_SEARCH_WAIT, EV_END, HOME_ABORT, LATER, error_end},
    {HOME_SET_COARSE_POSITION, EV_BACKOFF, HOME_FINAL_BACKOFF_START, NOW, set_position},
    {HOME_SET_COARSE_POSITION, EV_NEXT, HOME_FALL_SEARCH_START, NOW, set_position},

    {HOME_FINAL_BACKOFF_START, EV_WRONG, HOME_ABORT, NOW, error_backoff},
    {HOME_FINAL_BACKOFF_START, EV_LIMIT, HOME_ABORT, LATER, error_limit},
    {HOME_FINAL_BACKOFF_START, EV_NEXT, HOME_FINAL_BACKOFF_WAIT, LATER, move_back},
    {HOME_FINAL_BACKOFF_WAIT, EV_SWITCH, HOME_RISE_SEARCH_START, NOW, stop_at_switch},
    {HOME_FINAL_BACKOFF_WAIT, EV_LIMIT, HOME_ABORT, LATER, error_limit},
    {HOME_FINAL_BACKOFF_WAIT, EV_END, HOME_ABORT, LATER, error_end},

    {HOME_RISE_SEARCH_START, EV_WRONG, HOME_ABORT, NOW, error_rise},
    {HOME_RISE_SEARCH_START, EV_LIMIT, HOME_ABORT, LATER, error_limit},
    {HOME_RISE_SEARCH_START, EV_NEXT, HOME_RISE_SEARCH_WAIT, LATER, move_to_latch},
    {HOME_RISE_SEARCH_WAIT, EV_SWITCH, HOME_SET_SWITCH_POSITION, NOW, stop_at_switch},
    {HOME_RISE_SEARCH_WAIT, EV_INDEX, HOME_INDEX_SEARCH_START, NOW, NULL},
    {HOME_RISE_SEARCH_WAIT, EV_LIMIT, HOME_ABORT, LATER, error_limit},
    {HOME_RISE_SEARCH_WAIT, EV_END, HOME_ABORT, LATER, error_end},

    {HOME_FALL_SEARCH_START, EV_WRONG, HOME_ABORT, NOW, error_fall},
    {HOME_FALL_SEARCH_START, EV_LIMIT, HOME_ABORT, LATER, error_limit},
    {HOME_FALL_SEARCH_START, EV_NEXT, HOME_FALL_SEARCH_WAIT, LATER, move_to_latch},
    {HOME_FALL_SEARCH_WAIT, EV_SWITCH, HOME_SET_SWITCH_POSITION, NOW, stop_at_switch},
    {HOME_FALL_SEARCH_WAIT, EV_INDEX, HOME_INDEX_SEARCH_START, NOW, NULL},
    {HOME_FALL_SEARCH_WAIT, EV_LIMIT, HOME_ABORT, LATER, error_limit},
    {HOME_FALL_SEARCH_WAIT, EV_END, HOME_ABORT, LATER, error_end},

    {HOME_SET_SWITCH_POSITION, EV_KEEP, HOME_FINISHED, NOW, set_switch_position},
    {HOME_SET_SWITCH_POSITION, EV_NEXT, HOME_FINAL_MOVE_START, NOW, set_switch_position},

    {HOME_INDEX_ONLY_START, EV_NEXT, HOME_INDEX_SEARCH_WAIT, LATER, search_index},
    {HOME_INDEX_ONLY_START, EV_LIMIT, HOME_ABORT, LATER, error_limit},
    {HOME_INDEX_SEARCH_START, EV_NEXT, HOME_INDEX_SEARCH_WAIT, NOW, arm_index},
    {HOME_INDEX_SEARCH_START, EV_LIMIT, HOME_ABORT, LATER, error_limit},
    {HOME_INDEX_SEARCH_START, EV_END, HOME_ABORT, LATER, error_end},
    {HOME_INDEX_SEARCH_WAIT, EV_INDEX, HOME_SET_INDEX_POSITION, NOW, index_seen},
    {HOME_INDEX_SEARCH_WAIT, EV_LIMIT, HOME_ABORT, LATER, error_limit},
    {HOME_INDEX_SEARCH_WAIT, EV_END, HOME_ABORT, LATER, error_end},
    {HOME_SET_INDEX_POSITION, EV_NEXT, HOME_FINAL_MOVE_START, NOW, set_index_position},

    {HOME_FINAL_MOVE_START, EV_NEXT, HOME_FINAL_MOVE_WAIT, LATER, move_home},
    {HOME_FINAL_MOVE_START, EV_LIMIT, HOME_ABORT, NOW, error_limit},
    {HOME_FINAL_MOVE_WAIT, EV_NEXT, HOME_LOCK, NOW, stop_move},
    {HOME_FINAL_MOVE_WAIT, EV_LIMIT, HOME_ABORT, NOW, error_limit},

    {HOME_LOCK, EV_NEXT, HOME_LOCK_WAIT, NOW, NULL},
    {HOME_LOCK, EV_LOCKED, HOME_LOCK_WAIT, LATER, lock},
    {HOME_LOCK, EV_LIMIT, HOME_ABORT, NOW, error_limit},
    {HOME_LOCK_WAIT, EV_NEXT, HOME_FINISHED, NOW, NULL},
    {HOME_FINISHED, EV_NEXT, HOME_IDLE, LATER, finish},
    {HOME_ABORT, EV_NEXT, HOME_IDLE, LATER, end_all},
};

#define EDGES ((int)(sizeof(edges) / sizeof(edges[0])))

static const struct edge *find_edge(home_state_t from, enum event event)
{
    for (int i = 0; i < EDGES; i++)
        if (edges[i].from == from && edges[i].event == event)
            return &edges[i];
    return NULL;
}

void homing_run_joint(int j)
{
    struct home_joint *h = &homes.joint[j];
    for (int n = 0; n < MAX_EDGES; n++) {
        enum event event;
        const struct edge *edge;
        if ((unsigned)h->state > HOME_ABORT) {
            homing_error("unknown state '%d' during homing j=%d", h->state, j);
            h->state = HOME_ABORT;
        }
        if (h->state == HOME_IDLE || (event = looks[h->state](j)) == EV_NONE)
            return;
        edge = find_edge(h->state, event);
        if (!edge) { /* a fault of this file: stop rather than stand */
            homing_error("unknown state '%d' during homing j=%d", h->state, j);
            homing_abort_all();
            return;
        }
        if (edge->action)
            edge->action(j);
        h->ready = 0;
        h->state = edge->to;
        if (!edge->now)
            return;
    }
}

void homing_abort_all(void)
{
    for (int j = 0; j < homes.joints; j++) {
        struct home_joint *h = &homes.joint[j];
        if (h->homing || h->state != HOME_IDLE || h->in_sequence) {
            if (h->homing || (h->state != HOME_IDLE && h->state != HOME_START))
                h->homed = 0;
            stop_move(j);
        }
        h->homing = h->homing_shown = 0;
        h->in_sequence = 0;
        h->ready = 0;
        h->delay = -1;
        h->state = HOME_IDLE;
        homing_request_index(j, 0);
        if (has(j, HOME_UNLOCK_FIRST) && homes.set_unlock)
            homes.set_unlock(j, 0);
    }
    homes.sequence_state = HOME_SEQUENCE_IDLE;
    homes.active = 0;
}

int homing_invariants_hold(void)
{
    for (int j = 0; j < homes.joints; j++) {
        const struct home_joint *h = &homes.joint[j];
        if ((h->index_request && h->state != HOME_INDEX_SEARCH_START && h->state != HOME_INDEX_SEARCH_WAIT) ||
            (h->homed && h->homing) || (h->homing && !h->in_sequence) || (!homes.active && h->state != HOME_IDLE))
            return 0;
    }
    return 1;
}

