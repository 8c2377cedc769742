/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * boss_plc.c - the machine logic of a BOSS mill: feed hold, limit switches,
 * amplifier faults, spindle brake and direction, jog scale.
 *
 * Thread: boss_plc.N.refresh [servo], constant cost
 */
#include <rtapi.h>
#include <rtapi_app.h>
#include <hal.h>
#include "components/comp_util.h"

MODULE_LICENSE("GPL");
MODULE_AUTHOR("Kerf developers");
MODULE_DESCRIPTION("Machine logic of a BOSS mill");

#define MAX_INSTANCES 4
#define JOG_SCALES 3

static int count = 1;
RTAPI_MP_INT(count, "number of machines");
static int debug;
RTAPI_MP_INT(debug, "1: parameters that show states");

/* A time in ms; runs while `running`, then stays expired. */
struct timer {
    int running;
    rtapi_s64 left_ns;
};

/* A switch at both ends of an axis: the direction of motion tells which end. */
enum limit_state { LIMIT_INIT, LIMIT_ON, LIMIT_NO_MOTION, LIMIT_POS_MOTION, LIMIT_NEG_MOTION };
struct limit {
    enum limit_state state;
    int at_pos, at_neg;
    double last_position;
    hal_real_t position;
    hal_bool_t jog_enable, in, pos_out, neg_out;
    hal_uint_t shown_state;
};

struct z_limit {
    hal_bool_t jog_enable, pos_in, neg_in, pos_out, neg_out;
};

struct amp {
    struct timer timer;
    int was_enabled;
    hal_bool_t enable, ready, fault;
};

enum spindle_state { SPINDLE_OFF, SPINDLE_BRAKE_OFF, SPINDLE_WAIT_ON, SPINDLE_ON, SPINDLE_WAIT_OFF,
                     SPINDLE_BRAKE_ON };

struct plc {
    int was_start;
    double last_speed;
    hal_bool_t cycle_start, cycle_hold, feed_hold, tool_change, tool_changed, wait_user;
    hal_bool_t mist_in, mist_out, flood_in, flood_out;
    hal_real_t adaptive_in, adaptive_out;

    hal_bool_t override, limit_active;
    struct limit x, y;
    struct z_limit z;

    hal_uint_t amp_ready_delay;
    struct amp amp[4];

    enum spindle_state spindle;
    struct timer brake_timer;
    hal_uint_t brake_on_delay, brake_off_delay, shown_spindle;
    hal_real_t lo_to_hi, speed;
    hal_bool_t is_on, fwd, rev, inc_in, dec_in, inc_out, dec_out, brake_in, brake_out;

    hal_real_t jog_scale[JOG_SCALES], jog_scale_out;
    hal_bool_t jog_select[JOG_SCALES];
};

static int comp_id;

static void timer_start(struct timer *t, hal_uint_t ms)
{
    t->running = 1;
    t->left_ns = (rtapi_s64)hal_get_ui32(ms) * 1000000;
}

/* True once the time is over. */
static int timer_done(struct timer *t, long period)
{
    if(t->running) {
        t->left_ns -= period;
        if(t->left_ns <= 0) t->running = 0;
    }
    return !t->running;
}

static void refresh_feed(struct plc *p)
{
    int now = hal_get_bool(p->cycle_start), start = now && !p->was_start;
    int is_on = hal_get_bool(p->is_on), changing = hal_get_bool(p->tool_change), changed, hold;
    double speed = hal_get_real(p->speed), feed = hal_get_real(p->adaptive_in);
    p->was_start = now;
    hold = hal_get_bool(p->cycle_hold) || (speed != 0 && !is_on) || (is_on && speed != p->last_speed)
        || (hal_get_bool(p->feed_hold) && !start);
    p->last_speed = speed;
    hal_set_bool(p->feed_hold, hold);
    hal_set_real(p->adaptive_out, hal_get_bool(p->override) && feed > 0.01 ? 0.01 : feed);
    changed = changing && (start || hal_get_bool(p->tool_changed));
    hal_set_bool(p->tool_changed, changed);
    hal_set_bool(p->wait_user, hold || (changing && !changed));
    hal_set_bool(p->mist_out, hal_get_bool(p->mist_in) && !changing);
    hal_set_bool(p->flood_out, hal_get_bool(p->flood_in) && !changing);
}

static void refresh_limit(struct limit *l, int override)
{
    int in = hal_get_bool(l->in), allowed = hal_get_bool(l->jog_enable) && override;
    double position = hal_get_real(l->position);
    enum limit_state motion = position > l->last_position ? LIMIT_POS_MOTION
        : position < l->last_position ? LIMIT_NEG_MOTION : LIMIT_NO_MOTION;
    l->last_position = position;
    switch(l->state) {
    case LIMIT_INIT:
        l->at_pos = l->at_neg = 1;
        l->state = LIMIT_ON;
        break;
    case LIMIT_ON:
        if(!in) {
            l->at_pos = l->at_neg = 0;
            l->state = motion;
        }
        break;
    default:
        if(in) {
            l->at_pos = l->state != LIMIT_NEG_MOTION;
            l->at_neg = l->state != LIMIT_POS_MOTION;
            l->state = LIMIT_ON;
        } else {
            l->state = motion;
        }
    }
    hal_set_bool(l->pos_out, l->at_pos && !allowed);
    hal_set_bool(l->neg_out, l->at_neg && !allowed);
    if(debug > 0) hal_set_ui32(l->shown_state, l->state);
}

static void refresh_limits(struct plc *p)
{
    int override = hal_get_bool(p->override), allowed = hal_get_bool(p->z.jog_enable) && override;
    int z_pos = hal_get_bool(p->z.pos_in), z_neg = hal_get_bool(p->z.neg_in);
    refresh_limit(&p->x, override);
    refresh_limit(&p->y, override);
    hal_set_bool(p->z.pos_out, z_pos && !allowed);
    hal_set_bool(p->z.neg_out, z_neg && !allowed);
    hal_set_bool(p->limit_active, hal_get_bool(p->x.in) || hal_get_bool(p->y.in) || z_pos || z_neg);
}

static void refresh_amp(struct plc *p, struct amp *a, long period)
{
    int enabled = hal_get_bool(a->enable), expired = timer_done(&a->timer, period);
    if(!enabled) a->timer.running = 0;
    else if(!a->was_enabled) timer_start(&a->timer, p->amp_ready_delay);
    expired = expired && !a->timer.running;
    a->was_enabled = enabled;
    hal_set_bool(a->fault, enabled && !hal_get_bool(a->ready) && expired);
}

static void set_direction(struct plc *p, double speed)
{
    double limit = hal_get_real(p->lo_to_hi);
    int forward = speed > limit || (speed >= -limit && speed < 0);
    hal_set_bool(p->fwd, forward);
    hal_set_bool(p->rev, !forward);
}

static void spindle_off(struct plc *p)
{
    hal_set_bool(p->fwd, 0);
    hal_set_bool(p->rev, 0);
}

static void refresh_spindle(struct plc *p, long period)
{
    double speed = hal_get_real(p->speed);
    int is_on = hal_get_bool(p->is_on), brake = hal_get_bool(p->brake_in);
    int inc = hal_get_bool(p->inc_in), dec = hal_get_bool(p->dec_in);
    int expired = timer_done(&p->brake_timer, period);
    switch(p->spindle) {
    case SPINDLE_OFF:
        if(!brake) {
            p->spindle = SPINDLE_BRAKE_OFF;
            hal_set_bool(p->brake_out, 0);
            timer_start(&p->brake_timer, p->brake_off_delay);
        }
        break;
    case SPINDLE_BRAKE_OFF:
        if(brake) {
            p->spindle = SPINDLE_OFF;
            hal_set_bool(p->brake_out, 1);
        } else if(speed != 0 && expired) {
            p->spindle = SPINDLE_WAIT_ON;
            set_direction(p, speed);
        }
        break;
    case SPINDLE_WAIT_ON:
        if(is_on) {
            p->spindle = SPINDLE_ON;
        } else if(speed == 0) {
            p->spindle = SPINDLE_BRAKE_OFF;
            spindle_off(p);
        }
        break;
    case SPINDLE_ON:
        if(speed == 0) {
            p->spindle = SPINDLE_WAIT_OFF;
            spindle_off(p);
        }
        break;
    case SPINDLE_WAIT_OFF:
        if(!is_on) {
            p->spindle = SPINDLE_BRAKE_ON;
            timer_start(&p->brake_timer, p->brake_on_delay);
        }
        break;
    case SPINDLE_BRAKE_ON:
    default:
        if(expired) p->spindle = SPINDLE_BRAKE_OFF;
    }
    hal_set_bool(p->inc_out, inc && !dec && is_on);
    hal_set_bool(p->dec_out, dec && !inc && is_on);
    if(debug > 0) hal_set_ui32(p->shown_spindle, p->spindle);
}

static void refresh_jog(struct plc *p)
{
    int i;
    for(i = 0; i < JOG_SCALES; i++) {
        if(!hal_get_bool(p->jog_select[i])) continue;
        hal_set_real(p->jog_scale_out, hal_get_real(p->jog_scale[i]));
        return;
    }
}

/* HAL function boss_plc.N.refresh. [servo] */
static void refresh(void *arg, long period)
{
    struct plc *p = arg;
    int i;
    refresh_feed(p);
    refresh_limits(p);
    for(i = 0; i < 4; i++) refresh_amp(p, &p->amp[i], period);
    refresh_spindle(p, period);
    refresh_jog(p);
}

/* ---- [init] -------------------------------------------------------------- */

static int in(hal_bool_t *pin, int n, const char *name)
{
    return hal_pin_new_bool(comp_id, HAL_IN, pin, 0, "boss_plc.%d.%s", n, name);
}

static int out(hal_bool_t *pin, int n, const char *name)
{
    return hal_pin_new_bool(comp_id, HAL_OUT, pin, 0, "boss_plc.%d.%s", n, name);
}

static int export_feed(struct plc *p, int n)
{
    COMP_TRY(in(&p->cycle_start, n, "cycle-start-in"));
    COMP_TRY(in(&p->cycle_hold, n, "cycle-hold-in"));
    COMP_TRY(out(&p->feed_hold, n, "feed-hold-out"));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_IN, &p->adaptive_in, 1.0, "boss_plc.%d.adaptive-feed-in", n));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_OUT, &p->adaptive_out, 0, "boss_plc.%d.adaptive-feed-out", n));
    COMP_TRY(in(&p->tool_change, n, "tool-change-in"));
    COMP_TRY(out(&p->tool_changed, n, "tool-changed-out"));
    COMP_TRY(out(&p->wait_user, n, "wait-user-out"));
    COMP_TRY(in(&p->mist_in, n, "mist-on-in"));
    COMP_TRY(out(&p->mist_out, n, "mist-on-out"));
    COMP_TRY(in(&p->flood_in, n, "flood-on-in"));
    COMP_TRY(out(&p->flood_out, n, "flood-on-out"));
    return 0;
}

static int export_limit(struct limit *l, int n, char axis)
{
    COMP_TRY(hal_pin_new_real(comp_id, HAL_IN, &l->position, 0, "boss_plc.%d.%c-position-in", n, axis));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &l->jog_enable, 0, "boss_plc.%d.%c-jog-en-in", n, axis));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &l->in, 0, "boss_plc.%d.%c-limit-in", n, axis));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_OUT, &l->pos_out, 0, "boss_plc.%d.%c-limit-pos-out", n, axis));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_OUT, &l->neg_out, 0, "boss_plc.%d.%c-limit-neg-out", n, axis));
    if(debug > 0)
        COMP_TRY(hal_param_new_ui32(comp_id, HAL_RO, &l->shown_state, 0, "boss_plc.%d.%c-limit-state", n, axis));
    return 0;
}

static int export_limits(struct plc *p, int n)
{
    COMP_TRY(in(&p->override, n, "limit-override-in"));
    COMP_TRY(out(&p->limit_active, n, "limit-active-out"));
    COMP_TRY(export_limit(&p->x, n, 'x'));
    COMP_TRY(export_limit(&p->y, n, 'y'));
    COMP_TRY(in(&p->z.pos_in, n, "z-limit-pos-in"));
    COMP_TRY(in(&p->z.jog_enable, n, "z-jog-en-in"));
    COMP_TRY(in(&p->z.neg_in, n, "z-limit-neg-in"));
    COMP_TRY(out(&p->z.pos_out, n, "z-limit-pos-out"));
    COMP_TRY(out(&p->z.neg_out, n, "z-limit-neg-out"));
    return 0;
}

static int export_amps(struct plc *p, int n)
{
    int i;
    COMP_TRY(hal_pin_new_ui32(comp_id, HAL_IO, &p->amp_ready_delay, 50, "boss_plc.%d.amp-ready-delay", n));
    for(i = 0; i < 4; i++) {
        char axis = "xyza"[i];
        struct amp *a = &p->amp[i];
        COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &a->enable, 0, "boss_plc.%d.%c-amp-enable-in", n, axis));
        COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &a->ready, 0, "boss_plc.%d.%c-amp-ready-in", n, axis));
        COMP_TRY(hal_pin_new_bool(comp_id, HAL_OUT, &a->fault, 0, "boss_plc.%d.%c-amp-fault-out", n, axis));
    }
    return 0;
}

static int export_spindle(struct plc *p, int n)
{
    COMP_TRY(hal_pin_new_ui32(comp_id, HAL_IO, &p->brake_on_delay, 300, "boss_plc.%d.brake-on-delay", n));
    COMP_TRY(hal_pin_new_ui32(comp_id, HAL_IO, &p->brake_off_delay, 500, "boss_plc.%d.brake-off-delay", n));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_IO, &p->lo_to_hi, 500, "boss_plc.%d.spindle-lo-to-hi", n));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_IN, &p->speed, 0, "boss_plc.%d.spindle-speed-in", n));
    COMP_TRY(in(&p->is_on, n, "spindle-is-on-in"));
    COMP_TRY(out(&p->fwd, n, "spindle-fwd-out"));
    COMP_TRY(out(&p->rev, n, "spindle-rev-out"));
    COMP_TRY(in(&p->inc_in, n, "spindle-inc-in"));
    COMP_TRY(in(&p->dec_in, n, "spindle-dec-in"));
    COMP_TRY(out(&p->inc_out, n, "spindle-inc-out"));
    COMP_TRY(out(&p->dec_out, n, "spindle-dec-out"));
    COMP_TRY(in(&p->brake_in, n, "brake-en-in"));
    COMP_TRY(out(&p->brake_out, n, "brake-en-out"));
    if(debug > 0)
        COMP_TRY(hal_param_new_ui32(comp_id, HAL_RO, &p->shown_spindle, 0, "boss_plc.%d.spindle-state", n));
    return 0;
}

static int export_jog(struct plc *p, int n)
{
    static const double scales[JOG_SCALES] = { 0.0001, 0.001, 0.01 };
    int i;
    for(i = 0; i < JOG_SCALES; i++) {
        COMP_TRY(hal_pin_new_real(comp_id, HAL_IO, &p->jog_scale[i], scales[i], "boss_plc.%d.jog-scale-%d", n, i));
        COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &p->jog_select[i], 0, "boss_plc.%d.jog-sel-in-%d", n, i));
    }
    return hal_pin_new_real(comp_id, HAL_OUT, &p->jog_scale_out, 0, "boss_plc.%d.jog-scale-out", n);
}

static int export_plc(int n)
{
    struct plc *p = hal_malloc(sizeof *p);
    if(!p) return -ENOMEM;
    p->was_start = 1;
    COMP_TRY(export_feed(p, n));
    COMP_TRY(export_limits(p, n));
    COMP_TRY(export_amps(p, n));
    COMP_TRY(export_spindle(p, n));
    COMP_TRY(export_jog(p, n));
    return hal_export_functf(refresh, p, 1, 0, comp_id, "boss_plc.%d.refresh", n);
}

int rtapi_app_main(void)
{
    int i, r = 0;
    if(count < 1 || count > MAX_INSTANCES) {
        rtapi_print_msg(RTAPI_MSG_ERR, "BOSS_PLC: ERROR: count must be 1 to %d, not %d\n", MAX_INSTANCES, count);
        return -EINVAL;
    }
    comp_id = hal_init("boss_plc");
    if(comp_id < 0) return comp_id;
    for(i = 0; r >= 0 && i < count; i++) r = export_plc(i);
    if(r < 0) {
        hal_exit(comp_id);
        return r;
    }
    return hal_ready(comp_id);
}

void rtapi_app_exit(void)
{
    hal_exit(comp_id);
}
