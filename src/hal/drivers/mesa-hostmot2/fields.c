/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * fields.c - values of any number of bits as pins.
 */
#include "fields.h"

#define SIGNED_FULL 2147483647.0

/* ---- Pins [init] ---------------------------------------------------------- */

/* A card's input is our output. */
static hal_pdir_t pin_dir(const struct field *f)
{
    return f->dir == FIELD_IN ? HAL_OUT : f->dir == FIELD_OUT ? HAL_IN : HAL_IO;
}

static int export_bits(struct hm2 *hm2, struct field *f, const char *prefix)
{
    int id = hm2->io->comp_id, i, n = f->type == FIELD_BOOLEAN ? 1 : f->length;
    hal_pdir_t dir = pin_dir(f);
    long size = (long)sizeof(hal_bool_t) * n;
    f->bit = hal_malloc(size);
    f->bit_not = hal_malloc(size);
    f->bit_invert = hal_malloc(size);
    if(!f->bit || !f->bit_not || !f->bit_invert) return -ENOMEM;
    for(i = 0; i < n; i++) {
        char name[FIELD_NAME_LEN + 8];
        if(f->type == FIELD_BOOLEAN) snprintf(name, sizeof name, "%s", f->name);
        else snprintf(name, sizeof name, "%s-%02d", f->name, i);
        COMP_TRY(hal_pin_new_bool(id, dir, &f->bit[i], 0, "%s.%s", prefix, name));
        if(dir == HAL_OUT) COMP_TRY(hal_pin_new_bool(id, HAL_OUT, &f->bit_not[i], 0, "%s.%s-not", prefix, name));
        if(dir == HAL_IN) COMP_TRY(hal_param_new_bool(id, HAL_RW, &f->bit_invert[i], 0, "%s.%s-invert", prefix, name));
    }
    return 0;
}

static int export_number(struct hm2 *hm2, struct field *f, const char *prefix)
{
    int id = hm2->io->comp_id;
    COMP_TRY(hal_pin_new_real(id, pin_dir(f), &f->value.r, 0, "%s.%s", prefix, f->name));
    COMP_TRY(hal_param_new_real(id, HAL_RW, &f->scalemax, f->max, "%s.%s-scalemax", prefix, f->name));
    if(pin_dir(f) == HAL_OUT) return 0;
    COMP_TRY(hal_param_new_real(id, HAL_RW, &f->maxlim, f->max, "%s.%s-maxlim", prefix, f->name));
    return hal_param_new_real(id, HAL_RW, &f->minlim, f->min, "%s.%s-minlim", prefix, f->name);
}

static int export_encoder(struct hm2 *hm2, struct field *f, const char *prefix)
{
    int id = hm2->io->comp_id;
    struct field_encoder *e = f->encoder = hal_malloc(sizeof *e);
    if(!e) return -ENOMEM;
    COMP_TRY(hal_pin_new_si32(id, HAL_OUT, &e->count, 0, "%s.%s.count", prefix, f->name));
    COMP_TRY(hal_pin_new_si32(id, HAL_OUT, &e->rawcounts, 0, "%s.%s.rawcounts", prefix, f->name));
    COMP_TRY(hal_pin_new_real(id, HAL_OUT, &e->position, 0, "%s.%s.position", prefix, f->name));
    COMP_TRY(hal_pin_new_bool(id, HAL_IO, &e->index_enable, 0, "%s.%s.index-enable", prefix, f->name));
    COMP_TRY(hal_pin_new_bool(id, HAL_IO, &e->reset, 0, "%s.%s.reset", prefix, f->name));
    COMP_TRY(hal_param_new_real(id, HAL_RW, &e->scale, f->max, "%s.%s.scale", prefix, f->name));
    return hal_param_new_ui32(id, HAL_RW, &e->counts_per_rev, 256, "%s.%s.counts-per-rev", prefix, f->name);
}

int field_export(struct hm2 *hm2, struct field *f, const char *prefix)
{
    switch(f->type) {
    case FIELD_PAD: case FIELD_ENCODER_L: return 0;
    case FIELD_BITS_EACH: case FIELD_BOOLEAN: return export_bits(hm2, f, prefix);
    case FIELD_UNSIGNED: case FIELD_SIGNED: case FIELD_NV_UNSIGNED: case FIELD_NV_SIGNED:
        return export_number(hm2, f, prefix);
    case FIELD_STREAM:
        return hal_pin_new_ui32(hm2->io->comp_id, pin_dir(f), &f->value.u, 0, "%s.%s", prefix, f->name);
    case FIELD_ENCODER: case FIELD_ENCODER_H: return export_encoder(hm2, f, prefix);
    case FIELD_FLOAT: case FIELD_NV_FLOAT:
        return hal_pin_new_real(hm2->io->comp_id, pin_dir(f), &f->value.r, 0, "%s.%s", prefix, f->name);
    default:
        HM2_ERR(hm2, "%s.%s has the data type 0x%02X, which this driver does not know: update driver or card\n", prefix,
                f->name, f->type);
        return -EINVAL;
    }
}

/* ---- Bits ----------------------------------------------------------------- */

rtapi_u64 field_extract(const rtapi_u32 *words, int at, int length)
{
    rtapi_u64 value = 0;
    int i;
    for(i = 0; i < length && i < FIELD_BITS; i++)
        value |= (rtapi_u64)(words[(at + i) / 32] >> (at + i) % 32 & 1) << i;
    return value;
}

void field_insert(rtapi_u32 *words, int at, int length, rtapi_u64 value)
{
    int i;
    for(i = 0; i < length && i < FIELD_BITS; i++) {
        rtapi_u32 bit = 1u << (at + i) % 32;
        if(value >> i & 1) words[(at + i) / 32] |= bit;
        else words[(at + i) / 32] &= ~bit;
    }
}

static rtapi_u64 from_gray(rtapi_u64 value)
{
    int shift;
    for(shift = 1; shift < FIELD_BITS; shift *= 2) value ^= value >> shift;
    return value;
}

/* Greatest value of n bits. */
static double full(int n)
{
    return ldexp(1, n) - 1;
}

/* ---- From the card -------------------------------------------------------- */

/* Zero at the next full turn. */
static void watch_turn(struct field_encoder *e, rtapi_s64 before)
{
    rtapi_s64 turn = hal_get_ui32(e->counts_per_rev);
    if(!turn || !hal_get_bool(e->index_enable)) return;
    rtapi_s64 from = before / turn - (before % turn < 0), to = e->accum / turn - (e->accum % turn < 0);
    if(from == to) return;
    e->offset = (to > from ? to : from) * turn;
    hal_set_bool(e->index_enable, 0);
}

static void show_encoder(struct field *f, rtapi_u64 raw, int bits)
{
    struct field_encoder *e = f->encoder;
    rtapi_s64 before = e->accum;
    if(!e->known || f->no_wrap) e->accum = (rtapi_s64)raw;
    else e->accum = hal_extend_counter(e->accum, (rtapi_s64)raw, bits);
    if(e->known) watch_turn(e, before);
    e->known = true;
    e->previous = raw;
    if(hal_get_bool(e->reset)) e->offset = e->accum;
    hal_set_si32(e->rawcounts, (rtapi_s32)e->accum);
    hal_set_si32(e->count, (rtapi_s32)(e->accum - e->offset));
    hal_set_real(e->position, (double)(e->accum - e->offset) / comp_scale(hal_get_real(e->scale)));
}

static void show_bits(struct field *f, rtapi_u64 raw)
{
    int i, n = f->type == FIELD_BOOLEAN ? 1 : f->length;
    for(i = 0; i < n; i++) {
        bool on = f->type == FIELD_BOOLEAN ? raw != 0 : raw >> i & 1;
        hal_set_bool(f->bit[i], on);
        if(f->bit_not[i]) hal_set_bool(f->bit_not[i], !on);
    }
}

static double real_from_bits(rtapi_u64 raw, int bits)
{
    union {
        rtapi_u64 u;
        double d;
    } wide = {.u = raw};
    union {
        rtapi_u32 u;
        float f;
    } narrow = {.u = (rtapi_u32)raw};
    return bits == 64 ? wide.d : narrow.f;
}

void field_show(struct field *f, rtapi_u64 raw, const struct field *low)
{
    if(f->gray) raw = from_gray(raw);
    switch(f->type) {
    case FIELD_BITS_EACH: case FIELD_BOOLEAN: show_bits(f, raw); break;
    case FIELD_UNSIGNED: case FIELD_NV_UNSIGNED:
        hal_set_real(f->value.r, (double)raw * hal_get_real(f->scalemax) / full(f->length));
        break;
    case FIELD_SIGNED: case FIELD_NV_SIGNED: {
        rtapi_s64 wide = (rtapi_s64)(raw << (FIELD_BITS - f->length)) >> (FIELD_BITS - f->length);
        double part = ldexp((double)wide, 32 - f->length) / SIGNED_FULL;
        hal_set_real(f->value.r, part * hal_get_real(f->scalemax));
        break;
    }
    case FIELD_STREAM: hal_set_ui32(f->value.u, (rtapi_u32)raw); break;
    case FIELD_FLOAT: case FIELD_NV_FLOAT: hal_set_real(f->value.r, real_from_bits(raw, f->length)); break;
    case FIELD_ENCODER: show_encoder(f, raw, f->length); break;
    case FIELD_ENCODER_L: f->low = raw; break;
    case FIELD_ENCODER_H:
        if(low) show_encoder(f, raw << low->length | low->low, f->length + low->length);
        else show_encoder(f, raw, f->length);
        break;
    default: break;
    }
}

void field_release(struct field *f)
{
    if(f->bit && f->dir == FIELD_IN) show_bits(f, 0);
}

/* ---- To the card ---------------------------------------------------------- */

static rtapi_u64 read_bits(struct field *f)
{
    rtapi_u64 raw = 0;
    int i;
    if(f->type == FIELD_BOOLEAN) {
        bool on = hal_get_bool(f->bit[0]) != (f->bit_invert[0] && hal_get_bool(f->bit_invert[0]));
        return on ? ~(rtapi_u64)0 : 0;
    }
    for(i = 0; i < f->length; i++)
        if(hal_get_bool(f->bit[i]) != (f->bit_invert[i] && hal_get_bool(f->bit_invert[i]))) raw |= (rtapi_u64)1 << i;
    return raw;
}

static rtapi_u64 bits_from_real(double value, int bits)
{
    union {
        rtapi_u64 u;
        double d;
    } wide = {.d = value};
    union {
        rtapi_u32 u;
        float f;
    } narrow = {.f = (float)value};
    return bits == 64 ? wide.u : narrow.u;
}

rtapi_u64 field_read(struct field *f)
{
    double share;
    switch(f->type) {
    case FIELD_BITS_EACH: case FIELD_BOOLEAN: return read_bits(f);
    case FIELD_UNSIGNED: case FIELD_NV_UNSIGNED: case FIELD_SIGNED: case FIELD_NV_SIGNED:
        share = hm2_clip(hal_get_real(f->value.r), hal_get_real(f->minlim), hal_get_real(f->maxlim)) /
                comp_scale(hal_get_real(f->scalemax));
        if(f->type == FIELD_UNSIGNED || f->type == FIELD_NV_UNSIGNED)
            return (rtapi_u64)(hm2_clip(share, 0, 1) * full(f->length));
        return (rtapi_u64)(rtapi_s64)floor(ldexp((double)(rtapi_s32)(hm2_clip(share, -1, 1) * SIGNED_FULL),
                                                 f->length - 32));
    case FIELD_STREAM: return hal_get_ui32(f->value.u);
    case FIELD_FLOAT: case FIELD_NV_FLOAT: return bits_from_real(hal_get_real(f->value.r), f->length);
    default: return 0;
    }
}
