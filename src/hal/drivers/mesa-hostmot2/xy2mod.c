/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * xy2mod.c - interface to galvanometers (XY2-100): position, velocity and acceleration of two axes.
 */
#include "hm2.h"

enum { ACC, VEL = 2, POS = 4, MODE = 6, COMMAND, STATUS, READ_TIMER, WRITE_TIMER, REGISTERS };

#define DISABLED_MODE 0x3C9u
#define FULL 2147483647.0
#define ACC_UNIT (4096 * 4294967296.0 * 32768 / 256)
#define AXES 2

struct axis {
    hal_real_t pos_cmd, vel_cmd, acc_cmd, pos_fb, vel_fb, scale;
    hal_uint_t control, command;
    hal_bool_t mode18, command_mode, pos_overflow, vel_overflow;
};

struct channel {
    struct axis axis[AXES];
    hal_bool_t enable;
    hal_uint_t status;
    rtapi_u32 written[READ_TIMER];     /* in the registers */
};

struct xy2mod {
    struct hm2_md md;
    int count;
    bool has_timer;
    struct channel *channel;
    hal_sint_t read_timer, write_timer;
    rtapi_u32 timer_written[2];
    rtapi_u32 *vel[AXES], *pos[AXES], *mode, *status;
};

static int export_axis(struct hm2 *hm2, struct axis *a, int i, char axis)
{
    const struct {
        hal_real_t *ref;
        hal_pdir_t dir;
        double value;
        const char *before, *behind;
    } reals[] = {
        {&a->pos_cmd, HAL_IN, 0, "pos", "-cmd"}, {&a->vel_cmd, HAL_IN, 0, "vel", "-cmd"},
        {&a->acc_cmd, HAL_IN, 0, "acc", "-cmd"}, {&a->pos_fb, HAL_OUT, 0, "pos", "-fb"},
        {&a->vel_fb, HAL_OUT, 0, "vel", "-fb"}, {&a->scale, HAL_IN, 1, "pos", "-scale"},
    };
    const struct {
        hal_bool_t *ref;
        hal_pdir_t dir;
        const char *before, *behind;
    } bits[] = {
        {&a->mode18, HAL_IN, "18bitmode", ""}, {&a->command_mode, HAL_IN, "commandmode", ""},
        {&a->pos_overflow, HAL_OUT, "pos", "-overflow"}, {&a->vel_overflow, HAL_OUT, "vel", "-overflow"},
    };
    int id = hm2->io->comp_id, k;
    const char *board = hm2->io->name;
    for(k = 0; k < HM2_COUNT(reals); k++)
        COMP_TRY(hal_pin_new_real(id, reals[k].dir, reals[k].ref, reals[k].value, "%s.xy2mod.%02d.%s%c%s", board, i,
                                  reals[k].before, axis, reals[k].behind));
    for(k = 0; k < HM2_COUNT(bits); k++)
        COMP_TRY(hal_pin_new_bool(id, bits[k].dir, bits[k].ref, 0, "%s.xy2mod.%02d.%s%c%s", board, i, bits[k].before,
                                  axis, bits[k].behind));
    COMP_TRY(hal_pin_new_ui32(id, HAL_IN, &a->control, 1, "%s.xy2mod.%02d.control%c", board, i, axis));
    return hal_pin_new_ui32(id, HAL_IN, &a->command, 0, "%s.xy2mod.%02d.command%c", board, i, axis);
}

static int add_regions(struct hm2 *hm2, struct xy2mod *s)
{
    int k;
    for(k = 0; k < AXES; k++) {
        s->vel[k] = hm2_read_region(hm2, hm2_register_addr(&s->md, VEL + k, 0), s->count);
        s->pos[k] = hm2_read_region(hm2, hm2_register_addr(&s->md, POS + k, 0), s->count);
        if(!s->vel[k] || !s->pos[k]) return -ENOMEM;
    }
    s->mode = hm2_read_region(hm2, hm2_register_addr(&s->md, MODE, 0), s->count);
    s->status = hm2_read_region(hm2, hm2_register_addr(&s->md, STATUS, 0), s->count);
    return s->mode && s->status ? 0 : -ENOMEM;
}

static int claim(struct hm2 *hm2, const struct hm2_md *md, void **state)
{
    static const struct hm2_item items[] = {
        HM2_ITEM(BIT, IN, channel, enable, "enable", 0),
        HM2_ITEM(U32, OUT, channel, status, "status", 0),
    };
    static const struct hm2_item timers[] = {
        HM2_ITEM(S32, IN, xy2mod, read_timer, "read-timer-number", -1),
        HM2_ITEM(S32, IN, xy2mod, write_timer, "write-timer-number", -1),
    };
    int i, k, n = hm2_count(hm2, md, HM2_NUM_XY2MODS);
    COMP_TRY(n);
    COMP_TRY(hm2_check_md(hm2, md, 0, REGISTERS, 4, 0x1FF));
    if(*state || !n) return 0;
    struct xy2mod *s = *state = hal_malloc(sizeof *s);
    if(!s || !(s->channel = hal_malloc((long)sizeof *s->channel * n))) return -ENOMEM;
    s->md = *md;
    s->count = n;
    s->has_timer = hm2_has_dpll(hm2);
    if(s->has_timer) COMP_TRY(hm2_export(hm2, timers, HM2_COUNT(timers), s, "xy2mod."));
    for(i = 0; i < n; i++) {
        COMP_TRY(hm2_export(hm2, items, HM2_COUNT(items), &s->channel[i], "xy2mod.%02d.", i));
        for(k = 0; k < AXES; k++) COMP_TRY(export_axis(hm2, &s->channel[i].axis[k], i, (char)('x' + k)));
    }
    COMP_TRY(add_regions(hm2, s));
    hm2->instances[md->gtag] = (rtapi_u8)n;
    return n;
}

static double scale_of(const struct axis *a)
{
    return comp_scale(hal_get_real(a->scale));
}

static void process(struct hm2 *hm2, void *state, long period)
{
    struct xy2mod *s = state;
    int i, k;
    (void)hm2;
    (void)period;
    for(i = 0; i < s->count; i++) {
        struct channel *c = &s->channel[i];
        for(k = 0; k < AXES; k++) {
            struct axis *a = &c->axis[k];
            double scale = scale_of(a);
            hal_set_real(a->pos_fb, (rtapi_s32)s->pos[k][i] / FULL / scale);
            hal_set_real(a->vel_fb, (rtapi_s32)s->vel[k][i] * (double)s->md.clock / (scale * 256 * 2147483648.0));
            hal_set_bool(a->pos_overflow, s->mode[i] >> (6 + k) & 1);
            hal_set_bool(a->vel_overflow, s->mode[i] >> (8 + k) & 1);
        }
        hal_set_ui32(c->status, s->status[i] & 0xFFFFF);
    }
}

static rtapi_u32 to_register(double value)
{
    return (rtapi_u32)(rtapi_s32)hm2_clip(value, -FULL, FULL);
}

static void axis_registers(const struct xy2mod *s, struct axis *a, bool enabled, rtapi_u32 *now, int k)
{
    double clock = s->md.clock, scale = scale_of(a);
    now[POS + k] = now[VEL + k] = now[ACC + k] = 0;
    if(enabled) {
        now[POS + k] = to_register(hal_get_real(a->pos_cmd) * FULL / scale);
        now[VEL + k] = to_register(hal_get_real(a->vel_cmd) * scale * 256 * 2147483648.0 / clock);
        now[ACC + k] = to_register(hal_get_real(a->acc_cmd) * scale * ACC_UNIT / (clock * clock));
        now[MODE] |= (hal_get_ui32(a->control) & 7) << 3 * k | (rtapi_u32)hal_get_bool(a->mode18) << (10 + k) |
                     (rtapi_u32)hal_get_bool(a->command_mode) << (12 + k);
    }
    now[COMMAND] |= (hal_get_ui32(a->command) & 0xFFFF) << 16 * k;
}

static void write_settings(struct hm2 *hm2, void *state, bool force)
{
    struct xy2mod *s = state;
    int i, k;
    for(i = 0; i < s->count; i++) {
        struct channel *c = &s->channel[i];
        bool enabled = hal_get_bool(c->enable);
        rtapi_u32 now[READ_TIMER] = {[MODE] = enabled ? 0 : DISABLED_MODE};
        for(k = 0; k < AXES; k++) axis_registers(s, &c->axis[k], enabled, now, k);
        for(k = ACC; k <= COMMAND; k++)
            hm2_write_changed(hm2, hm2_register_addr(&s->md, k, i), now[k], &c->written[k], force);
    }
    if(!s->has_timer) return;
    hm2_write_changed(hm2, hm2_register_addr(&s->md, READ_TIMER, 0), hm2_timer_register(hal_get_si32(s->read_timer)),
                      &s->timer_written[0], force);
    hm2_write_changed(hm2, hm2_register_addr(&s->md, WRITE_TIMER, 0), hm2_timer_register(hal_get_si32(s->write_timer)),
                      &s->timer_written[1], force);
}

const struct hm2_function_ops hm2_xy2mod = {
    .gtag = {HM2_GTAG_XY2MOD},
    .claim = claim,
    .process = process,
    .write = write_settings,
};
