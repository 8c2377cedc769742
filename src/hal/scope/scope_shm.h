/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * scope_shm.h - what scope_rt (realtime) and halscope (user) share.
 *
 * The ring holds rec_len samples of sample_len values; sample n (0, 1, ... since the
 * start) is at place n % rec_len. The user changes the settings only in SCOPE_IDLE and
 * SCOPE_DONE; the realtime side changes the state only by compare-and-swap, so that a
 * SCOPE_RESET of the user is never lost.
 */
#ifndef SCOPE_SHM_H
#define SCOPE_SHM_H

#include "hal.h"

#define SCOPE_KEY 0x130CF406
#define SCOPE_MAGIC 0x4b534331u
#define SCOPE_CHANNELS 16
#define SCOPE_MIN_SAMPLES 1000
#define SCOPE_MAX_SAMPLES 1000000

enum scope_state {
    SCOPE_IDLE,      /* nothing is sampled */
    SCOPE_INIT,      /* the user wants a record */
    SCOPE_PRE_TRIG,  /* the samples before the trigger are collected */
    SCOPE_TRIG_WAIT, /* the oldest samples are overwritten until the trigger comes */
    SCOPE_POST_TRIG, /* the rest of the record is collected */
    SCOPE_DONE,      /* the record is complete and stays */
    SCOPE_RESET,     /* the user wants no more */
    SCOPE_ROLL       /* samples are collected for ever */
};

union scope_value {
    rtapi_u64 bits;
    rtapi_real f;
    rtapi_s64 l;
    rtapi_s32 s;
    rtapi_u32 u;
    rtapi_u8 b;
};

struct scope_source {
    volatile rtapi_u32 place; /* of the value in HAL memory (hal_reference_map) */
    volatile rtapi_s32 type;  /* hal_type_t */
};

struct scope_shm {
    rtapi_u32 magic;
    rtapi_u32 buf_len; /* values in the ring */
    /* Settings. */
    rtapi_s32 sample_len;  /* values of a sample: used sources, 1..16 */
    rtapi_s32 rec_len;     /* samples of a record, at most buf_len / sample_len */
    rtapi_s32 pre_trig;    /* samples before the trigger, 0..rec_len - 1 */
    rtapi_s32 mult;        /* every mult-th run of the function takes a sample */
    rtapi_s32 trig_source; /* 0..sample_len - 1; -1: none */
    rtapi_s32 trig_rising;
    rtapi_s32 auto_trig;   /* triggers by itself after rec_len samples of waiting */
    rtapi_s32 roll;
    rtapi_real trig_level; /* bits: any */
    struct scope_source sources[SCOPE_CHANNELS];
    /* Both sides; accessed with __atomic_ functions. */
    rtapi_s32 state;
    rtapi_s32 force; /* the user triggers */
    /* The realtime side. */
    rtapi_u32 runs;   /* of the function */
    rtapi_s64 period; /* of its thread, ns */
    rtapi_u64 count;  /* samples since the start */
    rtapi_u64 trigger; /* number of the sample that triggered */
    union scope_value data[] __attribute__((aligned(64)));
};

/* A value of a type as a number. */
static inline rtapi_real scope_number(union scope_value v, int type)
{
    switch (type) {
    case HAL_BIT: return v.b != 0;
    case HAL_FLOAT: return v.f;
    case HAL_S32: return v.s;
    case HAL_U32: return v.u;
    case HAL_S64: return (rtapi_real)v.l;
    case HAL_U64: return (rtapi_real)v.bits;
    default: return 0;
    }
}

#endif
