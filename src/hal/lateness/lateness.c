/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * lateness.c - shows on pins how late a thread wakes up.
 *
 *   loadrt lateness names=servo,base
 *   addf lateness.servo servo-thread
 *
 * In:     figures that RTAPI keeps of every task; .reset
 * Out:    pins of lateness.<name>, ns:
 *           .last .worst      of this cycle, the greatest since reset
 *           .worst-at         rtapi_get_time of the worst, ns
 *           .cycles           wake-ups counted
 *           .overruns         cycles that were already due again when they began
 *           .bin-00 .. -15    wake-ups later than 2^(i+9) ns and at most 2^(i+10) ns
 *                             (bin-00: below 1.024 us, bin-15: above 16.8 ms)
 * Thread: one function in the thread that is watched [servo]/[base], fixed cost
 */
#include "rtapi.h"
#include "rtapi_app.h"
#include "hal.h"

MODULE_AUTHOR("Kerf contributors");
MODULE_DESCRIPTION("Lateness of a realtime thread on pins");
MODULE_LICENSE("GPL");

#define MAX_WATCHED 16
static char *names[MAX_WATCHED];
RTAPI_MP_ARRAY_STRING(names, MAX_WATCHED, "names of the watched threads");

struct watch {
    hal_bit_t *reset;
    hal_s64_t *last, *worst, *worst_at, *cycles, *overruns;
    hal_s64_t *bins[RTAPI_LATENESS_BINS];
    int was_reset;
};
static int comp_id;

static void update(void *arg, long period)
{
    struct watch *w = arg;
    struct rtapi_lateness l;
    int task = rtapi_task_self();
    (void)period;
    if (rtapi_task_lateness(task, &l) < 0) {
        return;
    }
    if (*w->reset && !w->was_reset) {
        rtapi_task_lateness_reset(task); /* shows from the next cycle on */
    }
    w->was_reset = *w->reset;
    *w->last = l.last_ns;
    *w->worst = l.worst_ns;
    *w->worst_at = l.worst_time;
    *w->cycles = l.cycles;
    *w->overruns = l.overruns;
    for (int i = 0; i < RTAPI_LATENESS_BINS; i++) {
        *w->bins[i] = l.bins[i];
    }
}

static int export_watch(const char *name)
{
    struct watch *w = hal_malloc(sizeof *w);
    if (!w) {
        return -ENOMEM;
    }
    *w = (struct watch){0};
    struct {
        hal_s64_t **pin;
        const char *suffix;
    } const pins[] = {{&w->last, "last"},
                      {&w->worst, "worst"},
                      {&w->worst_at, "worst-at"},
                      {&w->cycles, "cycles"},
                      {&w->overruns, "overruns"}};
    int result = hal_pin_bit_newf(HAL_IN, &w->reset, comp_id, "lateness.%s.reset", name);
    for (size_t i = 0; i < sizeof pins / sizeof *pins && result >= 0; i++) {
        result = hal_pin_s64_newf(HAL_OUT, pins[i].pin, comp_id, "lateness.%s.%s", name, pins[i].suffix);
    }
    for (int i = 0; i < RTAPI_LATENESS_BINS && result >= 0; i++) {
        result = hal_pin_s64_newf(HAL_OUT, &w->bins[i], comp_id, "lateness.%s.bin-%02d", name, i);
    }
    return result < 0 ? result : hal_export_functf(update, w, 0, 0, comp_id, "lateness.%s", name);
}

int rtapi_app_main(void)
{
    int result = 0, count = 0;
    comp_id = hal_init("lateness");
    if (comp_id < 0) {
        return comp_id;
    }
    for (; count < MAX_WATCHED && names[count] && result >= 0; count++) {
        result = export_watch(names[count]);
    }
    if (count == 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "lateness: names= must name at least one thread\n");
        result = -EINVAL;
    }
    if (result < 0) {
        hal_exit(comp_id);
        return result;
    }
    return hal_ready(comp_id);
}

void rtapi_app_exit(void)
{
    hal_exit(comp_id);
}
