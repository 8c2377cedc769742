/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * A realtime function that takes as long as its pin says, once: the computer stands still meanwhile.
 */
#include <hal.h>
#include <rtapi.h>
#include <rtapi_app.h>

MODULE_LICENSE("GPL");

extern int kerf_clock_sleep_ns(long long ns);

static struct pins {
    hal_float_t *seconds;
    hal_s32_t *cycles;
} *pins;
static int comp;

static void stall(void *arg, long period)
{
    double seconds = *pins->seconds;
    (void)arg;
    (void)period;
    *pins->seconds = 0;
    ++*pins->cycles;
    if (seconds > 0)
        kerf_clock_sleep_ns((long long)(seconds * 1e9));
}

int rtapi_app_main(void)
{
    comp = hal_init("kerf_test_stall");
    pins = hal_malloc(sizeof *pins);
    if (comp < 0 || !pins || hal_pin_float_newf(HAL_IO, &pins->seconds, comp, "stall.seconds") ||
        hal_pin_s32_newf(HAL_OUT, &pins->cycles, comp, "stall.cycles") ||
        hal_export_funct("stall", stall, NULL, 1, 0, comp))
        return -1;
    return hal_ready(comp);
}

void rtapi_app_exit(void)
{
    hal_exit(comp);
}
