// SPDX-License-Identifier: GPL-2.0-or-later
component carousel "Tool carousel: turns to a pocket and finds its position";
modparam dummy pockets "Number of pockets of each carousel; as many instances as numbers (default one of 8).";
modparam dummy encoding "How the position is sensed: gray, binary, bcd, single, index, edge or counts.";
modparam dummy num_sense "Number of sense pins (default 4).";
modparam dummy dir "1: turns forward only; 2: both ways (default).";
modparam dummy parity "Parity of the code: 0 even, 1 odd.";
pin in signed pocket_number "Pocket wanted, from 1.";
pin in bit enable "TRUE: go to the pocket; FALSE: ready for the next.";
pin out bit active "TRUE while turning.";
pin out bit ready "TRUE when the pocket is reached.";
pin in bit strobe = TRUE "The code is valid.";
pin in bit parity_ "Parity bit of the code.";
pin in bit sense-#[32 : personality] "Position sensors.";
pin in float rev_pulse "Seconds of reverse motion at the pocket, against a stop.";
pin in float fwd_dc "Velocity or duty cycle forward.";
pin in float rev_dc "Velocity or duty cycle backward.";
pin in float hold_dc "Duty cycle while standing.";
pin in float align_dc "Duty cycle of the alignment move.";
pin in float decel_time "Seconds to slow down before the alignment.";
pin in signed counts "Position from an encoder, with *encoding* counts.";
pin in signed scale = 100 "Counts per pocket.";
pin in signed width = 10 "Counts at a pocket that are the pocket.";
pin in signed home_offset "Counts from the index to pocket 1.";
pin io bit index_enable "To the encoder's index-enable.";
pin in bit jog_fwd "One pocket forward.";
pin in bit jog_rev "One pocket backward.";
pin out bit motor_fwd "Turn forward.";
pin out bit motor_rev "Turn backward.";
pin out bit parity_error "Code and parity do not agree.";
pin out signed current_position "Present pocket.";
pin out float motor_vel "Duty cycle or velocity of the motor.";
pin out bit homed = 0 "The position is known.";
pin in bit unhome = 0 "Rising: forget the position.";
pin out float counts_target "Target for a position controller, in counts.";
param r signed state "State of the sequence.";
param r bit homing "Looking for the home position.";
param r float timer "Seconds left of a timed step.";
param r signed motor_dir "Direction of motion: 1, -1 or 0.";
param r signed counts_offset "Not used.";
param r signed target "Target of a jog.";
param r signed base_counts "Counts at pocket 1.";
param rw unsigned debounce "Cycles that the position must be right.";
variable int kind;
variable int both_ways;
variable int number_of_pockets;
variable int odd;
variable int align;
variable int old_index;
variable int old_unhome;
variable int settle;
variable int told;
function _ "Runs the sequence.";
option count_function;
option extra_setup;
option post_export;
description """
The *encoding* of an instance is known by its first letters:

* gray (default), binary, bcd: the sense pins are the number of the pocket; *strobe* says when they are valid
* single: one sensor per pocket
* index: sense-0 is at pocket 1, sense-1 at each pocket
* edge: as index, but both edges of sense-1 count
* counts: an encoder gives the position, sense-0 (or the encoder's index) pocket 1

With index, edge and counts the carousel must find pocket 1 first, which the first request does.
""";
examples """
----
loadrt carousel pockets=10,8 encoding=gray,index num_sense=4,2 dir=2,1
----
""";
license "GPL";
author "Kerf developers";
include <rtapi_math.h>;
include <rtapi_ctype.h>;
;;
#define MAX_CAROUSELS 8
static int pockets[MAX_CAROUSELS];
RTAPI_MP_ARRAY_INT(pockets, MAX_CAROUSELS, "number of pockets of each carousel");
static char *encoding[MAX_CAROUSELS];
RTAPI_MP_ARRAY_STRING(encoding, MAX_CAROUSELS, "position encoding of each carousel");
static int num_sense[MAX_CAROUSELS];
RTAPI_MP_ARRAY_INT(num_sense, MAX_CAROUSELS, "number of sense pins of each carousel");
static int dir[MAX_CAROUSELS];
RTAPI_MP_ARRAY_INT(dir, MAX_CAROUSELS, "directions of each carousel");
static int parity[MAX_CAROUSELS];
RTAPI_MP_ARRAY_INT(parity, MAX_CAROUSELS, "parity of each carousel");

enum { GRAY, BINARY, BCD, SINGLE, INDEX, EDGE, COUNTS };
enum {
    WAITING = 0, CHOOSING = 1, MOVING = 2, PULSING = 3, SLOWING = 5, BACK_ON = 6, BACK_OFF = 7, ALIGNING = 8,
    DONE = 9, HOME_START = 10, HOMING = 11, JOGGING = 20
};

/* The value of a load parameter for instance n: missing ones repeat the one before. */
static int repeated(const int *values, int n, int fallback) {
    for(; n >= 0; n--) if(values[n]) return values[n];
    return fallback;
}

static int kind_of(long n) {
    static const struct {
        const char *letters;
        int code;
    } kinds[] = { { "gr", GRAY }, { "bi", BINARY }, { "bc", BCD }, { "si", SINGLE }, { "in", INDEX },
                  { "ed", EDGE }, { "co", COUNTS } };
    unsigned i;
    for(; n >= 0; n--) {
        if(!encoding[n] || !encoding[n][0]) continue;
        for(i = 0; i < sizeof kinds / sizeof kinds[0]; i++)
            if(tolower((unsigned char)encoding[n][0]) == kinds[i].letters[0]
               && (encoding[n][0] != 'b' || !encoding[n][1] || encoding[n][1] == kinds[i].letters[1]))
                return kinds[i].code;
        return GRAY;
    }
    return GRAY;
}

int get_count(void) {
    int n = 0;
    if(pockets[0] == 0) pockets[0] = 8;
    while(n < MAX_CAROUSELS && pockets[n]) n++;
    return n;
}

EXTRA_SETUP() {
    kind = kind_of(extra_arg);
    personality = repeated(num_sense, (int)extra_arg, 4);
    if(kind == INDEX) personality = 2;
    if(kind == SINGLE && personality < pockets[extra_arg]) personality = pockets[extra_arg];
    return 0;
}

POST_EXPORT() {
    kind = kind_of(extra_arg);
    number_of_pockets = pockets[extra_arg];
    both_ways = repeated(dir, (int)extra_arg, 2) > 1;
    odd = parity[extra_arg] != 0;
    return 0;
}

static int sensed(struct __comp_state *__comp_inst, int n) {
    return n < personality ? sense(n) != 0 : 0;
}

static rtapi_u32 sense_bits(struct __comp_state *__comp_inst) {
    rtapi_u32 bits = 0;
    int i;
    for(i = 0; i < personality; i++) bits |= (rtapi_u32)sensed(__comp_inst, i) << i;
    return bits;
}

static rtapi_u32 gray_decode(rtapi_u32 code) {
    int shift;
    for(shift = 16; shift; shift /= 2) code ^= code >> shift;
    return code;
}

/* One pocket on or back, in the direction of the motor. */
static int next_pocket(struct __comp_state *__comp_inst) {
    int at = current_position;
    if(motor_fwd && ++at > number_of_pockets) at = 1;
    if(motor_rev && --at < 1) at = number_of_pockets;
    return at;
}

static int single_position(struct __comp_state *__comp_inst) {
    int i, at = 0;
    for(i = 0; i < personality; i++) if(sensed(__comp_inst, i)) at = i + 1;
    align = current_position >= 1 && sensed(__comp_inst, current_position - 1);
    return at;
}

static int counted_position(struct __comp_state *__comp_inst) {
    rtapi_s32 at = (rtapi_s32)((rtapi_u32)counts - (rtapi_u32)base_counts), half = width / 2, turns, place;
    int pocket = current_position;
    if(scale == 0) return pocket;
    turns = (rtapi_s32)floorf((float)(at + half) / scale);
    place = turns * scale;
    if(at >= place - half && at <= place + half) {
        pocket = 1 + turns % number_of_pockets;
        if(pocket < 1) pocket += number_of_pockets;
    }
    align = abs(at % scale) <= 2;
    return pocket;
}

/* The pocket that the sensors show; sets align, and *odd_bits for codes with parity. */
static int read_position(struct __comp_state *__comp_inst, int *odd_bits) {
    rtapi_u32 bits;
    int at = current_position, i, now;
    switch(kind) {
    case SINGLE:
        return single_position(__comp_inst);
    case INDEX:
        now = sensed(__comp_inst, 1);
        align = now;
        if(homed && (state == MOVING || state == JOGGING)) {
            if(now && !old_index) at = next_pocket(__comp_inst);
            old_index = now;
        }
        return at;
    case EDGE:
        now = sensed(__comp_inst, 1);
        align = 1;
        if(homed && now != old_index) at = next_pocket(__comp_inst);
        old_index = now;
        return at;
    case COUNTS:
        return homed ? counted_position(__comp_inst) : at;
    default:
        bits = sense_bits(__comp_inst);
        *odd_bits = __builtin_parity(bits);
        align = strobe != 0;
        if(kind == BCD) {
            for(i = personality & ~3, at = 0; i >= 0; i -= 4) at = at * 10 + (int)(bits >> i & 15);
            return at;
        }
        if(kind == BINARY) return (int)bits;
        at = (int)gray_decode(bits);
        return at ? at : number_of_pockets;
    }
}

static void stop(struct __comp_state *__comp_inst) {
    motor_fwd = 0;
    motor_rev = 0;
    motor_vel = hold_dc;
    active = 0;
}

static void turn(struct __comp_state *__comp_inst, int forward) {
    motor_fwd = forward;
    motor_rev = !forward;
    motor_vel = forward ? fwd_dc : rev_dc;
    motor_dir = forward ? 1 : -1;
}

/* Starts the move to a pocket the shorter way. The position may be beyond the
 * last pocket (sensors can show any number). */
static void choose_way(struct __comp_state *__comp_inst, int goal) {
    int way = goal - current_position, pocket_count = number_of_pockets;
    if(both_ways) {
        int forward = way > 0;
        if(abs(way) > pocket_count / 2) {
            way += forward ? -pocket_count : pocket_count;
            forward = !forward;
        }
        counts_target += (double)way * scale;
        turn(__comp_inst, forward);
    } else {
        counts_target += (double)way * scale;
        if(counts_target < counts) counts_target += (double)scale * pocket_count;
        turn(__comp_inst, 1);
    }
    state = MOVING;
}

/* True until the position has been right for `debounce` cycles. */
static int settling(struct __comp_state *__comp_inst, int at_goal) {
    if(!at_goal) {
        settle = (int)debounce;
        return 1;
    }
    return settle-- > 0;
}

static void arrive(struct __comp_state *__comp_inst, int at_goal) {
    stop(__comp_inst);
    if(at_goal) ready = 1;
    state = DONE;
    told = 0;
}

static void begin_decel(struct __comp_state *__comp_inst) {
    timer = decel_time;
    state = SLOWING;
}

static void home(struct __comp_state *__comp_inst) {
    int now;
    if(state == HOME_START) {
        homed = 0;
        homing = 1;
        turn(__comp_inst, 1);
        index_enable = 1;
        counts_target += (double)scale * number_of_pockets;
        old_index = 1;
        state = HOMING;
    }
    now = kind == COUNTS ? sensed(__comp_inst, 0) : sensed(__comp_inst, 0) && sensed(__comp_inst, 1);
    if(!index_enable || (now && !old_index)) {
        current_position = 1;
        homed = 1;
        homing = 0;
        active = 0;
        motor_fwd = 0;
        motor_rev = 0;
        motor_vel = 0;
        base_counts = counts - home_offset;
        counts_target = base_counts;
        if(align_dc == 0) state = WAITING;
        else begin_decel(__comp_inst);
    }
    old_index = now;
}

static void start(struct __comp_state *__comp_inst, int goal) {
    int must_home = !homed && kind >= INDEX;
    motor_dir = 0;
    if(jog_fwd || (jog_rev && both_ways)) {
        if(must_home) {
            state = HOME_START;
            return;
        }
        target = current_position + jog_fwd - jog_rev;
        counts_target += (double)scale * (target - current_position);
        if(target > number_of_pockets) target = 1;
        if(target < 1) target = number_of_pockets;
        turn(__comp_inst, !(jog_rev && both_ways));
        active = 1;
        state = JOGGING;
        return;
    }
    motor_vel = hold_dc;
    if(!enable) return;
    active = 1;
    if(must_home) {
        state = HOME_START;
        return;
    }
    ready = 0;
    choose_way(__comp_inst, goal);
}

static void jog(struct __comp_state *__comp_inst) {
    if(settling(__comp_inst, current_position == target)) return;
    if(align_dc != 0 && !align) return;
    stop(__comp_inst);
    if(jog_fwd || jog_rev) return;
    if(align_dc != 0) {
        motor_vel = -align_dc;
        begin_decel(__comp_inst);
    } else {
        state = WAITING;
    }
}

static void finish_move(struct __comp_state *__comp_inst, int at_goal) {
    if(settling(__comp_inst, at_goal || !enable)) return;
    if(rev_pulse > 0) {
        motor_fwd = 0;
        motor_rev = 1;
        motor_vel = rev_dc;
        timer = rev_pulse;
        state = PULSING;
    } else if(decel_time > 0) {
        motor_vel = 0;
        begin_decel(__comp_inst);
    } else {
        arrive(__comp_inst, enable && at_goal);
    }
}

FUNCTION(_) {
    int odd_bits = 0, at, goal, at_goal;
    at = read_position(__comp_inst, &odd_bits);
    if(strobe) {
        current_position = at;
        parity_error = odd_bits != (odd ^ (parity_ != 0));
    }
    goal = (int)(((rtapi_s64)pocket_number - 1) % number_of_pockets) + 1;
    if(goal < 1) goal = 1;
    if(unhome && !old_unhome) homed = 0;
    old_unhome = unhome;
    at_goal = current_position == goal;

    switch(state) {
    case WAITING:
        start(__comp_inst, goal);
        if(state == MOVING) finish_move(__comp_inst, at_goal);
        break;
    case CHOOSING:
        choose_way(__comp_inst, goal);
        finish_move(__comp_inst, at_goal);
        break;
    case MOVING:
        finish_move(__comp_inst, at_goal);
        break;
    case PULSING:
        timer -= fperiod;
        if(timer <= 0) arrive(__comp_inst, enable);
        break;
    case SLOWING:
        timer -= fperiod;
        if(timer > 0) break;
        if(align_dc == 0) {
            state = ALIGNING;
        } else {
            motor_vel = -align_dc;
            state = motor_dir == 1 ? BACK_ON : BACK_OFF;
        }
        break;
    case BACK_ON:
        if(align) state = BACK_OFF;
        break;
    case BACK_OFF:
        if(align) break;
        motor_vel = align_dc;
        state = ALIGNING;
        break;
    case ALIGNING:
        if(align) arrive(__comp_inst, enable && at_goal);
        break;
    case DONE:
        if(!ready && !told) {
            told = 1;
            rtapi_print_msg(RTAPI_MSG_ERR, "The toolchanger has failed the final alignment check\n");
        }
        if(!enable) state = WAITING;
        break;
    case HOME_START:
    case HOMING:
        home(__comp_inst);
        break;
    case JOGGING:
        jog(__comp_inst);
        break;
    default:
        state = WAITING;
    }
}
