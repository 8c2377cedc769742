/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hm2_modbus_file.c - .mbccb files, as mesambccc writes them: a header, records of 32 bytes, and a
 * segment of data that they point into. All numbers are big-endian. [init]
 */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include "hm2_modbus.h"

#define HEADER 64
#define RECORD 32
#define MAX_FILE (1 << 20)

struct reader {
    const char *path;
    rtapi_u8 *data;
    long size;
    const rtapi_u8 *segment;
    rtapi_u32 segment_len;
};

static int fault(const struct reader *r, const char *what)
{
    rtapi_print_msg(RTAPI_MSG_ERR, "hm2_modbus: %s: %s; write it anew with mesambccc\n", r->path, what);
    return -EINVAL;
}

static rtapi_u16 get16(const rtapi_u8 *p)
{
    return (rtapi_u16)(p[0] << 8 | p[1]);
}

static rtapi_u32 get32(const rtapi_u8 *p)
{
    return (rtapi_u32)get16(p) << 16 | get16(p + 2);
}

static int load(struct reader *r)
{
    FILE *f = fopen(r->path, "rbe");
    if(!f) {
        rtapi_print_msg(RTAPI_MSG_ERR, "hm2_modbus: cannot read %s: %s\n", r->path, strerror(errno));
        return -ENOENT;
    }
    r->data = malloc(MAX_FILE);
    r->size = r->data ? (long)fread(r->data, 1, MAX_FILE, f) : 0;
    fclose(f);
    return r->data ? 0 : -ENOMEM;
}

/* A fragment: its length, then so many bytes. NULL: it ends behind the segment. */
static const rtapi_u8 *fragment(const struct reader *r, rtapi_u32 at, int *length)
{
    if(at >= r->segment_len || at + 1 + r->segment[at] > r->segment_len) return NULL;
    *length = r->segment[at];
    return r->segment + at + 1;
}

static int read_name(const struct reader *r, rtapi_u32 *at, char name[MB_NAME_LEN + 1])
{
    int n, i;
    const rtapi_u8 *text = fragment(r, *at, &n);
    if(!text || n < 2 || n > MB_NAME_LEN + 1 || text[n - 1]) return fault(r, "a pin's name is damaged");
    for(i = 0; i < n - 1; i++)
        if(!strchr("abcdefghijklmnopqrstuvwxyz0123456789.-", text[i]) || !text[i])
            return fault(r, "a pin's name has characters other than a-z 0-9 . -");
    memcpy(name, text, (size_t)n);
    *at += 1 + (rtapi_u32)n;
    return 0;
}

static int read_pins(const struct reader *r, const rtapi_u8 *record, struct mb_command *c)
{
    rtapi_u32 types = get32(record + 16) + 1, names = get32(record + 28);
    int i;
    c->pins = get16(record + 6);
    if(!c->pins) return 0;
    if(types + 4 * (rtapi_u32)c->pins > r->segment_len) return fault(r, "a list of types is damaged");
    c->pin = hal_malloc((long)sizeof *c->pin * c->pins);
    if(!c->pin) return -ENOMEM;
    for(i = 0; i < c->pins; i++) {
        struct mb_pin *p = &c->pin[i];
        const rtapi_u8 *type = r->segment + types + 4 * i;
        p->mtype = type[0];
        p->htype = type[1];
        p->flags = type[2];
        p->at = type[3];
        int wide = mb_is_bits(c->func) ? 1 : mb_type_registers(p->mtype);
        if(!wide || p->at + wide > c->count || !strchr("\1\2\3\4\6\7", p->htype) || !p->htype)
            return fault(r, "a pin has a wrong type");
        int result = read_name(r, &names, p->name);
        if(result < 0) return result;
    }
    return 0;
}

static int read_record(const struct reader *r, const rtapi_u8 *p, struct mb_command *c, bool init)
{
    int n;
    c->mbid = p[0];
    c->func = p[1];
    c->flags = get16(p + 2);
    c->addr = get16(p + 4);
    c->count = get16(p + 8);
    c->interval_us = get32(p + 20);
    c->timeout_us = get32(p + 24);
    if(!c->func) { /* a pause, or other settings */
        c->delays[0] = get16(p + 6);
        c->delays[1] = get16(p + 8);
        c->drive_delay = get16(p + 10);
        return 0;
    }
    if(c->mbid > 247) return fault(r, "a device has an address above 247");
    if(init) {
        const rtapi_u8 *frame = fragment(r, get32(p + 28), &n);
        if(!frame || n < 4) return fault(r, "a frame of the init list is damaged");
        memcpy(c->fixed, frame, (size_t)n);
        c->fixed_len = n;
        return 0;
    }
    if(!mb_is_read(c->func) && !strchr("\5\6\17\20", c->func)) return fault(r, "a command has an unknown function");
    if(!c->count || c->count > (mb_is_bits(c->func) ? 1968 : 123)) return fault(r, "a command has a wrong count");
    return read_pins(r, p, c);
}

static int read_list(const struct reader *r, const rtapi_u8 *p, rtapi_u32 length, bool init, struct mb_command **list,
                     int *n)
{
    int i;
    *n = (int)(length / RECORD);
    if(*n > MB_MAX_COMMANDS) return fault(r, "there are more than 100 commands");
    if(!*n) return 0;
    *list = hal_malloc((long)sizeof **list * *n);
    if(!*list) return -ENOMEM;
    for(i = 0; i < *n; i++) {
        int result = read_record(r, p + i * RECORD, &(*list)[i], init);
        if(result < 0) return result;
    }
    return 0;
}

static int parse(struct reader *r, struct mb_file *file)
{
    const rtapi_u8 *p = r->data;
    if(r->size < HEADER || memcmp(p, "MesaMB01", 8)) return fault(r, "it is no .mbccb file");
    rtapi_u32 init = get32(p + 52), commands = get32(p + 56), data = get32(p + 60);
    if(init % RECORD || commands % RECORD || !commands || !data || init > MAX_FILE || commands > MAX_FILE ||
       r->size != HEADER + (long)init + (long)commands + (long)data) return fault(r, "its lengths do not fit");
    file->baud = get32(p + 8);
    file->format = get16(p + 12);
    file->tx_delay = get16(p + 14);
    file->rx_delay = get16(p + 16);
    file->drive_delay = get16(p + 18);
    file->ic_delay = get16(p + 20);
    if(file->baud < 1200 || file->baud > 1000000) return fault(r, "its bit rate is not 1200 to 1000000");
    r->segment = p + HEADER + init + commands;
    r->segment_len = data;
    int result = read_list(r, p + HEADER, init, true, &file->init, &file->inits);
    return result < 0 ? result : read_list(r, p + HEADER + init, commands, false, &file->command, &file->commands);
}

int mb_file_read(const char *path, struct mb_file *file)
{
    struct reader r = {.path = path};
    int result = load(&r);
    if(result == 0) result = parse(&r, file);
    free(r.data);
    return result;
}
