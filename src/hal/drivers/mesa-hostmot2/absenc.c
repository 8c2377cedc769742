/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * absenc.c - absolute encoders: SSI, BiSS and Fanuc. A channel exists when the config string gives
 * its format: fields, from the lowest bit on.
 */
#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include "fields.h"

#define MAX_WORDS 3                    /* of data */
#define MAX_FIELDS 32
#define MAX_TIMER 4
#define BAD_CYCLES 5000                /* in a row, before data-invalid */
#define GOOD_CYCLES 50
#define CABLE_FAULT 0x80000000u        /* Fanuc, third word */
#define BY_TIMER 0x200u
#define BY_TRIGGER 0x100u
#define FANUC_64 "%5pbatt_fail%1b%2ppos_invalid%1b%9plow%16l%2pencoder%16h%2pcomm%10u%7pcrc%5u"

enum kind { SSI, BISS, FANUC, KINDS };

/* Registers of each kind: data, control, and the one that starts all and shows who is busy. */
static const struct {
    const char *name;
    int registers;
    rtapi_u32 multiple;
    int control, start;
    double khz;
} kinds[KINDS] = {
    [SSI] = {"ssi", 4, 0x03, 2, 3, 500},
    [BISS] = {"biss", 4, 0x07, 1, 3, 500},
    [FANUC] = {"fanuc", 3, 0x1F, 3, 5, 1024},
};

struct channel {
    int unit;                          /* of the module */
    enum kind kind;
    struct field *field;
    int fields, bits;
    hal_bool_t data_invalid;
    hal_real_t frequency_khz;
    hal_uint_t timer_number, filter;
    int bad, good;                     /* cycles in a row */
    rtapi_u32 *word[MAX_WORDS];
    rtapi_u32 control[3];              /* written */
};

struct module {
    struct hm2_md md;
    bool present;
    rtapi_u32 *busy;
};

struct absenc {
    struct module module[KINDS];
    struct channel *channel;
    int count;
};

/* ---- Format --------------------------------------------------------------- */

static int field_type(char c)
{
    switch(c) {
    case 'p': return FIELD_PAD;
    case 'b': return FIELD_BOOLEAN;
    case 'u': return FIELD_UNSIGNED;
    case 's': return FIELD_SIGNED;
    case 'f': return FIELD_BITS_EACH;
    case 'e': return FIELD_ENCODER;
    case 'h': return FIELD_ENCODER_H;
    case 'l': return FIELD_ENCODER_L;
    default: return -1;
    }
}

/* One field, name%BITS[g][m]TYPE; what follows it, or NULL with *why. */
static const char *parse_field(const char *p, struct field *f, const char **why)
{
    size_t n = strcspn(p, "%");
    char *end;
    *why = "a field is name%, number of bits, and a letter of p b u s f e h l";
    if(!p[n] || n > FIELD_NAME_LEN) return NULL;
    memcpy(f->name, p, n);
    f->name[n] = 0;
    long bits = strtol(p + n + 1, &end, 10);
    if(end == p + n + 1 || bits < 1 || bits > FIELD_BITS) return NULL;
    for(; *end == 'g' || *end == 'm'; end++) *(*end == 'g' ? &f->gray : &f->no_wrap) = true;
    int type = field_type(*end);
    if(type < 0) return NULL;
    if(!n && type != FIELD_PAD) {
        *why = "a field that is no padding needs a name";
        return NULL;
    }
    f->type = (rtapi_u8)type;
    f->length = (rtapi_u8)bits;
    f->dir = FIELD_IN;
    f->max = 1;
    return end + 1;
}

static int parse_format(struct hm2 *hm2, struct channel *c, const char *format)
{
    char text[HM2_FORMAT_LEN + 1];
    const char *p = text, *why = "there is no room for so many fields";
    int i;
    for(i = 0; format[i]; i++) text[i] = (char)tolower((unsigned char)format[i]);
    text[i] = 0;
    if(c->kind == FANUC && !strcmp(text, "aa64")) p = FANUC_64;
    c->field = hal_malloc((long)sizeof *c->field * MAX_FIELDS);
    if(!c->field) return -ENOMEM;
    while(p && *p) {
        p = c->fields < MAX_FIELDS ? parse_field(p, &c->field[c->fields], &why) : NULL;
        if(p) c->bits += c->field[c->fields++].length;
    }
    if(p && c->bits > MAX_WORDS * 32) why = "it has more than 96 bits";
    if(p && c->bits <= MAX_WORDS * 32) return 0;
    HM2_ERR(hm2, "%s_chan_%d=%s: %s\n", kinds[c->kind].name, c->unit, format, why);
    return -EINVAL;
}

/* ---- Registration --------------------------------------------------------- */

static int export_channel(struct hm2 *hm2, struct channel *c)
{
    static const struct hm2_item items[] = {
        HM2_ITEM(BIT, OUT, channel, data_invalid, "data-invalid", 0),
        HM2_ITEM(U32, RW, channel, timer_number, "timer-number", 0),
        HM2_ITEM(U32, RW, channel, filter, "filter", 15), /* the last: Fanuc only */
    };
    const char *name = kinds[c->kind].name;
    char prefix[HAL_NAME_LEN * 2];
    int i;
    snprintf(prefix, sizeof prefix, "%s.%s.%02d", hm2->io->name, name, c->unit);
    COMP_TRY(hm2_export(hm2, items, HM2_COUNT(items) - (c->kind != FANUC), c, "%s.%02d.", name, c->unit));
    COMP_TRY(hal_param_new_real(hm2->io->comp_id, HAL_RW, &c->frequency_khz, kinds[c->kind].khz, "%s.frequency-khz",
                                prefix));
    for(i = 0; i < c->fields; i++) COMP_TRY(field_export(hm2, &c->field[i], prefix));
    return 0;
}

static int add_regions(struct hm2 *hm2, const struct hm2_md *md, struct channel *c)
{
    int i, words = (c->bits + 31) / 32;
    if(c->kind == FANUC) words = MAX_WORDS;
    if(c->kind == SSI && words > 2) words = 2;
    for(i = 0; i < words; i++) {
        /* BiSS has one register, to be read again and again. */
        c->word[i] = hm2_read_region(hm2, hm2_register_addr(md, c->kind == BISS ? 0 : i, c->unit), 1);
        if(!c->word[i]) return -ENOMEM;
    }
    return 0;
}

static const char *format_of(const struct hm2 *hm2, enum kind kind, int unit)
{
    return kind == SSI ? hm2->config.ssi_format[unit] : kind == BISS ? hm2->config.biss_format[unit]
                                                                     : hm2->config.fanuc_format[unit];
}

/* Pins of channels without a format stay GPIO. */
static void release_pins(struct hm2 *hm2, int gtag, enum kind kind)
{
    int i;
    for(i = 0; i < hm2->pins; i++) {
        struct hm2_pin *pin = &hm2->pin[i];
        if(pin->sec_tag == gtag && !(pin->sec_unit & HM2_UNIT_GLOBAL) &&
           (pin->sec_unit >= HM2_ABSENC_CHANNELS || !format_of(hm2, kind, pin->sec_unit)[0])) pin->sec_tag = 0;
    }
}

static int claim(struct hm2 *hm2, const struct hm2_md *md, void **state)
{
    enum kind kind = md->gtag == HM2_GTAG_SSI ? SSI : md->gtag == HM2_GTAG_BISS ? BISS : FANUC;
    struct absenc *s = *state;
    int unit, used = 0;
    COMP_TRY(hm2_check_md(hm2, md, 0, kinds[kind].registers, 4, kinds[kind].multiple));
    for(unit = 0; unit < HM2_ABSENC_CHANNELS; unit++) {
        if(!format_of(hm2, kind, unit)[0]) continue;
        if(unit >= md->instances) {
            HM2_ERR(hm2, "config string has %s_chan_%d, but the firmware has only %d channels\n", kinds[kind].name,
                    unit,
                    md->instances);
            return -EINVAL;
        }
        used++;
    }
    release_pins(hm2, md->gtag, kind);
    if(!used) return 0;
    if(!s) {
        s = *state = hal_malloc(sizeof *s);
        if(!s || !(s->channel = hal_malloc((long)sizeof *s->channel * HM2_ABSENC_CHANNELS * KINDS))) return -ENOMEM;
    }
    s->module[kind].md = *md;
    s->module[kind].present = true;
    s->module[kind].busy = hm2_read_region(hm2, hm2_register_addr(md, kinds[kind].start, 0), 1);
    if(!s->module[kind].busy) return -ENOMEM;
    for(unit = 0; unit < md->instances && unit < HM2_ABSENC_CHANNELS; unit++) {
        if(!format_of(hm2, kind, unit)[0]) continue;
        struct channel *c = &s->channel[s->count++];
        c->unit = unit;
        c->kind = kind;
        COMP_TRY(parse_format(hm2, c, format_of(hm2, kind, unit)));
        COMP_TRY(export_channel(hm2, c));
        COMP_TRY(add_regions(hm2, md, c));
    }
    hm2->instances[md->gtag] = HM2_ABSENC_CHANNELS;
    return used;
}

/* ---- Cycle ---------------------------------------------------------------- */

/* A fault has to last before it is told, and to stay away before it is over. */
static bool check_data(struct hm2 *hm2, struct channel *c, bool busy, bool cable)
{
    if(!busy && !cable) {
        c->bad = 0;
        if(c->good < GOOD_CYCLES) c->good++;
        else hal_set_bool(c->data_invalid, 0);
        return true;
    }
    c->good = 0;
    if(c->bad < BAD_CYCLES) c->bad++;
    else if(!hal_get_bool(c->data_invalid)) {
        hal_set_bool(c->data_invalid, 1);
        HM2_ERR(hm2, "%s.%02d: %s\n", kinds[c->kind].name, c->unit,
                cable ? "no answer from the encoder: check its cable and supply"
                      : "not ready when it is read: raise its frequency-khz, or trigger it earlier");
    }
    return false;
}

static void process(struct hm2 *hm2, void *state, long period)
{
    struct absenc *s = state;
    int i, k, at;
    (void)period;
    for(i = 0; i < s->count; i++) {
        struct channel *c = &s->channel[i];
        const struct field *low = NULL;
        rtapi_u32 words[MAX_WORDS] = {0};
        bool busy = *s->module[c->kind].busy >> c->unit & 1;
        for(k = 0; k < MAX_WORDS; k++)
            if(c->word[k]) words[k] = *c->word[k];
        if(!check_data(hm2, c, busy, c->kind == FANUC && words[2] & CABLE_FAULT)) continue;
        for(k = 0, at = 0; k < c->fields; at += c->field[k++].length) {
            field_show(&c->field[k], field_extract(words, at, c->field[k].length), low);
            if(c->field[k].type == FIELD_ENCODER_L) low = &c->field[k];
        }
    }
}

static void write_channel(struct hm2 *hm2, struct absenc *s, struct channel *c, bool force)
{
    const struct hm2_md *md = &s->module[c->kind].md;
    rtapi_u32 timer = hal_get_ui32(c->timer_number), now[3];
    double khz = hal_get_real(c->frequency_khz);
    int i, controls = c->kind == SSI ? 1 : c->kind == BISS ? 2 : 3;
    if(timer > MAX_TIMER) timer = hal_set_ui32(c->timer_number, 0);
    rtapi_u32 start = timer << 12 | (timer ? BY_TIMER : BY_TRIGGER);
    rtapi_u32 dds = (rtapi_u32)hm2_clip(65536.0 * khz * 1000 / md->clock, 1, 65535);
    if(c->kind == SSI)
        now[0] = dds << 16 | start | (rtapi_u32)c->bits;
    else if(c->kind == BISS) {
        rtapi_u32 filter = 0x8000 / dds;
        now[0] = dds << 16 | (filter > 63 ? 63 : filter) << 10 | (rtapi_u32)c->bits;
        now[1] = start;
    } else {
        rtapi_u32 filter = hal_get_ui32(c->filter) > 15 ? hal_set_ui32(c->filter, 15) : hal_get_ui32(c->filter);
        now[0] = start;
        now[1] = filter << 28 | (rtapi_u32)hm2_clip(1048576.0 * khz * 1000 / md->clock, 0, 0xFFFFFFF);
        now[2] = (rtapi_u32)c->bits << 24 | (rtapi_u32)(8e-6 * md->clock) << 14;
    }
    for(i = 0; i < controls; i++) {
        /* The third control register of Fanuc is the write side of the third data register. */
        int reg = i < 2 ? kinds[c->kind].control + i : 2;
        hm2_write_changed(hm2, hm2_register_addr(md, reg, c->unit), now[i], &c->control[i], force);
    }
}

static void write_settings(struct hm2 *hm2, void *state, bool force)
{
    struct absenc *s = state;
    int i;
    for(i = 0; i < s->count; i++) write_channel(hm2, s, &s->channel[i], force);
}

const struct hm2_function_ops hm2_absenc = {
    .gtag = {HM2_GTAG_SSI, HM2_GTAG_BISS, HM2_GTAG_FABS},
    .claim = claim,
    .process = process,
    .write = write_settings,
};

bool hm2_absenc_used(struct hm2 *hm2)
{
    return hm2_state(hm2, &hm2_absenc) != NULL;
}

void hm2_absenc_trigger(struct hm2 *hm2)
{
    struct absenc *s = hm2_state(hm2, &hm2_absenc);
    int k;
    for(k = 0; s && k < KINDS; k++)
        if(s->module[k].present)
            hm2_queue_write(hm2, hm2_register_addr(&s->module[k].md, kinds[k].start, 0), 0xFFFFFFFFu);
    if(hm2->io->ops->send_queued_writes) hm2->io->ops->send_queued_writes(hm2->io);
}
