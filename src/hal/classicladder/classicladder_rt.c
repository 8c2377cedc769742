/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * classicladder_rt.c - the realtime module of the ladder: owns its memory, scans it.
 *
 * In:     pins in-NN, s32in-NN, floatin-NN (truncated)
 * Out:    pins out-NN, s32out-NN, floatout-NN
 * Thread: classicladder.0.refresh [servo]; scans at most once in a millisecond
 */
#include <rtapi.h>
#include <rtapi_app.h>
#include <rtapi_string.h>
#include <hal.h>
#include "classicladder/ladder.h"
#include "components/comp_util.h"
#include "components/real_to_int.h"

MODULE_LICENSE("GPL");
MODULE_AUTHOR("Kerf developers");
MODULE_DESCRIPTION("Ladder logic");

#define NS_PER_MS 1000000

static int numRungs, numBits, numWords, numTimers, numMonostables, numCounters, numTimersIec, numPhysInputs,
    numPhysOutputs, numArithmExpr, numSections, numSymbols, numS32in, numS32out, numFloatIn, numFloatOut;
RTAPI_MP_INT(numRungs, "rungs (100)");
RTAPI_MP_INT(numBits, "bits %B (20)");
RTAPI_MP_INT(numWords, "words %W (20)");
RTAPI_MP_INT(numTimers, "old timers (10)");
RTAPI_MP_INT(numMonostables, "monostables (10)");
RTAPI_MP_INT(numCounters, "counters (10)");
RTAPI_MP_INT(numTimersIec, "IEC timers (10)");
RTAPI_MP_INT(numPhysInputs, "bit inputs (15)");
RTAPI_MP_INT(numPhysOutputs, "bit outputs (15)");
RTAPI_MP_INT(numArithmExpr, "arithmetic expressions (100)");
RTAPI_MP_INT(numSections, "sections (10)");
RTAPI_MP_INT(numSymbols, "symbols (200)");
RTAPI_MP_INT(numS32in, "integer inputs (10)");
RTAPI_MP_INT(numS32out, "integer outputs (10)");
RTAPI_MP_INT(numFloatIn, "float inputs (10)");
RTAPI_MP_INT(numFloatOut, "float outputs (10)");

static int comp_id, shmem_id = -1;
static struct ladder *ladder;

static struct pins {
    hal_bool_t *in, *out, hide_gui;
    hal_sint_t *s32_in, *s32_out, state;
    hal_real_t *float_in, *float_out;
    rtapi_s64 rest_ns;                  /* of a millisecond */
} *pins;

/* ---- [servo] ------------------------------------------------------------- */

static void read_inputs(void)
{
    const struct ladder_sizes *n = &ladder->sizes;
    int i;
    for(i = 0; i < n->inputs; i++) LADDER(ladder, inputs, int32_t)[i] = hal_get_bool(pins->in[i]);
    for(i = 0; i < n->s32_in; i++) LADDER(ladder, s32_in, int32_t)[i] = hal_get_si32(pins->s32_in[i]);
    for(i = 0; i < n->float_in; i++)
        LADDER(ladder, float_in, int32_t)[i] = real_to_s32(hal_get_real(pins->float_in[i]));
}

static void write_outputs(void)
{
    const struct ladder_sizes *n = &ladder->sizes;
    int i;
    for(i = 0; i < n->outputs; i++) hal_set_bool(pins->out[i], LADDER(ladder, outputs, int32_t)[i] != 0);
    for(i = 0; i < n->s32_out; i++) hal_set_si32(pins->s32_out[i], LADDER(ladder, s32_out, int32_t)[i]);
    for(i = 0; i < n->float_out; i++) hal_set_real(pins->float_out[i], LADDER(ladder, float_out, int32_t)[i]);
}

/* HAL function classicladder.0.refresh. */
static void refresh(void *arg, long period)
{
    rtapi_s64 elapsed = pins->rest_ns + period, ms = elapsed / NS_PER_MS;
    (void)arg;
    pins->rest_ns = elapsed % NS_PER_MS;
    if(ms < 1) return;
    /* Announce, then look: the user side stops in the other order (ladder_stop). */
    __atomic_store_n(&ladder->scanning, 1, __ATOMIC_SEQ_CST);
    if(__atomic_load_n(&ladder->state, __ATOMIC_SEQ_CST) == LADDER_RUN) {
        read_inputs();
        if(ladder_scan(ladder, (int)ms) < 0) __atomic_store_n(&ladder->state, LADDER_STOP, __ATOMIC_SEQ_CST);
        write_outputs();
    }
    __atomic_store_n(&ladder->scanning, 0, __ATOMIC_SEQ_CST);
    hal_set_si32(pins->state, __atomic_load_n(&ladder->state, __ATOMIC_RELAXED));
}

/* ---- [init] -------------------------------------------------------------- */

static int or_default(int n, int fallback)
{
    return n > 0 ? n : fallback;
}

static struct ladder_sizes sizes(void)
{
    struct ladder_sizes n;
    int variables;
    n.rungs = or_default(numRungs, 100);
    n.bits = or_default(numBits, 20);
    n.words = or_default(numWords, 20);
    n.timers = or_default(numTimers, 10);
    n.monostables = or_default(numMonostables, 10);
    n.counters = or_default(numCounters, 10);
    n.timers_iec = or_default(numTimersIec, 10);
    n.inputs = or_default(numPhysInputs, 15);
    n.outputs = or_default(numPhysOutputs, 15);
    n.expressions = or_default(numArithmExpr, 100);
    n.sections = or_default(numSections, 10);
    n.symbols = or_default(numSymbols, 200);
    n.s32_in = or_default(numS32in, 10);
    n.s32_out = or_default(numS32out, 10);
    n.float_in = or_default(numFloatIn, 10);
    n.float_out = or_default(numFloatOut, 10);
    /* More symbols than variables make no sense. */
    variables = n.bits + n.words + n.timers + n.monostables + n.counters + n.timers_iec + n.inputs + n.outputs
        + n.s32_in + n.s32_out + n.float_in + n.float_out + STEPS + SYSTEM_BITS + ERROR_BITS;
    if(n.symbols > variables) n.symbols = variables;
    return n;
}

static void *pin_array(int n, size_t size)
{
    return hal_malloc((long)size * n);
}

static int export_bits(void)
{
    const struct ladder_sizes *n = &ladder->sizes;
    int i;
    pins->in = pin_array(n->inputs, sizeof *pins->in);
    pins->out = pin_array(n->outputs, sizeof *pins->out);
    if(!pins->in || !pins->out) return -ENOMEM;
    for(i = 0; i < n->inputs; i++)
        COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &pins->in[i], 0, "classicladder.0.in-%02d", i));
    for(i = 0; i < n->outputs; i++)
        COMP_TRY(hal_pin_new_bool(comp_id, HAL_OUT, &pins->out[i], 0, "classicladder.0.out-%02d", i));
    return hal_pin_new_bool(comp_id, HAL_IN, &pins->hide_gui, 0, "classicladder.0.hide_gui");
}

static int export_numbers(void)
{
    const struct ladder_sizes *n = &ladder->sizes;
    int i;
    pins->s32_in = pin_array(n->s32_in, sizeof *pins->s32_in);
    pins->s32_out = pin_array(n->s32_out, sizeof *pins->s32_out);
    pins->float_in = pin_array(n->float_in, sizeof *pins->float_in);
    pins->float_out = pin_array(n->float_out, sizeof *pins->float_out);
    if(!pins->s32_in || !pins->s32_out || !pins->float_in || !pins->float_out) return -ENOMEM;
    for(i = 0; i < n->s32_in; i++)
        COMP_TRY(hal_pin_new_si32(comp_id, HAL_IN, &pins->s32_in[i], 0, "classicladder.0.s32in-%02d", i));
    for(i = 0; i < n->s32_out; i++)
        COMP_TRY(hal_pin_new_si32(comp_id, HAL_OUT, &pins->s32_out[i], 0, "classicladder.0.s32out-%02d", i));
    for(i = 0; i < n->float_in; i++)
        COMP_TRY(hal_pin_new_real(comp_id, HAL_IN, &pins->float_in[i], 0, "classicladder.0.floatin-%02d", i));
    for(i = 0; i < n->float_out; i++)
        COMP_TRY(hal_pin_new_real(comp_id, HAL_OUT, &pins->float_out[i], 0, "classicladder.0.floatout-%02d", i));
    return hal_param_new_si32(comp_id, HAL_RO, &pins->state, 0, "classicladder.ladder-state");
}

/* Makes the shared memory. A segment that outlived its module is laid out anew. */
static int make_ladder(void)
{
    struct ladder_sizes n = sizes();
    size_t size = ladder_size(&n);
    void *memory;
    shmem_id = rtapi_shmem_new(LADDER_SHM_KEY, comp_id, size);
    if(shmem_id < 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "CLASSICLADDER: ERROR: no shared memory of %lu bytes\n", (unsigned long)size);
        return shmem_id;
    }
    COMP_TRY(rtapi_shmem_getptr(shmem_id, &memory));
    memset(memory, 0, size);
    ladder = memory;
    ladder_layout(ladder, &n);
    return 0;
}

static int export_all(void)
{
    pins = hal_malloc(sizeof *pins);
    if(!pins) return -ENOMEM;
    COMP_TRY(make_ladder());
    COMP_TRY(export_bits());
    COMP_TRY(export_numbers());
    return hal_export_funct("classicladder.0.refresh", refresh, NULL, 1, 0, comp_id);
}

int rtapi_app_main(void)
{
    int r;
    comp_id = hal_init("classicladder_rt");
    if(comp_id < 0) return comp_id;
    r = export_all();
    if(r < 0) {
        if(shmem_id >= 0) rtapi_shmem_delete(shmem_id, comp_id);
        hal_exit(comp_id);
        return r;
    }
    return hal_ready(comp_id);
}

void rtapi_app_exit(void)
{
    hal_exit(comp_id);
    rtapi_shmem_delete(shmem_id, comp_id);
}
