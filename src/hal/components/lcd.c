/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * lcd.c - pages of text and values for a character display, sent byte by byte.
 *
 * In:     fmt_strings="page|page" at load time; values, page number, contrast
 * Out:    one byte per call, 0 when there is none
 * Thread: lcd [servo]; one byte of one format per call and display
 */
#include <rtapi.h>
#include <rtapi_app.h>
#include <rtapi_ctype.h>
#include <rtapi_math.h>
#include <rtapi_string.h>
#include <hal.h>
#include "components/comp_util.h"
#include "components/real_to_int.h"

MODULE_LICENSE("GPL");
MODULE_AUTHOR("Kerf developers");
MODULE_DESCRIPTION("Character display");

#define MAX_DISPLAYS 16
#define MAX_PAGES 100
#define MAX_WIDTH 20
#define START_DELAY 100                 /* calls */
#define QUEUE 32

static char *fmt_strings[MAX_DISPLAYS];
RTAPI_MP_ARRAY_STRING(fmt_strings, MAX_DISPLAYS, "pages of each display, separated by |");

/* A value in a page. */
struct format {
    char type;                          /* f d u x o c b, or % */
    char plus, zero;
    int width, precision;               /* 0 and -1: not given */
    unsigned char when_true, when_false;
    hal_refs_u pin;
};

/* A page: bytes, and where a byte is 0x100 + n the n-th format. */
struct page {
    int length, formats;
    unsigned short *item;
    struct format *format;
};

struct display {
    int pages, page, place, delay;      /* page: -1 until one is shown */
    struct page *content;
    unsigned char queue[QUEUE];         /* bytes that are to be sent first */
    int queued, sent;
    double last_contrast;
    hal_uint_t out, page_num, decimal_separator;
    hal_real_t contrast;
};

static int comp_id, displays;
static struct display *display[MAX_DISPLAYS];

/* ---- [servo] ------------------------------------------------------------- */

static void enqueue(struct display *d, const unsigned char *bytes, int n)
{
    if(d->sent == d->queued) d->sent = d->queued = 0;
    for(; n > 0 && d->queued < QUEUE; n--) d->queue[d->queued++] = *bytes++;
}

/* Digits of a number, most significant first; returns how many. */
static int digits_of(rtapi_u64 number, unsigned base, char *buf)
{
    char reversed[24];
    int n = 0, i;
    do {
        unsigned digit = (unsigned)(number % base);
        reversed[n++] = (char)(digit < 10 ? '0' + digit : 'A' + digit - 10);
        number /= base;
    } while(number);
    for(i = 0; i < n; i++) buf[i] = reversed[n - 1 - i];
    return n;
}

/* Places sign and digits in a field. One that is too small keeps its first place, of a number
 * the sign alone, and is filled with stars. */
static void put_field(struct display *d, const struct format *f, int negative, const char *digits, int n)
{
    unsigned char field[MAX_WIDTH];
    char sign = negative ? '-' : f->plus ? '+' : 0;
    int length = n + (sign != 0), at = 0, i;
    /* A float keeps the place of its point even without decimals. */
    int width = f->width ? f->width : length + (f->type == 'f' && f->precision == 0);
    if(width > MAX_WIDTH) width = MAX_WIDTH;
    if(length > width) {
        for(i = 0; i < width; i++) field[i] = '*';
        if(sign) field[0] = (unsigned char)sign;
        else if(f->type == 'f') field[0] = (unsigned char)digits[n - width];
    } else {
        int pad = width - length;
        if(f->zero && sign) field[at++] = (unsigned char)sign;
        for(i = 0; i < pad; i++) field[at++] = f->zero ? '0' : ' ';
        if(!f->zero && sign) field[at++] = (unsigned char)sign;
        for(i = 0; i < n; i++) field[at++] = (unsigned char)digits[i];
    }
    enqueue(d, field, width);
}

static void put_float(struct display *d, const struct format *f)
{
    char digits[64];
    double value = hal_get_real(f->pin.r), scaled, size = fabs(value);
    int precision = f->precision < 0 ? 4 : f->precision > 15 ? 15 : f->precision, n, i;
    rtapi_u64 number, unit = 1;
    for(i = 0; i < precision; i++) unit *= 10;
    scaled = size * (double)unit + 0.5;
    number = scaled < 1.8e19 ? (rtapi_u64)scaled : RTAPI_UINT64_MAX;
    n = digits_of(number / unit, 10, digits);
    if(precision) {
        digits[n++] = (char)hal_get_ui32(d->decimal_separator);
        for(i = 0; i < precision; i++) {
            unit /= 10;
            digits[n++] = (char)('0' + number / unit % 10);
        }
    }
    put_field(d, f, value < 0 && number != 0, digits, n);
}

static void put_char(struct display *d, const struct format *f)
{
    unsigned code = hal_get_ui32(f->pin.u) & 0xFF;
    unsigned char field[MAX_WIDTH];
    int i, width = f->width > MAX_WIDTH ? MAX_WIDTH : f->width;
    for(i = 0; i < width; i++) field[i] = (unsigned char)(code > ' ' ? code : ' ');
    enqueue(d, field, width);
}

static void put_format(struct display *d, const struct format *f)
{
    char digits[32];
    unsigned char byte;
    switch(f->type) {
    case 'f':
        put_float(d, f);
        break;
    case 'd': {
        rtapi_s64 value = hal_get_si32(f->pin.s);
        put_field(d, f, value < 0, digits, digits_of((rtapi_u64)(value < 0 ? -value : value), 10, digits));
        break;
    }
    case 'u':
        put_field(d, f, 0, digits, digits_of(hal_get_ui32(f->pin.u), 10, digits));
        break;
    case 'x':
    case 'X':
        put_field(d, f, 0, digits, digits_of(hal_get_ui32(f->pin.u), 16, digits));
        break;
    case 'o':
        put_field(d, f, 0, digits, digits_of(hal_get_ui32(f->pin.u), 8, digits));
        break;
    case 'c':
        put_char(d, f);
        break;
    case 'b':
        byte = hal_get_bool(f->pin.b) ? f->when_true : f->when_false;
        enqueue(d, &byte, 1);
        break;
    default:
        byte = '%';
        enqueue(d, &byte, 1);
    }
}

/* Looks for a changed page or contrast. */
static void watch(struct display *d)
{
    static const unsigned char new_page[] = { 0x11, 0x1E, 0x1A };
    rtapi_u32 wanted = hal_get_ui32(d->page_num);
    double contrast = hal_get_real(d->contrast);
    int page = wanted < (rtapi_u32)d->pages ? (int)wanted : d->page < 0 ? 0 : d->page;
    if(page != d->page) {
        d->page = page;
        d->place = 0;
        enqueue(d, new_page, sizeof new_page);
    }
    if(contrast != d->last_contrast && !isnan(contrast)) {
        double level = 0x20 + 159 * contrast;
        unsigned char set[3] = { 0x1B, 'C', (unsigned char)(level < 0x20 ? 0x20 : level > 0xBF ? 0xBF : level) };
        d->last_contrast = contrast;
        enqueue(d, set, sizeof set);
    }
}

static rtapi_u32 next_byte(struct display *d)
{
    /* After the 0 that ends the page. */
    static const unsigned char home[] = { 0, 0x1B, 0x3D, 0x20, 0x20 };
    const struct page *p;
    if(d->sent == d->queued) watch(d);
    if(d->sent == d->queued) {
        p = &d->content[d->page];
        if(d->place >= p->length) {
            d->place = 0;
            enqueue(d, home, sizeof home);
        } else if(p->item[d->place] < 0x100) {
            return p->item[d->place++];
        } else {
            put_format(d, &p->format[p->item[d->place++] - 0x100]);
        }
    }
    return d->sent < d->queued ? d->queue[d->sent++] : 0;
}

/* HAL function lcd. */
static void lcd(void *arg, long period)
{
    static const unsigned char start[] = { 0x0D, 0x0A, 0x18, 0x0D, 0x0A, 0x18, 0x0D, 0x0A, 0x18, 0x0D, 0x0A, 0x18,
                                           0x11 };
    int i;
    (void)arg;
    (void)period;
    for(i = 0; i < displays; i++) {
        struct display *d = display[i];
        if(d->delay > 0) {
            if(--d->delay == 0) enqueue(d, start, sizeof start);
            continue;
        }
        hal_set_ui32(d->out, next_byte(d));
    }
}

/* ---- [init] -------------------------------------------------------------- */

static int hex_digit(char c)
{
    return isdigit((unsigned char)c) ? c - '0' : isxdigit((unsigned char)c) ? tolower((unsigned char)c) - 'a' + 10 : -1;
}

/* A character that may be written \HH; moves *at behind it. */
static unsigned char one_char(const char **at)
{
    const char *text = *at;
    int high, low;
    if(*text == 0) return 0;
    if(*text != '\\') {
        *at += 1;
        return (unsigned char)*text;
    }
    if(!text[1] || !text[2]) {
        *at += strlen(text);
        return 0;
    }
    *at += 3;
    high = hex_digit(text[1]);
    low = hex_digit(text[2]);
    return high < 0 || low < 0 ? 0 : (unsigned char)(high * 16 + low);
}

static void add_bytes(struct page *p, const char *bytes)
{
    for(; *bytes; bytes++) p->item[p->length++] = (unsigned char)*bytes;
}

static void add_escape(struct page *p, const char **at)
{
    char c = (char)tolower((unsigned char)(*at)[1]);
    if(c == 'n') {
        add_bytes(p, "\x18\x0A\x0D");
        *at += 2;
    } else if(c == 't') {
        add_bytes(p, "    ");
        *at += 2;
    } else {
        p->item[p->length++] = one_char(at);
    }
}

static int make_pin(struct format *f, int n, int page, int arg)
{
#define MAKE(kind, member) \
    hal_pin_new_##kind(comp_id, HAL_IN, &f->pin.member, 0, "lcd.%02d.page.%02d.arg.%02d", n, page, arg)
    switch(f->type) {
    case 'f': return MAKE(real, r);
    case 'd': return MAKE(si32, s);
    case 'b': return MAKE(bool, b);
    case '%': return 0;
    default: return MAKE(ui32, u);
    }
#undef MAKE
}

static int add_format(struct page *p, const char **at, int n, int page)
{
    struct format *f = &p->format[p->formats];
    const char *text = *at + 1;
    f->precision = -1;
    for(; *text && strchr(" 0+-#", *text); text++) {
        if(*text == '0') f->zero = 1;
        if(*text == '+') f->plus = 1;
    }
    for(; isdigit((unsigned char)*text); text++) if(f->width < 1000) f->width = f->width * 10 + (*text - '0');
    if(*text == '.')
        for(text++, f->precision = 0; isdigit((unsigned char)*text); text++)
            if(f->precision < 1000) f->precision = f->precision * 10 + (*text - '0');
    while(*text == 'l' || *text == 'h') text++;
    f->type = *text;
    if(f->type == 'F') f->type = 'f';
    if(f->type == 'i') f->type = 'd';
    if(!f->type || !strchr("fduxXocb%", f->type)) {
        rtapi_print_msg(RTAPI_MSG_ERR, "lcd: display %d, page %d: bad format at \"%s\"\n", n, page, *at);
        return -EINVAL;
    }
    text++;
    if(f->type == 'b') {
        f->when_true = one_char(&text);
        f->when_false = one_char(&text);
    }
    *at = text;
    p->item[p->length++] = (unsigned short)(0x100 + p->formats);
    return make_pin(f, n, page, p->formats++);
}

/* Reads a page up to | or the end; moves *at there. */
static int export_page(struct page *p, const char **at, int n, int page)
{
    size_t length = strcspn(*at, "|");
    const char *end = *at + length;
    p->item = hal_malloc((long)(sizeof *p->item * (length * 4 + 1)));
    p->format = hal_malloc((long)(sizeof *p->format * (length / 2 + 1)));
    if(!p->item || !p->format) return -ENOMEM;
    while(*at < end) {
        if(**at == '\\') add_escape(p, at);
        else if(**at == '%') COMP_TRY(add_format(p, at, n, page));
        else p->item[p->length++] = (unsigned char)*(*at)++;
    }
    return 0;
}

static int export_display(int n)
{
    const char *at = fmt_strings[n];
    int i;
    struct display *d = hal_malloc(sizeof *d);
    if(!d) return -ENOMEM;
    d->pages = 1;
    for(i = 0; at[i]; i++) d->pages += at[i] == '|';
    if(d->pages > MAX_PAGES) {
        rtapi_print_msg(RTAPI_MSG_ERR, "lcd: display %d: %d pages, at most %d\n", n, d->pages, MAX_PAGES);
        return -EINVAL;
    }
    d->delay = START_DELAY;
    d->page = -1;
    d->content = hal_malloc((long)sizeof *d->content * d->pages);
    if(!d->content) return -ENOMEM;
    for(i = 0; i < d->pages; i++) {
        COMP_TRY(export_page(&d->content[i], &at, n, i));
        if(*at == '|') at++;
    }
    COMP_TRY(hal_pin_new_ui32(comp_id, HAL_OUT, &d->out, 0, "lcd.%02d.out", n));
    COMP_TRY(hal_pin_new_ui32(comp_id, HAL_IN, &d->page_num, 0, "lcd.%02d.page_num", n));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_IN, &d->contrast, 0, "lcd.%02d.contrast", n));
    COMP_TRY(hal_param_new_ui32(comp_id, HAL_RW, &d->decimal_separator, '.', "lcd.%02d.decimal-separator", n));
    display[n] = d;
    return 0;
}

int rtapi_app_main(void)
{
    int r = 0;
    if(!fmt_strings[0]) {
        rtapi_print_msg(RTAPI_MSG_ERR, "The LCD component requires at least one valid format string\n");
        return -EINVAL;
    }
    comp_id = hal_init("lcd");
    if(comp_id < 0) return comp_id;
    for(; r >= 0 && displays < MAX_DISPLAYS && fmt_strings[displays]; displays++) r = export_display(displays);
    if(r >= 0) r = hal_export_funct("lcd", lcd, NULL, 1, 0, comp_id);
    if(r < 0) {
        hal_exit(comp_id);
        return r;
    }
    return hal_ready(comp_id);
}

void rtapi_app_exit(void)
{
    hal_exit(comp_id);
}
