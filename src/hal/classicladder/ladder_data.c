/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * ladder_data.c - layout of the ladder's memory and access to its variables.
 *
 * Thread: ladder_read and ladder_write [any], constant cost; the rest [init]
 */
#include <string.h>
#include "classicladder/ladder.h"

#define DEFAULT_BASE_MS 1000

/* ---- Layout ---------------------------------------------------------------- */

/* Calls DO(member, type, count) for every array. */
#define EACH_ARRAY(DO) \
    DO(rungs, struct rung, rungs) \
    DO(bits, int32_t, bits) \
    DO(words, int32_t, words) \
    DO(timers, struct timer, timers) \
    DO(monostables, struct timer, monostables) \
    DO(counters, struct counter, counters) \
    DO(timers_iec, struct timer_iec, timers_iec) \
    DO(inputs, int32_t, inputs) \
    DO(outputs, int32_t, outputs) \
    DO(expressions, struct expression, expressions) \
    DO(sections, struct section, sections) \
    DO(symbols, struct symbol, symbols) \
    DO(s32_in, int32_t, s32_in) \
    DO(s32_out, int32_t, s32_out) \
    DO(float_in, int32_t, float_in) \
    DO(float_out, int32_t, float_out)

static size_t aligned(size_t n)
{
    return (n + 15) & ~(size_t)15;
}

size_t ladder_size(const struct ladder_sizes *sizes)
{
    size_t size = aligned(sizeof(struct ladder));
#define ADD(member, type, count) size += aligned(sizeof(type) * (size_t)sizes->count);
    EACH_ARRAY(ADD)
#undef ADD
    return size;
}

void ladder_layout(struct ladder *l, const struct ladder_sizes *sizes)
{
    size_t at = aligned(sizeof(struct ladder));
    l->version = LADDER_VERSION;
    l->size = (uint32_t)ladder_size(sizes);
    l->sizes = *sizes;
#define PLACE(member, type, count) \
    l->member = (uint32_t)at; \
    at += aligned(sizeof(type) * (size_t)sizes->count);
    EACH_ARRAY(PLACE)
#undef PLACE
    ladder_clear(l);
}

static const struct modbus_config default_modbus = {
    .speed = 9600, .data_bits = 8, .stop_bits = 1, .element_offset = 1, .inter_frame_ms = 100, .time_out_ms = 500,
    .debug_level = 3, .map_read_inputs = VAR_I, .map_read_coils = VAR_Q, .map_write_coils = VAR_Q,
    .map_read_input_regs = VAR_IW, .map_read_hold_regs = VAR_QW, .map_write_hold_regs = VAR_QW,
};

static void clear_sequential(struct ladder *l)
{
    int i, k;
    memset(l->step, 0, sizeof l->step);
    memset(l->transition, 0, sizeof l->transition);
    memset(l->seq_comment, 0, sizeof l->seq_comment);
    for(i = 0; i < TRANSITIONS; i++) {
        struct transition *t = &l->transition[i];
        t->condition.index_type = -1;
        for(k = 0; k < SWITCHES; k++) t->activate[k] = t->deactivate[k] = t->starts[k] = t->ends[k] = -1;
    }
}

static void clear_cells(struct rung *r)
{
    int x, y;
    for(y = 0; y < RUNG_HEIGHT; y++)
        for(x = 0; x < RUNG_WIDTH; x++) r->cell[y][x].var.index_type = -1;
}

void ladder_clear(struct ladder *l)
{
    int i;
#define ZERO(member, type, count) memset(LADDER(l, member, type), 0, sizeof(type) * (size_t)l->sizes.count);
    EACH_ARRAY(ZERO)
#undef ZERO
    memset(l->system_bits, 0, sizeof l->system_bits);
    memset(l->error_bits, 0, sizeof l->error_bits);
    l->modbus = default_modbus;
    l->refresh_ms = 50;
    clear_sequential(l);
    for(i = 0; i < l->sizes.rungs; i++) clear_cells(&LADDER(l, rungs, struct rung)[i]);
    for(i = 0; i < l->sizes.timers; i++) LADDER(l, timers, struct timer)[i].base_ms = DEFAULT_BASE_MS;
    for(i = 0; i < l->sizes.monostables; i++) LADDER(l, monostables, struct timer)[i].base_ms = DEFAULT_BASE_MS;
    for(i = 0; i < l->sizes.timers_iec; i++) LADDER(l, timers_iec, struct timer_iec)[i].base_ms = DEFAULT_BASE_MS;
    for(i = 0; i < l->sizes.sections; i++) LADDER(l, sections, struct section)[i].subroutine = -1;
    if(l->sizes.sections > 0) {
        struct section *s = LADDER(l, sections, struct section);
        s->used = 1;
        s->first_rung = s->last_rung = 0;
        strcpy(s->name, "Prog1");
    }
}

void ladder_reset(struct ladder *l)
{
    int i, x, y;
    for(i = 0; i < l->sizes.rungs; i++) {
        struct rung *r = &LADDER(l, rungs, struct rung)[i];
        for(y = 0; y < RUNG_HEIGHT; y++)
            for(x = 0; x < RUNG_WIDTH; x++) r->cell[y][x].output = r->cell[y][x].before = 0;
    }
    for(i = 0; i < l->sizes.timers; i++) {
        struct timer *t = &LADDER(l, timers, struct timer)[i];
        t->value = t->preset;
        t->running = t->done = t->input = 0;
    }
    for(i = 0; i < l->sizes.monostables; i++) {
        struct timer *m = &LADDER(l, monostables, struct timer)[i];
        m->value = m->running = m->input = 0;
    }
    for(i = 0; i < l->sizes.counters; i++) {
        int preset = LADDER(l, counters, struct counter)[i].preset;
        memset(&LADDER(l, counters, struct counter)[i], 0, sizeof(struct counter));
        LADDER(l, counters, struct counter)[i].preset = preset;
    }
    for(i = 0; i < l->sizes.timers_iec; i++) {
        struct timer_iec *t = &LADDER(l, timers_iec, struct timer_iec)[i];
        t->value = t->output = t->input = t->running = t->rest_ms = 0;
    }
    for(i = 0; i < STEPS; i++) {
        l->step[i].active = l->step[i].used && l->step[i].initial;
        l->step[i].shown = 0;
        l->step[i].active_ms = l->step[i].shown_ms = 0;
    }
}

/* ---- Variables ------------------------------------------------------------- */

/* The step with a number, or NULL. */
static const struct step *step_number(const struct ladder *l, int number)
{
    int i;
    for(i = 0; i < STEPS; i++) if(l->step[i].used && l->step[i].number == number) return &l->step[i];
    return NULL;
}

/* Where a plain variable is: an element of an array. NULL if there is none. */
static int32_t *plain(const struct ladder *l, int type, int number)
{
    struct ladder *w = (struct ladder *)(uintptr_t)l;
    int count;
    int32_t *array;
    switch(type) {
    case VAR_B: array = LADDER(w, bits, int32_t); count = l->sizes.bits; break;
    case VAR_I: array = LADDER(w, inputs, int32_t); count = l->sizes.inputs; break;
    case VAR_Q: array = LADDER(w, outputs, int32_t); count = l->sizes.outputs; break;
    case VAR_W: array = LADDER(w, words, int32_t); count = l->sizes.words; break;
    case VAR_IW: array = LADDER(w, s32_in, int32_t); count = l->sizes.s32_in; break;
    case VAR_QW: array = LADDER(w, s32_out, int32_t); count = l->sizes.s32_out; break;
    case VAR_IF: array = LADDER(w, float_in, int32_t); count = l->sizes.float_in; break;
    case VAR_QF: array = LADDER(w, float_out, int32_t); count = l->sizes.float_out; break;
    case VAR_S: array = w->system_bits; count = SYSTEM_BITS; break;
    case VAR_E: array = w->error_bits; count = ERROR_BITS; break;
    default: return NULL;
    }
    return number >= 0 && number < count ? &array[number] : NULL;
}

static struct timer *old_timer(const struct ladder *l, int number)
{
    return number >= 0 && number < l->sizes.timers
               ? &LADDER((struct ladder *)(uintptr_t)l, timers, struct timer)[number]
               : NULL;
}

static struct timer *monostable(const struct ladder *l, int number)
{
    return number >= 0 && number < l->sizes.monostables
        ? &LADDER((struct ladder *)(uintptr_t)l, monostables, struct timer)[number] : NULL;
}

static struct counter *counter(const struct ladder *l, int number)
{
    return number >= 0 && number < l->sizes.counters
        ? &LADDER((struct ladder *)(uintptr_t)l, counters, struct counter)[number] : NULL;
}

static struct timer_iec *iec_timer(const struct ladder *l, int number)
{
    return number >= 0 && number < l->sizes.timers_iec
        ? &LADDER((struct ladder *)(uintptr_t)l, timers_iec, struct timer_iec)[number] : NULL;
}

int ladder_read(const struct ladder *l, int type, int number)
{
    const int32_t *value = plain(l, type, number);
    const struct timer *t = old_timer(l, number), *m = monostable(l, number);
    const struct counter *c = counter(l, number);
    const struct timer_iec *tm = iec_timer(l, number);
    const struct step *x;
    if(value) return __atomic_load_n(value, __ATOMIC_RELAXED);
    switch(type) {
    case VAR_T_D: return t ? t->done : 0;
    case VAR_T_R: return t ? t->running : 0;
    case VAR_T_P: return t ? t->preset / t->base_ms : 0;
    case VAR_T_V: return t ? t->value / t->base_ms : 0;
    case VAR_M_R: return m ? m->running : 0;
    case VAR_M_P: return m ? m->preset / m->base_ms : 0;
    case VAR_M_V: return m ? m->value / m->base_ms : 0;
    case VAR_C_D: return c ? c->done : 0;
    case VAR_C_E: return c ? c->empty : 0;
    case VAR_C_F: return c ? c->full : 0;
    case VAR_C_P: return c ? c->preset : 0;
    case VAR_C_V: return c ? c->value : 0;
    case VAR_TM_Q: return tm ? tm->output : 0;
    case VAR_TM_P: return tm ? tm->preset : 0;
    case VAR_TM_V: return tm ? tm->value : 0;
    case VAR_X: x = step_number(l, number); return x ? x->shown : 0;
    case VAR_X_V: x = step_number(l, number); return x ? (int)(x->shown_ms / 1000) : 0;
    default: return 0;
    }
}

/* Sets a plain variable; bits become 0 or 1. */
static void set_plain(int32_t *place, int type, int value)
{
    if(place) __atomic_store_n(place, ladder_is_bit(type) ? value != 0 : value, __ATOMIC_RELAXED);
}

/* Milliseconds of n units, within 32 bits. */
static int32_t to_ms(int n, int base_ms)
{
    int64_t ms = (int64_t)n * base_ms;
    return ms > INT32_MAX ? INT32_MAX : ms < 0 ? 0 : (int32_t)ms;
}

void ladder_write(struct ladder *l, int type, int number, int value)
{
    struct timer *t = old_timer(l, number), *m = monostable(l, number);
    struct counter *c = counter(l, number);
    struct timer_iec *tm = iec_timer(l, number);
    switch(type) {
    case VAR_B: case VAR_Q: case VAR_E: case VAR_W: case VAR_QW: case VAR_QF:
        set_plain(plain(l, type, number), type, value);
        break;
    case VAR_T_P: if(t) t->preset = to_ms(value, t->base_ms); break;
    case VAR_M_P: if(m) m->preset = to_ms(value, m->base_ms); break;
    case VAR_C_P: if(c) c->preset = value; break;
    case VAR_C_V: if(c) c->value = value; break;
    case VAR_TM_P: if(tm) tm->preset = value; break;
    default: break;
    }
}

void ladder_force(struct ladder *l, int type, int number, int value)
{
    int32_t *place = plain(l, type, number);
    if(place) set_plain(place, type, value);
    else ladder_write(l, type, number, value);
}

/* The number that a reference means; -1 if it leaves the integers. */
static int resolved(const struct ladder *l, const struct var_ref *ref)
{
    int64_t number = ref->number;
    if(ref->index_type >= 0) number += ladder_read(l, ref->index_type, ref->index_number);
    return number < 0 || number > INT32_MAX ? -1 : (int)number;
}

int ladder_read_ref(const struct ladder *l, const struct var_ref *ref)
{
    return ladder_read(l, ref->type, resolved(l, ref));
}

void ladder_write_ref(struct ladder *l, const struct var_ref *ref, int value)
{
    ladder_write(l, ref->type, resolved(l, ref), value);
}
