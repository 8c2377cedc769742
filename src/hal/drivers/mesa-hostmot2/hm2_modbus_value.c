/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hm2_modbus_value.c - numbers in registers: any order of bytes, unsigned, signed, floating. [servo]
 */
#include <string.h>
#include "hm2_modbus.h"

/* Letters as they go over the wire; A is the most significant byte. Alone, A and B are the halves of
 * a register. */
static const char *const order[16] = {"AB", "BA", "ABCD", "BADC", "CDAB", "DCBA", "ABCDEFGH", "BADCFEHG",
                                      "CDABGHEF", "DCBAHGFE", "EFGHABCD", "FEHGBADC", "GHEFCDAB", "HGFEDCBA", "A", "B"};
enum kind { UNSIGNED, SIGNED, FLOATING };

struct number {
    enum kind kind;
    rtapi_u64 u;
    rtapi_s64 s;
    double f;
};

static enum kind kind_of(const struct mb_pin *p)
{
    return (enum kind)(p->mtype >> 4);
}

int mb_type_registers(int mtype)
{
    size_t bytes = strlen(order[mtype & 15]);
    if(mtype >> 4 > FLOATING || (mtype >> 4 == FLOATING && bytes == 1)) return 0;
    return bytes < 2 ? 1 : (int)bytes / 2;
}

/* ---- Floating numbers of 16, 32 and 64 bits ------------------------------------ */

static double from_half(rtapi_u32 h)
{
    int exponent = h >> 10 & 31;
    double part = h & 1023, value;
    if(exponent == 31) value = part != 0 ? NAN : INFINITY;
    else value = exponent ? ldexp(1 + part / 1024, exponent - 15) : ldexp(part / 1024, -14);
    return h >> 15 ? -value : value;
}

static rtapi_u32 to_half(double value)
{
    rtapi_u32 sign = signbit(value) ? 0x8000 : 0;
    double size = fabs(value);
    int exponent;
    if(isnan(value)) return 0x7E00;
    if(size >= 65520) return sign | 0x7C00;
    if(size < ldexp(1, -14)) return sign | (rtapi_u32)lrint(ldexp(size, 24));
    size = frexp(size, &exponent);
    return sign | (rtapi_u32)(lrint((size * 2 - 1) * 1024) + ((exponent + 14) << 10));
}

static double from_float_bits(rtapi_u64 bits, int bytes)
{
    double d;
    float f;
    rtapi_u32 low = (rtapi_u32)bits;
    if(bytes == 2) return from_half(low);
    memcpy(&d, &bits, sizeof d);
    memcpy(&f, &low, sizeof f);
    return bytes == 8 ? d : f;
}

static rtapi_u64 to_float_bits(double value, int bytes)
{
    rtapi_u64 wide;
    rtapi_u32 low;
    float f = (float)value;
    if(bytes == 2) return to_half(value);
    memcpy(&wide, &value, sizeof wide);
    memcpy(&low, &f, sizeof low);
    return bytes == 8 ? wide : low;
}

/* ---- The wire ------------------------------------------------------------------ */

static const rtapi_u8 *place(const struct mb_pin *p, const rtapi_u8 *registers)
{
    return registers + 2 * p->at + ((p->mtype & 15) == 15);
}

static struct number from_wire(const struct mb_pin *p, const rtapi_u8 *registers)
{
    const char *letters = order[p->mtype & 15];
    const rtapi_u8 *from = place(p, registers);
    int i, n = (int)strlen(letters);
    struct number v = {.kind = kind_of(p)};
    for(i = 0; i < n; i++) v.u |= (rtapi_u64)from[i] << 8 * (n == 1 ? 0 : n - 1 - (letters[i] - 'A'));
    v.s = (rtapi_s64)(v.u << (64 - 8 * n)) >> (64 - 8 * n);
    v.f = v.kind == UNSIGNED ? (double)v.u : v.kind == SIGNED ? (double)v.s : from_float_bits(v.u, n);
    return v;
}

static void to_wire(const struct mb_pin *p, rtapi_u8 *registers, rtapi_u64 bits)
{
    const char *letters = order[p->mtype & 15];
    rtapi_u8 *to = (rtapi_u8 *)place(p, registers);
    int i, n = (int)strlen(letters);
    for(i = 0; i < n; i++) to[i] = (rtapi_u8)(bits >> 8 * (n == 1 ? 0 : n - 1 - (letters[i] - 'A')));
}

/* ---- Pins ---------------------------------------------------------------------- */

/* A number as a 64-bit integer; one that has no place there is the nearest. */
static rtapi_s64 as_s64(const struct number *v)
{
    if(v->kind == SIGNED) return v->s;
    if(v->kind == UNSIGNED) return v->u > RTAPI_INT64_MAX ? RTAPI_INT64_MAX : (rtapi_s64)v->u;
    return isnan(v->f) ? 0 : v->f >= 9223372036854775808.0 ? RTAPI_INT64_MAX
                           : v->f < -9223372036854775808.0 ? RTAPI_INT64_MIN : (rtapi_s64)v->f;
}

static rtapi_u64 as_u64(const struct number *v, bool clamp)
{
    if(v->kind == UNSIGNED) return v->u;
    if(v->kind == SIGNED) return clamp && v->s < 0 ? 0 : (rtapi_u64)v->s;
    if(!(v->f > 0)) return clamp ? 0 : (rtapi_u64)as_s64(v);
    return v->f >= 18446744073709551616.0 ? RTAPI_UINT64_MAX : (rtapi_u64)v->f;
}

static rtapi_s64 limit(rtapi_s64 value, rtapi_s64 low, rtapi_s64 high)
{
    return value < low ? low : value > high ? high : value;
}

void mb_show(struct mb_pin *p, const rtapi_u8 *registers)
{
    struct number v = from_wire(p, registers);
    bool clamp = p->flags & MB_PIN_CLAMP;
    switch(p->htype) {
    case HAL_BIT: hal_set_bool(p->value.b, v.f != 0); break;
    case HAL_FLOAT: hal_set_real(p->value.r, v.f); break;
    case HAL_S32:
        hal_set_si32(p->value.s, (rtapi_s32)(clamp ? limit(as_s64(&v), RTAPI_INT32_MIN, RTAPI_INT32_MAX) : as_s64(&v)));
        break;
    case HAL_U32: {
        rtapi_u64 u = as_u64(&v, clamp);
        hal_set_ui32(p->value.u, clamp && u > RTAPI_UINT32_MAX ? RTAPI_UINT32_MAX : (rtapi_u32)u);
        break;
    }
    case HAL_S64: hal_set_sint(p->value.s, as_s64(&v)); break;
    default: hal_set_uint(p->value.u, as_u64(&v, clamp));
    }
    if(!p->scaled) return;
    double offset = v.kind == UNSIGNED ? (double)hal_get_uint(p->offset.u)
                                       : v.kind == SIGNED ? (double)hal_get_sint(p->offset.s)
                                           : hal_get_real(p->offset.r);
    hal_set_real(p->scaled, (v.f - offset) * hal_get_real(p->scale.r));
}

void mb_show_bit(struct mb_pin *p, bool on)
{
    rtapi_u8 registers[2] = {0, on};
    struct mb_pin as_register = *p;
    as_register.at = 0;
    as_register.mtype = 0;
    mb_show(&as_register, registers);
}

static struct number from_pin(const struct mb_pin *p)
{
    struct number v = {.kind = UNSIGNED};
    switch(p->htype) {
    case HAL_BIT: v.u = hal_get_bool(p->value.b); break;
    case HAL_FLOAT: v.kind = FLOATING; v.f = hal_get_real(p->value.r); return v;
    case HAL_S32: v.kind = SIGNED; v.s = hal_get_si32(p->value.s); v.f = (double)v.s; return v;
    case HAL_S64: v.kind = SIGNED; v.s = hal_get_sint(p->value.s); v.f = (double)v.s; return v;
    case HAL_U32: v.u = hal_get_ui32(p->value.u); break;
    default: v.u = hal_get_uint(p->value.u);
    }
    v.f = (double)v.u;
    return v;
}

static double pin_offset(const struct mb_pin *p)
{
    switch(p->htype) {
    case HAL_FLOAT: return hal_get_real(p->offset.r);
    case HAL_S32: return hal_get_si32(p->offset.s);
    case HAL_S64: return (double)hal_get_sint(p->offset.s);
    case HAL_U32: return hal_get_ui32(p->offset.u);
    default: return (double)hal_get_uint(p->offset.u);
    }
}

bool mb_put(const struct mb_pin *p, rtapi_u8 *registers)
{
    struct number v = from_pin(p);
    int bytes = (int)strlen(order[p->mtype & 15]), bits = 8 * bytes;
    if(p->flags & MB_PIN_SCALE && p->htype != HAL_BIT) {
        v.kind = FLOATING;
        v.f = (v.f - pin_offset(p)) * hal_get_real(p->scale.r);
    }
    if(v.kind == FLOATING && !isfinite(v.f) && kind_of(p) != FLOATING) return false;
    if(v.kind == FLOATING && kind_of(p) != FLOATING) v.f = round(v.f);
    if(kind_of(p) == FLOATING) to_wire(p, registers, to_float_bits(v.f, bytes));
    else if(kind_of(p) == SIGNED) {
        rtapi_s64 most = (rtapi_s64)(RTAPI_UINT64_MAX >> (65 - bits)), s = as_s64(&v);
        if(!(p->flags & MB_PIN_CLAMP) && (s > most || s < -most - 1)) return false;
        to_wire(p, registers, (rtapi_u64)limit(s, -most - 1, most));
    } else {
        rtapi_u64 most = RTAPI_UINT64_MAX >> (64 - bits), u = as_u64(&v, true);
        if(!(p->flags & MB_PIN_CLAMP) && (u > most || v.f < 0)) return false;
        to_wire(p, registers, u > most ? most : u);
    }
    return true;
}

bool mb_get_bit(const struct mb_pin *p)
{
    struct number v = from_pin(p);
    return v.f != 0;
}
