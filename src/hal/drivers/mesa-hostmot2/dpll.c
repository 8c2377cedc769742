/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * dpll.c - the board's clock that follows the servo thread; its timers sample encoders ahead of the
 * read.
 */
#include "hm2.h"

enum { BASE_RATE, PHASE_ERROR, CONTROL0, CONTROL1, TIMERS12, TIMERS34, SYNC, REGISTERS };

#define TIMERS 4
#define SETTLE_WRITES 100              /* that set the phase to 0 at the beginning */
#define MOST_PRESCALE 255

struct dpll {
    struct hm2_md md;
    hal_real_t timer_us[TIMERS], base_freq_khz, phase_error_us;
    hal_uint_t time_const, plimit, ddsize, prescale;
    rtapi_u32 *sync;
    rtapi_u32 written[REGISTERS];
    int settled;                       /* writes so far */
};

static int claim(struct hm2 *hm2, const struct hm2_md *md, void **state)
{
    static const struct hm2_item items[] = {
        HM2_ITEM(FLOAT, IN, dpll, timer_us[0], "01.timer-us", 100),
        HM2_ITEM(FLOAT, IN, dpll, timer_us[1], "02.timer-us", 100),
        HM2_ITEM(FLOAT, IN, dpll, timer_us[2], "03.timer-us", 100),
        HM2_ITEM(FLOAT, IN, dpll, timer_us[3], "04.timer-us", 100),
        HM2_ITEM(FLOAT, IN, dpll, base_freq_khz, "base-freq-khz", -1),
        HM2_ITEM(FLOAT, OUT, dpll, phase_error_us, "phase-error-us", 0),
        HM2_ITEM(U32, IN, dpll, time_const, "time-const", 2000),
        HM2_ITEM(U32, IN, dpll, plimit, "plimit", 0x400000),
        HM2_ITEM(U32, OUT, dpll, ddsize, "ddsize", 0),
        HM2_ITEM(U32, OUT, dpll, prescale, "prescale", 1),
    };
    int wanted = hm2->config.num[HM2_NUM_DPLLS];
    rtapi_u32 control;
    COMP_TRY(hm2_check_md(hm2, md, 0, REGISTERS, 4, 0));
    if(wanted > md->instances)
        HM2_ERR(hm2, "config string has num_dplls=%d, but the firmware has only %d: these are used\n", wanted,
                md->instances);
    if(*state || wanted == 0) return 0;
    struct dpll *s = *state = hal_malloc(sizeof *s);
    if(!s) return -ENOMEM;
    s->md = *md;
    COMP_TRY(hm2_export(hm2, items, HM2_COUNT(items), s, "dpll."));
    if(!hm2_read_now(hm2, hm2_register_addr(md, CONTROL1, 0), &control, sizeof control)) return -EIO;
    hal_set_ui32(s->ddsize, control & 0xFF);
    s->sync = hm2_read_region(hm2, hm2_register_addr(md, SYNC, 0), 1);
    if(!s->sync) return -ENOMEM;
    hm2->instances[md->gtag] = 1;
    return 1;
}

bool hm2_has_dpll(const struct hm2 *hm2)
{
    return hm2->config.num[HM2_NUM_DPLLS] != 0 && hm2_find_md(hm2, HM2_GTAG_DPLL);
}

static void process(struct hm2 *hm2, void *state, long period)
{
    struct dpll *s = state;
    (void)hm2;
    hal_set_real(s->phase_error_us, (double)(rtapi_s32)*s->sync * (double)period / 4294967296000.0);
}

/* Two timers, as parts of the period, before the read when positive. */
static rtapi_u32 timers_register(const struct dpll *s, int first, double period_us)
{
    rtapi_s32 low = (rtapi_s32)(-hal_get_real(s->timer_us[first]) / period_us * 65536);
    rtapi_s32 high = (rtapi_s32)(-hal_get_real(s->timer_us[first + 1]) / period_us * 65536);
    return (rtapi_u32)high << 16 | ((rtapi_u32)low & 0xFFFF);
}

static void write_settings(struct hm2 *hm2, void *state, bool force)
{
    struct dpll *s = state;
    rtapi_u32 now[REGISTERS];
    double khz = hal_get_real(s->base_freq_khz), size;
    static const int written[] = {BASE_RATE, CONTROL0, CONTROL1, TIMERS12, TIMERS34};
    int i;
    if(hm2->io->period <= 0) return; /* no thread yet */
    if(!(khz > 0)) khz = hal_set_real(s->base_freq_khz, 1e6 / (double)hm2->io->period);
    size = ldexp(1, (int)(hal_get_ui32(s->ddsize) & 63));
    double prescale = floor(0x40000000 * (double)s->md.clock / (size * khz * 1000));
    prescale = hm2_clip(prescale, 1, MOST_PRESCALE);
    hal_set_ui32(s->prescale, (rtapi_u32)prescale);
    now[BASE_RATE] = (rtapi_u32)hm2_clip(khz * 1000 * size * prescale / s->md.clock, 0, 4294967295.0);
    now[CONTROL0] = (rtapi_u32)prescale << 24 | (hal_get_ui32(s->plimit) & 0xFFFFFF);
    now[CONTROL1] = hal_get_ui32(s->time_const) << 16;
    now[TIMERS12] = timers_register(s, 0, 1000 / khz);
    now[TIMERS34] = timers_register(s, 2, 1000 / khz);
    for(i = 0; i < HM2_COUNT(written); i++)
        hm2_write_changed(hm2, hm2_register_addr(&s->md, written[i], 0), now[written[i]], &s->written[written[i]],
                          force);
    if(s->settled < SETTLE_WRITES) {
        s->settled++;
        hm2_queue_write(hm2, hm2_register_addr(&s->md, PHASE_ERROR, 0), 0);
    }
}

const struct hm2_function_ops hm2_dpll = {
    .gtag = {HM2_GTAG_DPLL},
    .claim = claim,
    .process = process,
    .write = write_settings,
};
