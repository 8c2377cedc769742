/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * emcmotutil.c - error ring and command lock of the motion segment.
 *
 * In, out: emcmotutil.h   Thread: any; built for realtime and for user space
 * Method:  ring with a turn counter per slot (Vyukov's bounded queue). A slot holds
 *          the format, a zero byte, then one value per conversion: 8 bytes for
 *          numbers, the text with its zero byte for %s.
 */
#include <errno.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#ifdef ULAPI
#include <signal.h>
#endif
#include "emcmotutil.h"

void emcmotErrorInit(emcmot_error_t *err)
{
    memset(err, 0, sizeof(*err));
    for (unsigned int i = 0; i < EMCMOT_ERROR_NUM; i++)
        err->slot[i].turn = i;
}

/* ---- formats ---- */

enum conversion_kind {
    CONV_NONE,
    CONV_INT,
    CONV_LONG,
    CONV_LONGLONG,
    CONV_DOUBLE,
    CONV_STRING,
    CONV_PERCENT,
    CONV_BAD
};

struct conversion {
    const char *begin, *end; /* from '%' to behind the letter */
    enum conversion_kind kind;
    int stars;               /* '*' widths and precisions, ints before the value */
};

/* Finds the next conversion in *fmt and moves *fmt behind it. */
static struct conversion next_conversion(const char **fmt)
{
    struct conversion c = {NULL, NULL, CONV_NONE, 0};
    const char *p = strchr(*fmt, '%');
    int longs = 0;
    if (!p)
        return c;
    c.begin = p++;
    while (*p && strchr("-+ #0123456789.*", *p)) {
        c.stars += *p == '*';
        p++;
    }
    for (; *p && strchr("lhzjt", *p); p++)
        longs += *p == 'l' ? 1 : (*p == 'z' || *p == 'j' || *p == 't') ? 2 : 0;
    switch (*p) {
    case 'd': case 'i': case 'u': case 'x': case 'X': case 'o': case 'c':
        c.kind = longs == 0 ? CONV_INT : longs == 1 ? CONV_LONG : CONV_LONGLONG;
        break;
    case 'p':
        c.kind = CONV_LONG;
        break;
    case 'f': case 'F': case 'e': case 'E': case 'g': case 'G': case 'a': case 'A':
        c.kind = CONV_DOUBLE;
        break;
    case 's':
        c.kind = CONV_STRING;
        break;
    case '%':
        c.kind = CONV_PERCENT;
        break;
    default:
        c.kind = CONV_BAD;
        c.end = p;
        return c;
    }
    c.end = p + 1;
    *fmt = c.end;
    return c;
}

static char *put_bytes(char *at, const char *end, const void *bytes, size_t n)
{
    if (!at || n > (size_t)(end - at))
        return NULL;
    memcpy(at, bytes, n);
    return at + n;
}

/* Stores format and arguments. Returns 0, -1 when the format is not understood.
 * What does not fit is left out: a format is cut, arguments behind the end read as 0. */
static int serialise(char *data, const char *fmt, va_list ap)
{
    const char *end = data + EMCMOT_ERROR_LEN, *scan = fmt;
    size_t n = strnlen(fmt, EMCMOT_ERROR_LEN / 2 - 1);
    char *at = data + n + 1;
    memset(data, 0, EMCMOT_ERROR_LEN);
    memcpy(data, fmt, n);
    for (;;) {
        struct conversion c = next_conversion(&scan);
        int64_t i;
        double d;
        const char *s;
        if (c.kind == CONV_NONE)
            return 0;
        if (c.kind == CONV_BAD)
            return -1;
        for (int k = 0; k < c.stars; k++) {
            i = va_arg(ap, int);
            at = put_bytes(at, end, &i, 8);
        }
        switch (c.kind) {
        case CONV_INT:
            i = va_arg(ap, int);
            at = put_bytes(at, end, &i, 8);
            break;
        case CONV_LONG:
            i = va_arg(ap, long);
            at = put_bytes(at, end, &i, 8);
            break;
        case CONV_LONGLONG:
            i = va_arg(ap, long long);
            at = put_bytes(at, end, &i, 8);
            break;
        case CONV_DOUBLE:
            d = va_arg(ap, double);
            at = put_bytes(at, end, &d, 8);
            break;
        case CONV_STRING: {
            s = va_arg(ap, const char *);
            if (!s)
                s = "(null)";
            size_t len = at ? strnlen(s, (size_t)(end - at)) : 0;
            if (at && len == (size_t)(end - at) && len)
                len--;
            char *next = put_bytes(at, end, s, len);
            at = put_bytes(next, end, "", 1);
            break;
        }
        default:
            break;
        }
    }
}

int emcmotErrorPutfv(emcmot_error_t *err, const char *fmt, va_list ap)
{
    unsigned int at = __atomic_load_n(&err->put, __ATOMIC_RELAXED);
    emcmot_error_slot_t *slot;
    for (int tries = 0;; tries++) {
        slot = &err->slot[at % EMCMOT_ERROR_NUM];
        unsigned int turn = __atomic_load_n(&slot->turn, __ATOMIC_ACQUIRE);
        if (turn == at) {
            if (__atomic_compare_exchange_n(&err->put, &at, at + 1, 0, __ATOMIC_RELAXED, __ATOMIC_RELAXED))
                break;
        } else if ((int)(turn - at) < 0 || tries > EMCMOT_ERROR_NUM) {
            __atomic_fetch_add(&err->dropped, 1, __ATOMIC_RELAXED);
            return -1; /* full */
        } else {
            at = __atomic_load_n(&err->put, __ATOMIC_RELAXED);
        }
    }
    int r = serialise(slot->data, fmt, ap);
    __atomic_store_n(&slot->turn, at + 1, __ATOMIC_RELEASE);
    return r;
}

int emcmotErrorPut(emcmot_error_t *err, const char *fmt, ...)
{
    va_list ap;
    va_start(ap, fmt);
    int r = emcmotErrorPutfv(err, fmt, ap);
    va_end(ap);
    return r;
}

static int64_t get_int(const char **at, const char *end)
{
    int64_t i = 0;
    if ((size_t)(end - *at) >= 8) {
        memcpy(&i, *at, 8);
        *at += 8;
    } else {
        *at = end;
    }
    return i;
}

static void append(char *text, size_t size, size_t *len, const char *bytes, size_t n)
{
    if (*len + 1 >= size)
        return;
    if (n > size - 1 - *len)
        n = size - 1 - *len;
    memcpy(text + *len, bytes, n);
    *len += n;
    text[*len] = 0;
}

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
static void format_one(char *out, size_t size, const struct conversion *c, const char **at, const char *end)
{
    char spec[64], letter = c->end[-1];
    size_t n = 0;
    int width[2] = {0, 0};
    for (int k = 0; k < c->stars; k++) {
        int v = (int)get_int(at, end);
        if (k < 2)
            width[k] = v;
    }
    /* the flags as they stand, stars replaced by their numbers, lengths dropped */
    int star = 0;
    for (const char *p = c->begin; p < c->end - 1 && n < sizeof(spec) - 24; p++) {
        if (*p == '*')
            n += (size_t)snprintf(spec + n, 12, "%d", width[star < 1 ? star++ : 1]);
        else if (!strchr("lhzjt", *p))
            spec[n++] = *p;
    }
    switch (c->kind) {
    case CONV_STRING: {
        const char *s = *at < end ? *at : "";
        size_t len = strnlen(s, (size_t)(end - *at));
        *at += len < (size_t)(end - *at) ? len + 1 : len;
        spec[n++] = 's';
        spec[n] = 0;
        snprintf(out, size, spec, s);
        break;
    }
    case CONV_DOUBLE: {
        double d = 0;
        int64_t bits = get_int(at, end);
        memcpy(&d, &bits, 8);
        spec[n++] = letter;
        spec[n] = 0;
        snprintf(out, size, spec, d);
        break;
    }
    default: {
        int64_t i = get_int(at, end);
        if (letter == 'c' || (c->kind == CONV_INT && letter != 'p')) {
            spec[n++] = letter;
            spec[n] = 0;
            snprintf(out, size, spec, (int)i);
        } else {
            if (letter == 'p') {
                spec[n++] = '#';
                letter = 'x';
            }
            spec[n++] = 'l';
            spec[n++] = 'l';
            spec[n++] = letter;
            spec[n] = 0;
            snprintf(out, size, spec, (long long)i);
        }
        break;
    }
    }
}
#pragma GCC diagnostic pop

static void deserialise(const char *data, char *text, size_t size)
{
    const char *end = data + EMCMOT_ERROR_LEN, *fmt = data, *at = data + strnlen(data, EMCMOT_ERROR_LEN - 1) + 1;
    size_t len = 0;
    text[0] = 0;
    for (;;) {
        const char *from = fmt;
        struct conversion c = next_conversion(&fmt);
        if (c.kind == CONV_NONE || c.kind == CONV_BAD) {
            append(text, size, &len, from, strlen(from));
            return;
        }
        append(text, size, &len, from, (size_t)(c.begin - from));
        if (c.kind == CONV_PERCENT) {
            append(text, size, &len, "%", 1);
            continue;
        }
        char one[EMCMOT_ERROR_LEN];
        format_one(one, sizeof(one), &c, &at, end);
        append(text, size, &len, one, strlen(one));
    }
}

int emcmotErrorGet(emcmot_error_t *err, char *text, int size)
{
    unsigned int at = err->get;
    emcmot_error_slot_t *slot = &err->slot[at % EMCMOT_ERROR_NUM];
    char data[EMCMOT_ERROR_LEN];
    if (size < 1 || __atomic_load_n(&slot->turn, __ATOMIC_ACQUIRE) != at + 1)
        return -1;
    memcpy(data, slot->data, sizeof(data));
    data[sizeof(data) - 1] = 0;
    err->get = at + 1;
    __atomic_store_n(&slot->turn, at + EMCMOT_ERROR_NUM, __ATOMIC_RELEASE);
    deserialise(data, text, (size_t)size);
    return 0;
}

/* ---- command lock ---- */

int emcmotCommandTryLock(emcmot_struct_t *shared)
{
    int free_ = 0;
    return __atomic_compare_exchange_n(&shared->command_mutex, &free_, -1, 0, __ATOMIC_ACQUIRE, __ATOMIC_RELAXED);
}

int emcmotCommandTryLockUser(emcmot_struct_t *shared, int pid)
{
    int holder = 0;
    if (__atomic_compare_exchange_n(&shared->command_mutex, &holder, pid, 0, __ATOMIC_ACQUIRE, __ATOMIC_RELAXED))
        return 1;
#ifdef ULAPI
    if (holder > 0 && holder != pid && kill(holder, 0) != 0 && errno == ESRCH)
        return __atomic_compare_exchange_n(&shared->command_mutex, &holder, pid, 0, __ATOMIC_ACQUIRE, __ATOMIC_RELAXED);
#endif
    return 0;
}

void emcmotCommandUnlock(emcmot_struct_t *shared)
{
    __atomic_store_n(&shared->command_mutex, 0, __ATOMIC_RELEASE);
}
