/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * led.c - the lamps on the board.
 */
#include "hm2.h"

#define MAX_LEDS 32

struct led {
    struct hm2_md md;
    int count;
    hal_bool_t pin[MAX_LEDS];
    rtapi_u32 written;
};

static int claim(struct hm2 *hm2, const struct hm2_md *md, void **state)
{
    struct led *s;
    int i, wanted = hm2->config.num[HM2_NUM_LEDS], n = hm2->io->num_leds;
    COMP_TRY(hm2_check_md(hm2, md, 0, 1, 4, 0));
    if(wanted > n) HM2_ERR(hm2, "config string has num_leds=%d, but the board has only %d: these are used\n", wanted,
                           n);
    else if(wanted >= 0) n = wanted;
    if(*state || !n) return 0;
    s = *state = hal_malloc(sizeof *s);
    if(!s) return -ENOMEM;
    s->md = *md;
    s->count = n < MAX_LEDS ? n : MAX_LEDS;
    for(i = 0; i < s->count; i++)
        COMP_TRY(hal_pin_new_bool(hm2->io->comp_id, HAL_IN, &s->pin[i], 0, "%s.led.CR%02d", hm2->io->name, i + 1));
    return s->count;
}

static void write_settings(struct hm2 *hm2, void *state, bool force)
{
    struct led *s = state;
    rtapi_u32 lamps = 0;
    int i;
    for(i = 0; i < s->count; i++)
        if(hal_get_bool(s->pin[i])) lamps |= 1u << (31 - i);
    hm2_write_changed(hm2, s->md.base, lamps, &s->written, force);
}

const struct hm2_function_ops hm2_led = {
    .gtag = {HM2_GTAG_LED},
    .claim = claim,
    .write = write_settings,
};
