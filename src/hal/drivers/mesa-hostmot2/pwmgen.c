/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * pwmgen.c - pulse width and pulse density modulation.
 */
#include "hm2.h"

enum { VALUE, MODE, PWM_RATE, PDM_RATE, ENABLE, REGISTERS };
enum output_type { PWM_DIR = 1, UP_DOWN, PDM_DIR, DIR_PWM };

#define PDM_BITS 12
#define FASTEST_DDS 65535
#define MODE_DOUBLE_BUFFERED 0x20
#define MODE_DITHER 0x40
#define VALUE_NEGATIVE 0x80000000u

struct channel {
    hal_real_t value, scale;
    hal_bool_t enable, offset_mode, dither;
    hal_sint_t output_type;
    rtapi_u32 mode;                    /* in the register */
};

struct pwmgen {
    struct hm2_md md;
    int count;
    bool dithers;
    struct channel *channel;
    hal_uint_t pwm_frequency, pdm_frequency;
    rtapi_u32 pwm_known, pdm_known;    /* frequencies that the two below are for */
    rtapi_u32 pwm_dds, pdm_dds;
    bool rates_changed;
    int bits;                          /* of the PWM's counter, 9..12 */
    rtapi_u32 enabled;                 /* in the register */
    rtapi_u32 *value;
};

static int claim(struct hm2 *hm2, const struct hm2_md *md, void **state)
{
    static const struct hm2_item items[] = {
        HM2_ITEM(FLOAT, IN, channel, value, "value", 0),
        HM2_ITEM(BIT, IN, channel, enable, "enable", 0),
        HM2_ITEM(FLOAT, RW, channel, scale, "scale", 1),
        HM2_ITEM(BIT, RW, channel, offset_mode, "offset-mode", 0),
        HM2_ITEM(S32, RW, channel, output_type, "output-type", PWM_DIR),
        HM2_ITEM(BIT, RW, channel, dither, "dither", 0), /* the last: version 1 only */
    };
    static const struct hm2_item globals[] = {
        HM2_ITEM(U32, RW, pwmgen, pwm_frequency, "pwm_frequency", 20000),
        HM2_ITEM(U32, RW, pwmgen, pdm_frequency, "pdm_frequency", 20000),
    };
    struct pwmgen *s;
    int i, n = hm2_count(hm2, md, HM2_NUM_PWMGENS);
    COMP_TRY(n);
    COMP_TRY(hm2_check_md(hm2, md, md->version <= 1 ? -1 : 0, REGISTERS, 4, 0x3));
    if(*state || !n) return 0;
    s = *state = hal_malloc(sizeof *s);
    if(!s) return -ENOMEM;
    s->channel = hal_malloc((long)sizeof *s->channel * n);
    if(!s->channel) return -ENOMEM;
    s->md = *md;
    s->count = n;
    s->dithers = md->version == 1;
    COMP_TRY(hm2_export(hm2, globals, HM2_COUNT(globals), s, "pwmgen."));
    for(i = 0; i < n; i++)
        COMP_TRY(hm2_export(hm2, items, HM2_COUNT(items) - !s->dithers, &s->channel[i], "pwmgen.%02d.", i));
    s->value = hm2_write_region(hm2, hm2_register_addr(md, VALUE, 0), n);
    if(!s->value) return -ENOMEM;
    hm2->instances[md->gtag] = (rtapi_u8)n;
    return n;
}

/* The finest resolution with which the clock reaches frequency hz. */
static void set_pwm_frequency(struct hm2 *hm2, struct pwmgen *s)
{
    rtapi_u32 hz = hal_get_ui32(s->pwm_frequency);
    if(hz < 1) hz = hal_set_ui32(s->pwm_frequency, 1);
    for(s->bits = 12; s->bits >= 9; s->bits--) {
        double dds = (double)hz * 65536.0 * (1 << s->bits) / s->md.clock;
        if(dds < 65536) {
            s->pwm_dds = (rtapi_u32)dds;
            s->pwm_known = hz;
            return;
        }
    }
    s->bits = 9;
    s->pwm_dds = FASTEST_DDS;
    s->pwm_known = hal_set_ui32(s->pwm_frequency, (rtapi_u32)(s->md.clock * 65535.0 / (65536.0 * 512)));
    HM2_ERR(hm2, "max PWM frequency is %u Hz: pwmgen.pwm_frequency is that now\n", s->pwm_known);
}

static void set_pdm_frequency(struct hm2 *hm2, struct pwmgen *s)
{
    rtapi_u32 hz = hal_get_ui32(s->pdm_frequency);
    double dds = hz * 65536.0 / s->md.clock;
    s->pdm_known = hz;
    s->pdm_dds = dds >= 65536 ? FASTEST_DDS : (rtapi_u32)dds;
    if(s->pdm_dds && dds < 65536) return;
    if(!s->pdm_dds) s->pdm_dds = 1;
    s->pdm_known = hal_set_ui32(s->pdm_frequency, (rtapi_u32)((double)s->pdm_dds * s->md.clock / 65536));
    HM2_ERR(hm2, "PDM frequency %u Hz cannot be had: pwmgen.pdm_frequency is %u Hz now\n", hz, s->pdm_known);
}

static void follow_frequencies(struct hm2 *hm2, struct pwmgen *s)
{
    if(hal_get_ui32(s->pwm_frequency) != s->pwm_known || !s->bits) {
        set_pwm_frequency(hm2, s);
        s->rates_changed = true;
    }
    if(hal_get_ui32(s->pdm_frequency) != s->pdm_known || !s->pdm_dds) {
        set_pdm_frequency(hm2, s);
        s->rates_changed = true;
    }
}

/* The register for a channel's value, from -scale to scale. */
static rtapi_u32 value_register(const struct pwmgen *s, const struct channel *c)
{
    int bits = hal_get_sint(c->output_type) == PDM_DIR ? PDM_BITS : s->bits;
    double least = s->dithers && hal_get_bool(c->dither) ? 1.0625 : 1.0;
    double share = 0, value;
    if(hal_get_bool(c->enable)) {
        share = hal_get_real(c->value) / hal_get_real(c->scale);
        share = hm2_clip(share, -1, 1);
    }
    if(hal_get_bool(c->offset_mode)) {
        double half = 1 << (bits - 1);
        value = share * (half - least) + half;
    } else
        value = fabs(share) * ((1 << bits) - least);
    rtapi_u32 reg = (rtapi_u32)(value * 65536);
    return share < 0 ? reg | VALUE_NEGATIVE : reg;
}

static void prepare(struct hm2 *hm2, void *state, long period)
{
    struct pwmgen *s = state;
    int i;
    (void)period;
    follow_frequencies(hm2, s);
    for(i = 0; i < s->count; i++) s->value[i] = value_register(s, &s->channel[i]);
}

static rtapi_u32 mode_register(struct hm2 *hm2, const struct pwmgen *s, int i)
{
    struct channel *c = &s->channel[i];
    rtapi_u32 mode = (rtapi_u32)(s->bits - 9);
    switch(hal_get_sint(c->output_type)) {
    case UP_DOWN: mode |= 2 << 3; break;
    case PDM_DIR: mode |= 3 << 3; break;
    case DIR_PWM: mode |= 1 << 3; break;
    case PWM_DIR: break;
    default:
        HM2_ERR(hm2, "invalid pwmgen output-type %d of pwmgen %d, it is %d now (1 PWM and direction, 2 up and down, "
                "3 PDM and direction, 4 direction and PWM)\n", hal_get_si32(c->output_type), i, PWM_DIR);
        hal_set_si32(c->output_type, PWM_DIR);
    }
    if(hal_get_sint(c->output_type) != PDM_DIR) mode |= MODE_DOUBLE_BUFFERED;
    if(s->dithers && hal_get_bool(c->dither)) mode |= MODE_DITHER;
    return mode;
}

/* All registers are written when one of them changes. */
static void write_settings(struct hm2 *hm2, void *state, bool force)
{
    struct pwmgen *s = state;
    rtapi_u32 enabled = 0;
    int i;
    follow_frequencies(hm2, s);
    if(s->rates_changed) force = true;
    s->rates_changed = false;
    for(i = 0; i < s->count; i++) {
        rtapi_u32 mode = mode_register(hm2, s, i);
        if(mode != s->channel[i].mode) force = true;
        s->channel[i].mode = mode;
        if(hal_get_bool(s->channel[i].enable)) enabled |= 1u << i;
    }
    if(enabled == s->enabled && !force) return;
    s->enabled = enabled;
    for(i = 0; i < s->count; i++) hm2_queue_write(hm2, hm2_register_addr(&s->md, MODE, i), s->channel[i].mode);
    hm2_queue_write(hm2, hm2_register_addr(&s->md, PWM_RATE, 0), s->pwm_dds);
    hm2_queue_write(hm2, hm2_register_addr(&s->md, PDM_RATE, 0), s->pdm_dds);
    hm2_queue_write(hm2, hm2_register_addr(&s->md, ENABLE, 0), s->enabled);
}

static void print(struct hm2 *hm2, void *state)
{
    struct pwmgen *s = state;
    int i;
    HM2_PRINT(hm2, "PWMGen: pwm dds %u (%d bits) pdm dds %u enable 0x%08X\n", s->pwm_dds, s->bits, s->pdm_dds,
              s->enabled);
    for(i = 0; i < s->count; i++)
        HM2_PRINT(hm2, "    %d: value 0x%08X mode 0x%08X\n", i, s->value[i], s->channel[i].mode);
}

const struct hm2_function_ops hm2_pwmgen = {
    .gtag = {HM2_GTAG_PWMGEN},
    .claim = claim,
    .prepare = prepare,
    .write = write_settings,
    .print = print,
};
