/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * stepgen.c - step generators: a rate for the board in each cycle, so that the position follows.
 *
 * In:     position-cmd or velocity-cmd, and where the board's accumulator is
 * Out:    the rate register, in 2^-32 steps per clock
 * Method: the position that would be reached if the speed were matched to the command's with the
 *         allowed acceleration is compared with where the command will be then.
 */
#include "hm2.h"

enum { RATE, ACCUMULATOR, MODE, DIR_SETUP, DIR_HOLD, STEP_LEN, STEP_SPACE, TABLE_DATA, TABLE_LENGTH, MASTER_DDS, TIMER,
       REGISTERS = 10 };

#define MODE_TABLE 3
#define MODE_SWAP 0x04
#define MODE_LATCH_INDEX 0x10
#define MODE_INDEX_POLARITY 0x20
#define MODE_LATCH_PROBE 0x40
#define MODE_PROBE_POLARITY 0x80
#define VERSION_SWAP 0x40
#define VERSION_LATCH 0x80
#define LONGEST 0x3FFFu                /* times, clocks */
#define LONGEST_TABLE 16
#define TINY_SCALE 1e-6
#define SUBCOUNTS 65536.0
#define FULL_RATE 2147483647.0

enum { TIMES = 4 };                    /* DIR_SETUP .. STEP_SPACE */

struct channel {
    hal_real_t position_cmd, velocity_cmd, velocity_fb, position_fb, position_latch;
    hal_sint_t counts, dbg_step_rate;
    hal_bool_t enable, control_type, position_reset;
    hal_bool_t index_enable, probe_enable, index_invert, probe_invert, swap;
    hal_real_t dbg_pos_minus_prev_cmd, dbg_ff_vel, dbg_s_to_match, dbg_vel_error, dbg_err_at_match;
    hal_real_t scale, maxvel, maxaccel;
    hal_uint_t time[TIMES], step_type, table[4];

    rtapi_s64 subcounts;               /* position, 1/65536 counts */
    rtapi_u32 accumulator;             /* as last seen */
    double old_cmd;                    /* units */
    bool maxvel_told;
    rtapi_u32 time_known[TIMES], time_reg[TIMES]; /* ns, clocks */
    rtapi_u32 mode;                    /* in the register */
    rtapi_u32 table_known[4], length;  /* written */
    int table_width;                   /* pins */
};

struct stepgen {
    struct hm2_md md;
    int count;
    bool swaps, latches, has_timer;
    struct channel *channel;
    hal_sint_t timer_number;
    rtapi_u32 timer_reg, dds_reg;
    rtapi_u32 *rate, *accumulator, *mode;
};

/* ---- Registration --------------------------------------------------------- */

static int export_channel(struct hm2 *hm2, struct stepgen *s, int i)
{
    static const struct hm2_item items[] = {
        HM2_ITEM(FLOAT, IN, channel, position_cmd, "position-cmd", 0),
        HM2_ITEM(FLOAT, IN, channel, velocity_cmd, "velocity-cmd", 0),
        HM2_ITEM(FLOAT, OUT, channel, velocity_fb, "velocity-fb", 0),
        HM2_ITEM(FLOAT, OUT, channel, position_fb, "position-fb", 0),
        HM2_ITEM(S32, OUT, channel, counts, "counts", 0),
        HM2_ITEM(BIT, IN, channel, enable, "enable", 0),
        HM2_ITEM(BIT, IN, channel, control_type, "control-type", 0),
        HM2_ITEM(BIT, IN, channel, position_reset, "position-reset", 0),
        HM2_ITEM(FLOAT, RW, channel, scale, "position-scale", 1),
        HM2_ITEM(FLOAT, RW, channel, maxvel, "maxvel", 0),
        HM2_ITEM(FLOAT, RW, channel, maxaccel, "maxaccel", 1),
        HM2_ITEM(U32, RW, channel, step_type, "step_type", 0),
        HM2_ITEM(FLOAT, OUT, channel, dbg_pos_minus_prev_cmd, "dbg_pos_minus_prev_cmd", 0),
        HM2_ITEM(FLOAT, OUT, channel, dbg_ff_vel, "dbg_ff_vel", 0),
        HM2_ITEM(FLOAT, OUT, channel, dbg_s_to_match, "dbg_s_to_match", 0),
        HM2_ITEM(FLOAT, OUT, channel, dbg_vel_error, "dbg_vel_error", 0),
        HM2_ITEM(FLOAT, OUT, channel, dbg_err_at_match, "dbg_err_at_match", 0),
        HM2_ITEM(S32, OUT, channel, dbg_step_rate, "dbg_step_rate", 0),
    };
    static const struct hm2_item swap[] = {HM2_ITEM(BIT, RW, channel, swap, "swap_step_dir", 0)};
    static const struct hm2_item latch[] = {
        HM2_ITEM(FLOAT, OUT, channel, position_latch, "position-latch", 0),
        HM2_ITEM(BIT, IO, channel, index_enable, "index-enable", 0),
        HM2_ITEM(BIT, IO, channel, probe_enable, "probe-enable", 0),
        HM2_ITEM(BIT, IN, channel, index_invert, "index-invert", 0),
        HM2_ITEM(BIT, IN, channel, probe_invert, "probe-invert", 0),
    };
    static const char *const time_name[TIMES] = {"dirsetup", "dirhold", "steplen", "stepspace"};
    struct channel *c = &s->channel[i];
    rtapi_u32 longest_ns = (rtapi_u32)(LONGEST * 1e9 / s->md.clock);
    int k;
    COMP_TRY(hm2_export(hm2, items, HM2_COUNT(items), c, "stepgen.%02d.", i));
    if(s->swaps) COMP_TRY(hm2_export(hm2, swap, HM2_COUNT(swap), c, "stepgen.%02d.", i));
    if(s->latches) COMP_TRY(hm2_export(hm2, latch, HM2_COUNT(latch), c, "stepgen.%02d.", i));
    for(k = 0; k < TIMES; k++)
        COMP_TRY(hal_param_new_ui32(hm2->io->comp_id, HAL_RW, &c->time[k], longest_ns, "%s.stepgen.%02d.%s",
                                    hm2->io->name, i, time_name[k]));
    return 0;
}

/* Table data of a generator that has more outputs than step and direction. */
static int export_table(struct hm2 *hm2, struct stepgen *s, int i)
{
    struct channel *c = &s->channel[i];
    int k;
    for(k = 0; k < hm2->pins; k++) {
        const struct hm2_pin *pin = &hm2->pin[k];
        if(pin->sec_tag != HM2_GTAG_STEPGEN || pin->sec_unit != i || !(pin->sec_pin & HM2_PIN_OUTPUT)) continue;
        if((pin->sec_pin & 0x7F) > c->table_width && (pin->sec_pin & 0x7F) <= 8) c->table_width = pin->sec_pin & 0x7F;
    }
    if(!c->table_width) return 0;
    for(k = 0; k < 4; k++)
        COMP_TRY(hal_param_new_ui32(hm2->io->comp_id, HAL_RW, &c->table[k], 0, "%s.stepgen.%02d.table-data-%d",
                                    hm2->io->name, i, k));
    return 0;
}

static int check(struct hm2 *hm2, const struct hm2_md *md)
{
    int v = md->version;
    bool known = v <= 2 || v == VERSION_SWAP + 2 || v == VERSION_LATCH + VERSION_SWAP + 2;
    if(v < 2)
        HM2_WARN(hm2, "this firmware has StepGen v%d, whose direction times are not exact: write a newer firmware to "
                 "the board\n", v);
    return hm2_check_md(hm2, md, known ? -1 : 2, REGISTERS, 4, 0x1FF);
}

static int claim(struct hm2 *hm2, const struct hm2_md *md, void **state)
{
    static const struct hm2_item timer[] = {HM2_ITEM(S32, IN, stepgen, timer_number, "timer-number", -1)};
    struct stepgen *s;
    int i, n = hm2_count(hm2, md, HM2_NUM_STEPGENS);
    COMP_TRY(n);
    COMP_TRY(check(hm2, md));
    if(*state || !n) return 0;
    s = *state = hal_malloc(sizeof *s);
    if(!s) return -ENOMEM;
    s->channel = hal_malloc((long)sizeof *s->channel * n);
    if(!s->channel) return -ENOMEM;
    s->md = *md;
    s->count = n;
    s->swaps = md->version & VERSION_SWAP;
    s->latches = md->version & VERSION_LATCH;
    s->has_timer = hm2_has_dpll(hm2);
    if(s->has_timer) COMP_TRY(hm2_export(hm2, timer, 1, s, "stepgen."));
    for(i = 0; i < n; i++) {
        COMP_TRY(export_channel(hm2, s, i));
        COMP_TRY(export_table(hm2, s, i));
    }
    s->rate = hm2_write_region(hm2, hm2_register_addr(md, RATE, 0), n);
    s->accumulator = hm2_read_region(hm2, hm2_register_addr(md, ACCUMULATOR, 0), n);
    if(!s->rate || !s->accumulator) return -ENOMEM;
    if(s->latches && !(s->mode = hm2_read_region(hm2, hm2_register_addr(md, MODE, 0), n))) return -ENOMEM;
    hm2->instances[md->gtag] = (rtapi_u8)n;
    return n;
}

static void start(struct hm2 *hm2, void *state)
{
    struct stepgen *s = state;
    int i;
    (void)hm2;
    for(i = 0; i < s->count; i++) s->channel[i].accumulator = s->accumulator[i];
}

/* ---- Reading -------------------------------------------------------------- */

static void correct_scale(struct hm2 *hm2, struct channel *c, int i)
{
    double scale = hal_get_real(c->scale);
    if(fabs(scale) >= TINY_SCALE && isfinite(scale)) return;
    HM2_ERR(hm2, "stepgen %d position-scale is too close to 0, resetting to %.1f\n", i, copysign(1.0, scale));
    hal_set_real(c->scale, copysign(1.0, scale));
}

/* Latched positions have no lowest 8 bits: 1/256 counts. */
static void process_latch(struct channel *c, rtapi_u32 mode)
{
    rtapi_u32 fired = c->mode & ~mode;
    rtapi_s64 at = c->subcounts + (rtapi_s32)((mode & 0xFFFFFF00u) - c->accumulator);
    if(!(fired & (MODE_LATCH_INDEX | MODE_LATCH_PROBE))) return;
    hal_set_real(c->position_latch, (double)at / SUBCOUNTS / hal_get_real(c->scale));
    if(fired & MODE_LATCH_INDEX) {
        c->subcounts -= at;
        hal_set_bool(c->index_enable, 0);
    } else
        hal_set_bool(c->probe_enable, 0);
}

static void process(struct hm2 *hm2, void *state, long period)
{
    struct stepgen *s = state;
    int i;
    (void)period;
    for(i = 0; i < s->count; i++) {
        struct channel *c = &s->channel[i];
        rtapi_u32 now = s->accumulator[i];
        correct_scale(hm2, c, i);
        c->subcounts += (rtapi_s32)(now - c->accumulator);
        c->accumulator = now;
        if(s->latches) process_latch(c, s->mode[i]);
        if(hal_get_bool(c->position_reset)) c->subcounts = 0;
        hal_set_si32(c->counts, (rtapi_s32)(c->subcounts >> 16));
        hal_set_real(c->position_fb, (double)c->subcounts / SUBCOUNTS / hal_get_real(c->scale));
    }
}

/* ---- Speed ---------------------------------------------------------------- */

/* What the pulses' times allow, and the user; units/s, > 0. */
static double speed_limit(struct hm2 *hm2, struct channel *c, int i)
{
    double pulse_ns = (double)hal_get_ui32(c->time[STEP_LEN - DIR_SETUP])
        + hal_get_ui32(c->time[STEP_SPACE - DIR_SETUP]);
    double physical = 1e9 / (pulse_ns > 0 ? pulse_ns : 1) / fabs(hal_get_real(c->scale));
    double wanted = hal_get_real(c->maxvel);
    if(wanted == 0 || isnan(wanted)) return physical;
    if(wanted < 0) hal_set_real(c->maxvel, wanted = fabs(wanted));
    if(wanted <= physical) {
        c->maxvel_told = false;
        return wanted;
    }
    if(!c->maxvel_told)
        HM2_ERR(hm2, "stepgen.%02d.maxvel is too big for current step timings & position-scale, clipping to max "
                "possible (%g): shorten steplen and stepspace for more\n", i, physical);
    c->maxvel_told = true;
    return hal_set_real(c->maxvel, physical);
}

/* Speed for the next t_s seconds so that the position meets a command that moves. a: greatest
 * acceleration, 0: any. */
static double follow_position(struct channel *c, double a, double t_s)
{
    double cmd = hal_get_real(c->position_cmd), now = hal_get_real(c->position_fb),
        speed = hal_get_real(c->velocity_fb);
    double ff = (cmd - c->old_cmd) / t_s, speed_err = speed - ff;
    hal_set_real(c->dbg_pos_minus_prev_cmd, now - c->old_cmd);
    hal_set_real(c->dbg_ff_vel, ff);
    hal_set_real(c->dbg_vel_error, speed_err);
    c->old_cmd = cmd;
    double match_accel = speed_err == 0 ? 0 : -copysign(a > 0 ? a : fabs(speed_err) / t_s, speed_err);
    double match_s = match_accel == 0 ? 0 : -speed_err / match_accel;
    double position_then = now + 0.5 * (ff + speed) * (match_s + t_s);
    double err = position_then - (cmd + ff * match_s);
    hal_set_real(c->dbg_s_to_match, match_s);
    hal_set_real(c->dbg_err_at_match, err);
    if(match_s < t_s || match_accel == 0 || a <= 0) {
        double wanted = ff - 0.5 * err / t_s;
        return a > 0 ? hm2_clip(wanted, speed - a * t_s, speed + a * t_s) : wanted;
    }
    /* One cycle of acceleration the other way: would that bring the position nearer? */
    double change = -2 * match_accel * t_s * match_s;
    if(fabs(err + 2 * change) < fabs(err)) match_accel = -match_accel;
    return speed + match_accel * t_s;
}

static double wanted_speed(struct hm2 *hm2, struct channel *c, int i, double t_s)
{
    double limit = speed_limit(hm2, c, i), a = hal_get_real(c->maxaccel), speed = hal_get_real(c->velocity_fb);
    double wanted;
    if(a < 0) hal_set_real(c->maxaccel, a = fabs(a));
    if(!hal_get_bool(c->enable)) {
        c->old_cmd = hal_get_real(c->position_cmd);
        return 0;
    }
    if(hal_get_bool(c->control_type)) {
        wanted = hal_get_real(c->velocity_cmd);
        c->old_cmd = hal_get_real(c->position_cmd);
        if(a > 0) wanted = hm2_clip(wanted, speed - a * t_s, speed + a * t_s);
    } else
        wanted = follow_position(c, a, t_s);
    return isnan(wanted) ? 0 : hm2_clip(wanted, -limit, limit);
}

static void prepare(struct hm2 *hm2, void *state, long period)
{
    struct stepgen *s = state;
    double t_s = (period > 0 ? (double)period : 1e6) * 1e-9;
    int i;
    for(i = 0; i < s->count; i++) {
        struct channel *c = &s->channel[i];
        correct_scale(hm2, c, i);
        double speed = wanted_speed(hm2, c, i, t_s);
        double rate = speed * hal_get_real(c->scale) * (4294967296.0 / s->md.clock);
        hal_set_real(c->velocity_fb, speed);
        s->rate[i] = (rtapi_u32)(rtapi_s32)hm2_clip(rate, -FULL_RATE, FULL_RATE);
        hal_set_si32(c->dbg_step_rate, (rtapi_s32)s->rate[i]);
    }
}

/* ---- Settings ------------------------------------------------------------- */

static void write_times(struct hm2 *hm2, struct stepgen *s, int i, bool force)
{
    static const char *const name[TIMES] = {"dirsetup", "dirhold", "steplen", "stepspace"};
    struct channel *c = &s->channel[i];
    int k;
    for(k = 0; k < TIMES; k++) {
        rtapi_u32 ns = hal_get_ui32(c->time[k]);
        rtapi_u32 reg = c->time_reg[k];
        if(ns != c->time_known[k]) {
            double clocks = ns * (s->md.clock / 1e9);
            reg = (rtapi_u32)clocks;
            if(clocks > LONGEST) {
                reg = LONGEST;
                ns = hal_set_ui32(c->time[k], (rtapi_u32)(LONGEST * 1e9 / s->md.clock));
                HM2_ERR(hm2, "stepgen %d has invalid %s, resetting to max\n", i, name[k]);
            }
            c->time_known[k] = ns;
        }
        hm2_write_changed(hm2, hm2_register_addr(&s->md, DIR_SETUP + k, i), reg, &c->time_reg[k], force);
    }
}

/* Writes the table if it changed; its bytes from the last to the first. */
static bool write_table(struct hm2 *hm2, struct stepgen *s, int i, rtapi_u32 length, bool force)
{
    struct channel *c = &s->channel[i];
    bool changed = force || length != c->length;
    int k;
    for(k = 0; k < 4; k++) {
        rtapi_u32 word = hal_get_ui32(c->table[k]);
        if(word != c->table_known[k]) changed = true;
        c->table_known[k] = word;
    }
    c->length = length;
    if(!changed) return false;
    for(k = (int)length - 1; k >= 0; k--)
        hm2_queue_write(hm2, hm2_register_addr(&s->md, TABLE_DATA, i), c->table_known[k / 4] >> k % 4 * 8 & 0xFF);
    hm2_queue_write(hm2, hm2_register_addr(&s->md, TABLE_LENGTH, i), length - 1);
    return true;
}

static rtapi_u32 mode_bits(const struct stepgen *s, const struct channel *c)
{
    rtapi_u32 mode = 0;
    if(s->swaps && hal_get_bool(c->swap)) mode |= MODE_SWAP;
    if(!s->latches) return mode;
    if(hal_get_bool(c->index_enable)) mode |= MODE_LATCH_INDEX;
    else if(hal_get_bool(c->probe_enable)) mode |= MODE_LATCH_PROBE;
    if(hal_get_bool(c->index_invert)) mode |= MODE_INDEX_POLARITY;
    if(hal_get_bool(c->probe_invert)) mode |= MODE_PROBE_POLARITY;
    return mode;
}

static void write_mode(struct hm2 *hm2, struct stepgen *s, int i, bool force)
{
    struct channel *c = &s->channel[i];
    rtapi_u32 type = hal_get_ui32(c->step_type), longest = c->table_width ? LONGEST_TABLE : 0;
    bool table = false;
    if(type > 2 && type > longest) {
        HM2_ERR(hm2, "stepgen %d has invalid step_type %u, it is 0 now (0 step and direction, 1 up and down, "
                "2 quadrature, %s)\n", i, type, longest ? "3 to 16 length of the table" : "no table in this firmware");
        type = hal_set_ui32(c->step_type, 0);
    }
    if(type > 2) {
        table = write_table(hm2, s, i, type, force);
        type = MODE_TABLE;
    }
    hm2_write_changed(hm2, hm2_register_addr(&s->md, MODE, i), type | mode_bits(s, c), &c->mode, force || table);
}

static void write_settings(struct hm2 *hm2, void *state, bool force)
{
    struct stepgen *s = state;
    int i;
    for(i = 0; i < s->count; i++) {
        write_times(hm2, s, i, force);
        write_mode(hm2, s, i, force);
    }
    hm2_write_changed(hm2, hm2_register_addr(&s->md, MASTER_DDS, 0), 0xFFFFFFFFu, &s->dds_reg, force);
    if(!s->has_timer) return;
    rtapi_s32 n = hal_get_si32(s->timer_number);
    if(n < -1 || n > 4) n = hal_set_si32(s->timer_number, 0);
    hm2_write_changed(hm2, hm2_register_addr(&s->md, TIMER, 0), hm2_timer_register(n), &s->timer_reg, force);
}

static void print(struct hm2 *hm2, void *state)
{
    struct stepgen *s = state;
    int i;
    HM2_PRINT(hm2, "StepGen:\n");
    for(i = 0; i < s->count; i++) {
        const struct channel *c = &s->channel[i];
        HM2_PRINT(hm2,
                  "    %d: rate 0x%08X accumulator 0x%08X mode 0x%02X dirsetup %u dirhold %u steplen %u stepspace %u\n",
                  i, s->rate[i], s->accumulator[i], c->mode, c->time_reg[0], c->time_reg[1], c->time_reg[2],
                  c->time_reg[3]);
    }
}

const struct hm2_function_ops hm2_stepgen = {
    .gtag = {HM2_GTAG_STEPGEN},
    .claim = claim,
    .start = start,
    .process = process,
    .prepare = prepare,
    .write = write_settings,
    .print = print,
};
