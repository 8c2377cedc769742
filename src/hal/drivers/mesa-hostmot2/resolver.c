/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * resolver.c - angles of resolvers, counted over turns.
 *
 * The board gives 2^32 parts of a turn; turns are added here with 64 bits.
 */
#include "hm2.h"

enum { COMMAND, DATA, STATUS, VELOCITY, POSITION, REGISTERS };
enum { EXCITATION_DONE, EXCITATION_WAIT, EXCITATION_SENT };

#define PER_MODULE 6
#define TURN 4294967296.0
#define FILE_WAIT 5000                 /* cycles for joint-pos-fb */
#define EXCITATION_TIMEOUT_NS 1000000000LL

struct channel {
    hal_real_t position, angle, velocity, velocity_rpm, joint_pos_fb, scale, velocity_scale;
    hal_sint_t count, rawcounts;
    hal_bool_t reset, index_enable, error, use_position_file;
    hal_uint_t index_divisor;
    rtapi_s64 accum, offset;           /* parts of a turn */
    rtapi_u32 angle_reg;               /* as last seen */
    rtapi_s64 index_cnts;
    int waited;                        /* cycles for joint-pos-fb; -1: done */
};

struct resolver {
    struct hm2_md md;
    int count;
    struct channel *channel;
    hal_real_t excitation_khz;
    double khz_known, sample_hz;
    int excitation;                    /* state of asking for it */
    long long excitation_ns;           /* in that state */
    rtapi_u32 excitation_command;
    rtapi_u32 *command, *status, *velocity, *position;
};

static int claim(struct hm2 *hm2, const struct hm2_md *md, void **state)
{
    static const struct hm2_item items[] = {
        HM2_ITEM(FLOAT, OUT, channel, position, "position", 0),
        HM2_ITEM(FLOAT, OUT, channel, angle, "angle", 0),
        HM2_ITEM(FLOAT, OUT, channel, velocity, "velocity", 0),
        HM2_ITEM(FLOAT, OUT, channel, velocity_rpm, "velocity-rpm", 0),
        HM2_ITEM(S32, OUT, channel, count, "count", 0),
        HM2_ITEM(S32, OUT, channel, rawcounts, "rawcounts", 0),
        HM2_ITEM(BIT, IN, channel, reset, "reset", 0),
        HM2_ITEM(BIT, IO, channel, index_enable, "index-enable", 0),
        HM2_ITEM(BIT, OUT, channel, error, "error", 0),
        HM2_ITEM(FLOAT, IN, channel, joint_pos_fb, "joint-pos-fb", 0),
        HM2_ITEM(FLOAT, RW, channel, scale, "scale", 1),
        HM2_ITEM(FLOAT, RW, channel, velocity_scale, "velocity-scale", 1),
        HM2_ITEM(U32, RW, channel, index_divisor, "index-divisor", 1),
        HM2_ITEM(BIT, RW, channel, use_position_file, "use-position-file", 0),
    };
    static const struct hm2_item globals[] = {HM2_ITEM(FLOAT, RW, resolver, excitation_khz, "excitation-khz", -1)};
    int i, n = hm2->config.num[HM2_NUM_RESOLVERS], most = md->instances * PER_MODULE;
    if(n > most) {
        HM2_ERR(hm2, "config string has num_resolvers=%d, but the firmware has only %d, not loading driver\n", n, most);
        return -EINVAL;
    }
    if(n < 0) n = most;
    COMP_TRY(hm2_check_md(hm2, md, 0, REGISTERS, 4, 0x1F));
    if(*state || !n) return 0;
    struct resolver *s = *state = hal_malloc(sizeof *s);
    if(!s || !(s->channel = hal_malloc((long)sizeof *s->channel * n))) return -ENOMEM;
    s->md = *md;
    s->count = n;
    s->khz_known = -1;
    s->sample_hz = md->clock / 5000;
    COMP_TRY(hm2_export(hm2, globals, 1, s, "resolver."));
    for(i = 0; i < n; i++)
        COMP_TRY(hm2_export(hm2, items, HM2_COUNT(items), &s->channel[i], "resolver.%02d.", i));
    s->command = hm2_read_region(hm2, hm2_register_addr(md, COMMAND, 0), 1);
    s->status = hm2_read_region(hm2, hm2_register_addr(md, STATUS, 0), 1);
    s->velocity = hm2_read_region(hm2, hm2_register_addr(md, VELOCITY, 0), n);
    s->position = hm2_read_region(hm2, hm2_register_addr(md, POSITION, 0), n);
    if(!s->command || !s->status || !s->velocity || !s->position) return -ENOMEM;
    hm2->instances[md->gtag] = md->instances;
    return n;
}

static void start(struct hm2 *hm2, void *state)
{
    struct resolver *s = state;
    int i;
    (void)hm2;
    for(i = 0; i < s->count; i++) {
        s->channel[i].angle_reg = s->position[i];
        s->channel[i].accum = s->position[i];
    }
}

/* Zero at every index_divisor-th turn, in the direction of travel. */
static void watch_index(struct channel *c, rtapi_u32 now, rtapi_s64 step)
{
    rtapi_s64 divisor = hal_get_ui32(c->index_divisor) > 1 ? hal_get_ui32(c->index_divisor) : 1;
    bool forward = step > 0 && now < c->angle_reg, back = step < 0 && now > c->angle_reg;
    bool armed = hal_get_bool(c->index_enable);
    if(forward) {
        c->index_cnts++;
        if(!armed || (divisor > 1 && c->index_cnts % divisor != 1)) return;
        c->offset = c->accum - now;
    } else if(back) {
        c->index_cnts--;
        if(!armed || c->index_cnts % divisor != 0) return;
        c->offset = c->accum - now + (rtapi_s64)TURN;
    } else
        return;
    hal_set_bool(c->index_enable, 0);
}

/* The board knows the angle at power-up, the position file the turns. */
static void start_at_file(struct channel *c)
{
    double file = hal_get_real(c->joint_pos_fb), scale = comp_scale(hal_get_real(c->scale));
    if(c->waited < 0 || !hal_get_bool(c->use_position_file)) return;
    if(file == 0 && c->waited++ < FILE_WAIT) return;
    double turns = file / scale - c->angle_reg / TURN;
    if(isfinite(turns)
       && fabs(turns) < 1e9) c->offset = c->accum - c->angle_reg - (rtapi_s64)llrint(turns) * (rtapi_s64)TURN;
    c->waited = -1;
}

static void process(struct hm2 *hm2, void *state, long period)
{
    struct resolver *s = state;
    int i;
    (void)hm2;
    (void)period;
    for(i = 0; i < s->count; i++) {
        struct channel *c = &s->channel[i];
        rtapi_u32 now = s->position[i];
        rtapi_s64 step = (rtapi_s32)(now - c->angle_reg);
        c->accum += step;
        watch_index(c, now, step);
        c->angle_reg = now;
        start_at_file(c);
        if(hal_get_bool(c->reset)) c->offset = c->accum;
        hal_set_si32(c->rawcounts, (rtapi_s32)(c->accum >> 8));
        hal_set_si32(c->count, (rtapi_s32)((c->accum - c->offset) >> 8));
        hal_set_real(c->position, (double)(c->accum - c->offset) / TURN * hal_get_real(c->scale));
        hal_set_real(c->angle, now / TURN);
        double velocity = (rtapi_s32)s->velocity[i] / TURN * s->sample_hz * hal_get_real(c->velocity_scale);
        hal_set_real(c->velocity, velocity);
        hal_set_real(c->velocity_rpm, velocity * 60);
        hal_set_bool(c->error, *s->status >> i & 1);
    }
}

/* ---- Excitation: the command register is 0 when the board is ready. ----------- */

static void begin_excitation(struct hm2 *hm2, struct resolver *s)
{
    double khz = hal_get_real(s->excitation_khz);
    (void)hm2;
    if(khz == s->khz_known || khz < 0) return;
    double possible = khz > 8 ? 10 : khz > 4 ? 5 : 2.5;
    s->khz_known = hal_set_real(s->excitation_khz, possible);
    s->excitation_command = possible == 10 ? 0x803 : possible == 5 ? 0x802 : 0x801;
    s->sample_hz = s->md.clock / (possible == 10 ? 5000 : possible == 5 ? 10000 : 20000);
    s->excitation = EXCITATION_WAIT;
    s->excitation_ns = 0;
}

static void write_settings(struct hm2 *hm2, void *state, bool force)
{
    struct resolver *s = state;
    if(force && s->khz_known >= 0) s->khz_known = -1; /* a board that was reset has its own again */
    begin_excitation(hm2, s);
    if(s->excitation == EXCITATION_DONE) return;
    s->excitation_ns += hm2->io->period;
    if(!*s->command) {
        if(s->excitation == EXCITATION_WAIT) {
            hm2_queue_write(hm2, hm2_register_addr(&s->md, DATA, 0), 0);
            hm2_queue_write(hm2, hm2_register_addr(&s->md, COMMAND, 0), s->excitation_command);
            s->excitation = EXCITATION_SENT;
        } else
            s->excitation = EXCITATION_DONE;
    } else if(s->excitation_ns > EXCITATION_TIMEOUT_NS) {
        HM2_ERR(hm2, "the resolver module does not take the excitation frequency\n");
        s->excitation = EXCITATION_DONE;
    }
}

const struct hm2_function_ops hm2_resolver = {
    .gtag = {HM2_GTAG_RESOLVER},
    .claim = claim,
    .start = start,
    .process = process,
    .write = write_settings,
};
