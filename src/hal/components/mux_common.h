/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * mux_common.h - what mux_generic and demux_generic share: the text that describes
 * an instance, pins of a type chosen at load time, the choice of an entry.
 */
#ifndef KERF_MUX_COMMON_H
#define KERF_MUX_COMMON_H

#include <rtapi.h>
#include <rtapi_ctype.h>
#include <rtapi_math.h>
#include <rtapi_string.h>
#include <hal.h>
#include "components/comp_util.h"

#define MUX_MAX_INSTANCES 100
#define MUX_MAX_ENTRIES 1024
#define MUX_MAX_BITS 10

struct mux {
    int entries, bits;                  /* bits: selection pins; those that fit into entries */
    hal_type_t in_type, out_type;
    hal_bool_t sel_bit[MUX_MAX_BITS], suppress;
    hal_uint_t sel_int, debounce_us, elapsed, selected;
    hal_refs_u *many, one;              /* the side with all entries, the other side */
};

/* Name of a type in pin names. */
static inline const char *mux_type_name(hal_type_t type)
{
    return type == HAL_BIT ? "bit" : type == HAL_FLOAT ? "float" : type == HAL_S32 ? "s32" : "u32";
}

/* [init] One pin of any of the four types. */
static inline int mux_pin(int comp_id, hal_type_t type, hal_pdir_t dir, hal_refs_u *pin, const char *name)
{
    switch(type) {
    case HAL_BIT: return hal_pin_new_bool(comp_id, dir, &pin->b, 0, "%s", name);
    case HAL_FLOAT: return hal_pin_new_real(comp_id, dir, &pin->r, 0, "%s", name);
    case HAL_S32: return hal_pin_new_si32(comp_id, dir, &pin->s, 0, "%s", name);
    default: return hal_pin_new_ui32(comp_id, dir, &pin->u, 0, "%s", name);
    }
}

/* [init] Reads a description like "ff8": digits are the number of entries, the
 * letters b f s u the input and the output type. module and what are for messages. */
static inline int mux_parse(struct mux *m, const char *text, const char *module, const char *what)
{
    int types = 0;
    m->entries = 0;
    for(; *text; text++) {
        hal_type_t type;
        int c = tolower((unsigned char)*text);
        if(isdigit(c)) {
            m->entries = m->entries * 10 + (c - '0');
            if(m->entries > MUX_MAX_ENTRIES) m->entries = MUX_MAX_ENTRIES;
            continue;
        }
        type = c == 'b' ? HAL_BIT : c == 'f' ? HAL_FLOAT : c == 's' ? HAL_S32 : c == 'u' ? HAL_U32
            : HAL_TYPE_UNSPECIFIED;
        if(type == HAL_TYPE_UNSPECIFIED) {
            rtapi_print_msg(RTAPI_MSG_ERR, "%s: invalid character in fmt string\n", module);
            return -1;
        }
        if(types == 2) {
            rtapi_print_msg(RTAPI_MSG_ERR, "%s: too many type specifiers in fmt string\n", module);
            return -1;
        }
        if(types++ == 0) m->in_type = type;
        m->out_type = type;
    }
    if(m->entries < 1) {
        rtapi_print_msg(RTAPI_MSG_ERR, "%s: No entry count given\n", module);
        return -1;
    }
    if(m->entries < 2) {
        rtapi_print_msg(RTAPI_MSG_ERR, "%s: A one-element %s makes no sense\n", module, what);
        return -1;
    }
    if(types == 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "%s: No type specifiers in fmt string\n", module);
        return -1;
    }
    /* Selection bits: for a power of two of entries, or one entry more. */
    for(m->bits = 0; 1 << (m->bits + 1) <= m->entries; m->bits++) {}
    if(1 << m->bits != (m->entries & ~1)) m->bits = 0;
    return 0;
}

/* [init] The pins of the selection. prefix: mux-gen or demux-gen. */
static inline int mux_export_selection(struct mux *m, int comp_id, const char *prefix, int n)
{
    int i;
    for(i = 0; i < m->bits; i++)
        COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &m->sel_bit[i], 0, "%s.%02d.sel-bit-%02d", prefix, n, i));
    COMP_TRY(hal_pin_new_ui32(comp_id, HAL_IN, &m->sel_int, 0, "%s.%02d.sel-int", prefix, n));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &m->suppress, 0, "%s.%02d.suppress-no-input", prefix, n));
    COMP_TRY(hal_pin_new_ui32(comp_id, HAL_IN, &m->debounce_us, 0, "%s.%02d.debounce-us", prefix, n));
    COMP_TRY(hal_param_new_ui32(comp_id, HAL_RO, &m->elapsed, 0, "%s.%02d.elapsed", prefix, n));
    COMP_TRY(hal_param_new_ui32(comp_id, HAL_RO, &m->selected, 0, "%s.%02d.selected", prefix, n));
    return 0;
}

/* The chosen entry, or -1 when nothing shall be copied in this cycle. [any] */
static inline int mux_choose(struct mux *m, long period)
{
    rtapi_u32 number = hal_get_ui32(m->sel_int);
    int i;
    for(i = 0; i < m->bits; i++) number += (rtapi_u32)hal_get_bool(m->sel_bit[i]) << i;
    if(hal_get_bool(m->suppress) && number == 0) return -1;
    if(number != hal_get_ui32(m->selected) && hal_get_ui32(m->elapsed) < hal_get_ui32(m->debounce_us)) {
        hal_set_ui32(m->elapsed, hal_get_ui32(m->elapsed) + (rtapi_u32)(period / 1000));
        return -1;
    }
    hal_set_ui32(m->selected, number);
    hal_set_ui32(m->elapsed, 0);
    return (rtapi_s32)number >= m->entries ? m->entries - 1 : (rtapi_s32)number < 0 ? 0 : (int)number;
}

/* Copies a value from one pin to another, whatever their types. [any] */
static inline void mux_copy(hal_refs_u to, hal_type_t to_type, hal_refs_u from, hal_type_t from_type)
{
    double value = from_type == HAL_BIT ? hal_get_bool(from.b)
        : from_type == HAL_FLOAT ? hal_get_real(from.r)
        : from_type == HAL_S32 ? (double)hal_get_si32(from.s) : (double)hal_get_ui32(from.u);
    switch(to_type) {
    case HAL_BIT:
        hal_set_bool(to.b, from_type == HAL_FLOAT ? fabs(value) > 2e-7 : value != 0);
        break;
    case HAL_FLOAT:
        hal_set_real(to.r, value);
        break;
    case HAL_S32:
        hal_set_si32(to.s, isnan(value) ? 0 : (rtapi_s32)fmin(RTAPI_INT32_MAX, fmax(RTAPI_INT32_MIN, value)));
        break;
    default:
        hal_set_ui32(to.u, isnan(value) ? 0 : (rtapi_u32)fmin(RTAPI_UINT32_MAX, fmax(0, value)));
    }
}

#endif
