/* SPDX-License-Identifier: GPL-2.0-or-later
 * Tasks and what the interface promises of them; prints each answer. */
#include "rtapi.h"
#include "rtapi_app.h"

static int fast, slow;
static long long begin;
static volatile long fast_cycles, slow_cycles;

static void fast_code(void *arg)
{
    (void)arg;
    for (int i = 0;; i++) {
        if (i < 4) {
            rtapi_print("fast cycle %d at %lld us, due %lld us\n", i, (rtapi_get_time() - begin) / 1000,
                        (rtapi_task_pll_get_reference() - begin) / 1000);
        }
        if (i == 1) {
            rtapi_print("pll %d\n", rtapi_task_pll_set_correction(1000000)); /* clamped to 1 % */
        }
        if (i == 3) {
            rtapi_task_pll_set_correction(0);
            rtapi_task_self_resync();
        }
        fast_cycles++;
        rtapi_wait();
    }
}

static void slow_code(void *arg)
{
    (void)arg;
    for (int i = 0;; i++) {
        if (i < 2) {
            rtapi_print("slow cycle %d at %lld us after %ld fast ones\n", i, (rtapi_get_time() - begin) / 1000,
                        fast_cycles);
        }
        slow_cycles++;
        rtapi_wait();
    }
}

int rtapi_app_main(void)
{
    int high = rtapi_prio_highest(), low = rtapi_prio_lowest();
    rtapi_print("kernel space %d, delay at most %ld ns\n", rtapi_is_kernelspace(), rtapi_delay_max());
    rtapi_print("priorities %d %d %d %d\n", rtapi_prio_next_higher(high) == high, rtapi_prio_next_lower(low) == low,
                rtapi_prio_next_lower(high + 100) == rtapi_prio_next_lower(high),
                rtapi_prio_next_higher(low - 100) == rtapi_prio_next_higher(low));
    rtapi_print("self %d reference %lld pll %d\n", rtapi_task_self(), rtapi_task_pll_get_reference(),
                rtapi_task_pll_set_correction(1));
    rtapi_print("bad priority %d\n", rtapi_task_new(fast_code, 0, high + 1, 1, 0, 0));
    rtapi_print("bad ids %d %d %d\n", rtapi_task_start(63, 1000), rtapi_task_delete(-1), rtapi_task_delete(64));
    rtapi_print("pause %d resume %d\n", rtapi_task_pause(0), rtapi_task_resume(0));
    long asked = rtapi_clock_set_period(0), set = rtapi_clock_set_period(1234567), then = rtapi_clock_set_period(0);
    rtapi_print("period %ld %ld %ld %ld\n", asked, set, then, rtapi_clock_set_period(5));
    int count = 0;
    while (rtapi_task_new(fast_code, 0, high, 1, 0, 0) >= 0) {
        count++;
    }
    rtapi_print("%d tasks, then %d\n", count, rtapi_task_new(fast_code, 0, high, 1, 0, 0));
    for (int i = 0; i < count; i++) {
        rtapi_task_delete(i);
    }
    begin = rtapi_get_time();
    fast = rtapi_task_new(fast_code, 0, high, 1, 0, 0);
    slow = rtapi_task_new(slow_code, 0, rtapi_prio_next_lower(high), 1, 0, 0);
    rtapi_print("ids %d %d\n", fast, slow);
    return rtapi_task_start(fast, 1000000) < 0 || rtapi_task_start(slow, 2000000) < 0 ? -1 : 0;
}

void rtapi_app_exit(void)
{
    struct rtapi_lateness late;
    int result = rtapi_task_lateness(fast, &late);
    rtapi_print("lateness %d, cycles counted: %s\n", result,
                late.cycles == fast_cycles - 1 ? "all" : "SOME");
    int one = rtapi_task_delete(fast), two = rtapi_task_delete(slow);
    rtapi_print("delete %d %d\n", one, two);
    rtapi_print("again %d\n", rtapi_task_delete(fast));
}
