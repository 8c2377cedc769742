/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * fields.h - values of any number of bits, one behind the other, as smart-serial cards and absolute
 * encoders send them; each is one pin or several.
 */
#ifndef HM2_FIELDS_H
#define HM2_FIELDS_H

#include "hm2.h"

#define FIELD_NAME_LEN 48
#define FIELD_BITS 64

/* As cards number them. */
enum field_type {
    FIELD_PAD = 0, FIELD_BITS_EACH = 1, FIELD_UNSIGNED = 2, FIELD_SIGNED = 3, FIELD_NV_UNSIGNED = 4,
        FIELD_NV_SIGNED = 5,
    FIELD_STREAM = 6, FIELD_BOOLEAN = 7, FIELD_ENCODER = 8, FIELD_FLOAT = 0x10, FIELD_NV_FLOAT = 0x11,
    FIELD_ENCODER_H = 0x18, /* turns; goes with the ENCODER_L before it */
    FIELD_ENCODER_L = 0x28  /* part of a turn */
};
enum field_dir { FIELD_IN = 0x00, FIELD_IO = 0x40, FIELD_OUT = 0x80 }; /* as the card sees it: IN comes from it */

struct field_encoder {
    hal_sint_t count, rawcounts;
    hal_real_t position, scale;
    hal_bool_t index_enable, reset;
    hal_uint_t counts_per_rev;
    rtapi_s64 accum, offset;           /* counts */
    rtapi_u64 previous;                /* as last received */
    bool known;                        /* previous is */
};

/* In HAL memory. */
struct field {
    rtapi_u8 type, length, dir;
    bool gray, no_wrap;
    double min, max;
    rtapi_u16 addr;                    /* on the card */
    char name[FIELD_NAME_LEN + 1];
    hal_refs_u value;
    hal_real_t scalemax, maxlim, minlim;
    hal_bool_t *bit, *bit_not, *bit_invert; /* of each bit */
    struct field_encoder *encoder;
    rtapi_u64 low;                     /* ENCODER_L */
};

/* [init] Makes a field's pins and parameters `<prefix>.<name>...`. 0 or -errno. */
int field_export(struct hm2 *hm2, struct field *f, const char *prefix);
/* [servo] Bits of a field at bit `at` of words; 64 at most. */
rtapi_u64 field_extract(const rtapi_u32 *words, int at, int length);
void field_insert(rtapi_u32 *words, int at, int length, rtapi_u64 value);
/* [servo] From received bits to the pins; low: of the ENCODER_L field before, NULL when there is none. */
void field_show(struct field *f, rtapi_u64 raw, const struct field *low);
/* [servo] The bits that the pins ask for. */
rtapi_u64 field_read(struct field *f);
/* [servo] Nothing is received any more: bits and booleans become false. */
void field_release(struct field *f);

#endif
