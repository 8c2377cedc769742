/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * scope_rt.c - takes samples of up to 16 values of HAL into memory that halscope reads.
 *
 * In:     any pins, signals and parameters, by their place in HAL memory
 * Out:    shared memory SCOPE_KEY
 * Thread: sample() [servo]/[base], cost: one copy per source
 * Method: a ring and a state machine, see scope_shm.h
 */
#include "rtapi.h"
#include "rtapi_app.h"
#include "scope_shm.h"

MODULE_AUTHOR("Kerf");
MODULE_DESCRIPTION("Realtime part of the HAL oscilloscope");
MODULE_LICENSE("GPL");

static int num_samples = 32000;
RTAPI_MP_INT(num_samples, "values in the buffer, shared by all channels");

static int comp_id;
static int shm_id;
static struct scope_shm *scope;
static int phase;       /* runs since the last sample */
static int waited;      /* samples since waiting for the trigger began */
static bool above;      /* the source of the trigger at the last sample */
static bool above_known;
static rtapi_u64 last;  /* count at which the record is complete */

/* Takes one sample. */
static void capture(struct scope_shm *s)
{
    rtapi_u64 n = s->count;
    union scope_value *to = &s->data[n % (rtapi_u64)s->rec_len * (rtapi_u64)s->sample_len];
    for (int i = 0; i < s->sample_len; i++) {
        union scope_value v = {.bits = 0};
        const void *from = hal_reference_map((rtapi_intptr_t)s->sources[i].place);
        if (from) {
            switch (s->sources[i].type) {
            case HAL_BIT: v.b = __atomic_load_n((const hal_cell_u8_ *)from, __ATOMIC_RELAXED) != 0; break;
            case HAL_S32:
            case HAL_U32: v.u = __atomic_load_n((const hal_cell_u32_ *)from, __ATOMIC_RELAXED); break;
            default: v.bits = __atomic_load_n((const hal_cell_u64_ *)from, __ATOMIC_RELAXED); break;
            }
        }
        to[i] = v;
    }
    __atomic_store_n(&s->count, n + 1, __ATOMIC_RELEASE);
}

/* Whether the sample taken last triggers. */
static bool triggered(struct scope_shm *s)
{
    bool edge = false;
    if (s->trig_source >= 0 && s->trig_source < s->sample_len) {
        rtapi_u64 n = s->count - 1;
        int type = s->sources[s->trig_source].type;
        union scope_value v = s->data[n % (rtapi_u64)s->rec_len * (rtapi_u64)s->sample_len + (rtapi_u64)s->trig_source];
        bool now = type == HAL_BIT ? v.b != 0 : scope_number(v, type) > s->trig_level;
        edge = above_known && now != above && now == (s->trig_rising != 0);
        above = now;
        above_known = true;
    }
    return edge;
}

static void change(struct scope_shm *s, rtapi_s32 from, rtapi_s32 to)
{
    __atomic_compare_exchange_n(&s->state, &from, to, false, __ATOMIC_ACQ_REL, __ATOMIC_ACQUIRE);
}

/* The user's numbers are not trusted: nothing outside of the ring is touched. */
static bool usable(const struct scope_shm *s)
{
    return s->sample_len >= 1 && s->sample_len <= SCOPE_CHANNELS && s->rec_len >= 1 &&
           (rtapi_u64)s->rec_len * (rtapi_u64)s->sample_len <= s->buf_len;
}

static void begin(struct scope_shm *s, rtapi_s32 from)
{
    __atomic_store_n(&s->count, 0, __ATOMIC_RELEASE);
    __atomic_store_n(&s->force, 0, __ATOMIC_RELAXED);
    phase = s->mult;
    waited = 0;
    above_known = false;
    change(s, from, !usable(s) ? SCOPE_IDLE : s->roll ? SCOPE_ROLL : SCOPE_PRE_TRIG);
}

static bool sampling(rtapi_s32 state)
{
    return state == SCOPE_PRE_TRIG || state == SCOPE_TRIG_WAIT || state == SCOPE_POST_TRIG || state == SCOPE_ROLL;
}

static void sample(void *arg, long period)
{
    struct scope_shm *s = arg;
    bool other_rate = period != s->period;
    s->period = period;
    __atomic_store_n(&s->runs, s->runs + 1, __ATOMIC_RELAXED);
    rtapi_s32 state = __atomic_load_n(&s->state, __ATOMIC_ACQUIRE);
    if (state == SCOPE_INIT || (other_rate && sampling(state))) { /* a record has one rate */
        begin(s, state);
        state = __atomic_load_n(&s->state, __ATOMIC_ACQUIRE);
    } else if (state == SCOPE_RESET) {
        change(s, SCOPE_RESET, SCOPE_IDLE);
        return;
    }
    if (!sampling(state) || !usable(s) || ++phase < s->mult) {
        return;
    }
    phase = 0;
    if (state == SCOPE_PRE_TRIG && s->count >= (rtapi_u64)(s->pre_trig > 0 ? s->pre_trig : 0)) {
        change(s, SCOPE_PRE_TRIG, SCOPE_TRIG_WAIT);
        state = SCOPE_TRIG_WAIT;
    }
    capture(s);
    bool trigger = triggered(s);
    if (state == SCOPE_TRIG_WAIT) {
        waited++;
        if (trigger || __atomic_exchange_n(&s->force, 0, __ATOMIC_RELAXED) || (s->auto_trig && waited >= s->rec_len)) {
            s->trigger = s->count - 1;
            last = s->trigger + (rtapi_u64)(s->rec_len - (s->pre_trig > 0 ? s->pre_trig : 0));
            change(s, SCOPE_TRIG_WAIT, SCOPE_POST_TRIG);
            state = SCOPE_POST_TRIG;
        }
    }
    if (state == SCOPE_POST_TRIG && s->count >= last) {
        change(s, SCOPE_POST_TRIG, SCOPE_DONE);
    }
}

int rtapi_app_main(void)
{
    if (num_samples < SCOPE_MIN_SAMPLES || num_samples > SCOPE_MAX_SAMPLES) {
        rtapi_print_msg(RTAPI_MSG_ERR, "SCOPE: ERROR: num_samples=%d is not between %d and %d\n", num_samples,
                        SCOPE_MIN_SAMPLES, SCOPE_MAX_SAMPLES);
        return -EINVAL;
    }
    comp_id = hal_init("scope_rt");
    if (comp_id < 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "SCOPE: ERROR: hal_init() failed\n");
        return -EINVAL;
    }
    shm_id = rtapi_shmem_new(SCOPE_KEY, comp_id, sizeof *scope + (unsigned long)num_samples * sizeof scope->data[0]);
    if (shm_id < 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "SCOPE: ERROR: failed to get shared memory\n");
        hal_exit(comp_id);
        return shm_id;
    }
    void *mem;
    int result = rtapi_shmem_getptr(shm_id, &mem);
    if (result == 0) {
        scope = mem;
        *scope = (struct scope_shm){.buf_len = (rtapi_u32)num_samples, .mult = 1, .trig_source = -1};
        __atomic_store_n(&scope->magic, SCOPE_MAGIC, __ATOMIC_RELEASE);
        result = hal_export_funct("scope.sample", sample, scope, 1, 0, comp_id);
    }
    if (result < 0) {
        rtapi_shmem_delete(shm_id, comp_id);
        hal_exit(comp_id);
        return result;
    }
    hal_ready(comp_id);
    return 0;
}

void rtapi_app_exit(void)
{
    hal_exit(comp_id); /* the function is in no thread any more */
    __atomic_store_n(&scope->magic, 0, __ATOMIC_RELEASE);
    rtapi_shmem_delete(shm_id, comp_id);
}
