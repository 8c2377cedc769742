/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * sserial_discover.c - which cards are there, and what they say of themselves. [init]
 *
 * In setup mode a card shows its serial number, its name, and where its two tables are: the process
 * table (PTOC) of what moves in each cycle, and the global table (GTOC), whose other entries are
 * parameters. Both are lists of 16-bit pointers to records, ended by 0.
 */
#include <ctype.h>
#include <string.h>
#include <time.h>
#include "sserial.h"

#define SETUP_NS 8000000000LL
#define COMMAND_NS 500000000LL
#define POLL_NS 100000L

#define LOCAL_MAJOR 2
#define LOCAL_MINOR 3
#define LOCAL_START 4
#define LOCAL_STRIDE 5
#define LOCAL_BAUD 42                  /* of a channel, 32 bits */
#define FIRMWARE_WITH_BAUD 33

#define RECORD_DATA 0xA0
#define RECORD_MODE 0xB0
#define RECORD_BYTES 14
#define MAX_RECORDS 128
#define CARD_7I64 0x34364937u
#define CARD_8I20 0x30324938u

/* ---- Commands ------------------------------------------------------------- */

static long long real_time_ns(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return t.tv_sec * 1000000000LL + t.tv_nsec;
}

/* Gives a command to the port and waits for the board to do it. */
static int command(struct hm2 *hm2, struct sserial_port *p, rtapi_u32 value, long long timeout_ns)
{
    static const struct timespec pause = {0, POLL_NS};
    rtapi_u32 busy, addr = sserial_addr(p, SSERIAL_REG_COMMAND, 0);
    long long end = real_time_ns() + timeout_ns;
    if(!hm2_write_now(hm2, addr, value)) return -EIO;
    for(;;) {
        if(!hm2_read_now(hm2, addr, &busy, sizeof busy)) return -EIO;
        if(!busy) return 0;
        if(real_time_ns() > end) break;
        nanosleep(&pause, NULL);
    }
    HM2_ERR(hm2, "smart-serial port %d does not take command 0x%04X\n", p->number, value);
    return -ETIMEDOUT;
}

static int read_local(struct hm2 *hm2, struct sserial_port *p, rtapi_u32 addr, rtapi_u8 *value)
{
    rtapi_u32 data;
    COMP_TRY(command(hm2, p, SSERIAL_READ_LOCAL | addr, COMMAND_NS));
    if(!hm2_read_now(hm2, sserial_addr(p, SSERIAL_REG_DATA, 0), &data, sizeof data)) return -EIO;
    *value = data & 0xFF;
    return 0;
}

static int write_local(struct hm2 *hm2, struct sserial_port *p, rtapi_u32 addr, rtapi_u8 value)
{
    if(!hm2_write_now(hm2, sserial_addr(p, SSERIAL_REG_DATA, 0), value)) return -EIO;
    return command(hm2, p, SSERIAL_WRITE_LOCAL | addr, COMMAND_NS);
}

int sserial_read_remote(struct hm2 *hm2, struct sserial_port *p, int channel, rtapi_u32 addr, void *buffer, int bytes)
{
    rtapi_u8 *to = buffer;
    int i;
    for(i = 0; i < bytes; i++) {
        rtapi_u32 failed, value, what = SSERIAL_READ_BYTE | ((addr + (rtapi_u32)i) & 0xFFFF);
        if(!hm2_write_now(hm2, sserial_addr(p, SSERIAL_REG_CS, channel), what)) return -EIO;
        COMP_TRY(command(hm2, p, SSERIAL_DO_IT | 1u << channel, COMMAND_NS));
        if(!hm2_read_now(hm2, sserial_addr(p, SSERIAL_REG_DATA, 0), &failed, sizeof failed)) return -EIO;
        if(failed & 1u << channel) {
            HM2_ERR(hm2, "smart-serial card at port %d channel %d does not answer: check its cable and supply\n",
                    p->number, channel);
            return -EIO;
        }
        if(!hm2_read_now(hm2, sserial_addr(p, SSERIAL_REG_USER, channel), &value, sizeof value)) return -EIO;
        to[i] = value & 0xFF;
    }
    return 0;
}

/* ---- Tables --------------------------------------------------------------- */

static int read_string(struct hm2 *hm2, struct sserial_port *p, int channel, rtapi_u32 *addr, char *text)
{
    int n = 0;
    for(;;) {
        char c;
        COMP_TRY(sserial_read_remote(hm2, p, channel, (*addr)++, &c, 1));
        if(!c) break;
        if(n < FIELD_NAME_LEN) text[n++] = (char)tolower((unsigned char)c);
        else if(n++ > 4 * FIELD_NAME_LEN) return -EINVAL; /* no end: not a string */
    }
    text[n < FIELD_NAME_LEN ? n : FIELD_NAME_LEN] = 0;
    return 0;
}

static double float_at(const rtapi_u8 *p)
{
    float f;
    memcpy(&f, p, sizeof f);
    return f;
}

/* A data record as a field; name and unit follow it. */
static int read_data_record(struct hm2 *hm2, struct sserial_port *p, int channel, rtapi_u32 addr,
                            const rtapi_u8 *record,
                            struct field *f)
{
    char unit[FIELD_NAME_LEN + 1];
    memset(f, 0, sizeof *f);
    f->length = record[1];
    f->type = record[2];
    f->dir = record[3];
    f->min = float_at(record + 4);
    f->max = float_at(record + 8);
    f->addr = (rtapi_u16)(record[12] | record[13] << 8);
    if(f->length < 1 || f->length > FIELD_BITS) return -EINVAL;
    addr += RECORD_BYTES;
    COMP_TRY(read_string(hm2, p, channel, &addr, unit));
    return read_string(hm2, p, channel, &addr, f->name);
}

static int print_mode_record(struct hm2 *hm2, struct sserial_port *p, struct sserial_remote *r, rtapi_u32 addr,
                             const rtapi_u8 *record)
{
    char name[FIELD_NAME_LEN + 1];
    addr += 4;
    COMP_TRY(read_string(hm2, p, r->channel, &addr, name));
    HM2_PRINT(hm2, "Board %s %s Mode %i = %s\n", r->prefix, record[2] ? "Software" : "Hardware", record[1], name);
    return 0;
}

int sserial_add_field(struct hm2 *hm2, struct sserial_remote *r, const struct field *f)
{
    struct field *to = &r->field[r->fields];
    if(r->fields == SSERIAL_FIELDS) return -EOVERFLOW;
    *to = *f;
    r->fields++;
    return field_export(hm2, to, r->prefix);
}

/* A parameter's current value comes from the card. */
int sserial_add_param(struct hm2 *hm2, struct sserial_remote *r, const struct field *f)
{
    struct sserial_param *q = &r->param[r->params];
    int id = hm2->io->comp_id;
    hal_pdir_t dir = f->dir == FIELD_IN ? HAL_RO : HAL_RW;
    if(r->params == SSERIAL_PARAMS) return -EOVERFLOW;
    q->field = *f;
    r->params++;
    switch(f->type) {
    case FIELD_UNSIGNED: case FIELD_NV_UNSIGNED:
        return hal_param_new_ui32(id, dir, &q->field.value.u, (rtapi_u32)q->written, "%s.%s", r->prefix, f->name);
    case FIELD_SIGNED: case FIELD_NV_SIGNED:
        return hal_param_new_si32(id, dir, &q->field.value.s, (rtapi_s32)q->written, "%s.%s", r->prefix, f->name);
    case FIELD_FLOAT: case FIELD_NV_FLOAT:
        return hal_param_new_real(id, dir, &q->field.value.r, 0, "%s.%s", r->prefix, f->name);
    default: /* nothing that could be set */
        r->params--;
        return 0;
    }
}

static int read_param_value(struct hm2 *hm2, struct sserial_port *p, struct sserial_remote *r, const struct field *f)
{
    rtapi_u64 value = 0;
    int before = r->params;
    COMP_TRY(sserial_read_remote(hm2, p, r->channel, f->addr, &value, (f->length + 7) / 8));
    COMP_TRY(sserial_add_param(hm2, r, f));
    if(r->params == before) return 0;
    struct sserial_param *q = &r->param[before];
    q->written = value;
    switch(f->type) {
    case FIELD_UNSIGNED: case FIELD_NV_UNSIGNED: hal_set_ui32(q->field.value.u, (rtapi_u32)value); break;
    case FIELD_SIGNED: case FIELD_NV_SIGNED: {
        int shift = FIELD_BITS - f->length;
        hal_set_si32(q->field.value.s, (rtapi_s32)((rtapi_s64)(value << shift) >> shift));
        break;
    }
    default: {
        rtapi_u32 word = (rtapi_u32)value;
        float f32;
        memcpy(&f32, &word, sizeof f32);
        hal_set_real(q->field.value.r, f32);
    }
    }
    return 0;
}

static bool in_process_table(const struct sserial_remote *r, rtapi_u16 addr)
{
    int i;
    for(i = 0; i < r->fields; i++)
        if(r->field[i].addr == addr) return true;
    return false;
}

/* One table; global: what the process table does not have becomes parameters. */
static int read_table(struct hm2 *hm2, struct sserial_port *p, struct sserial_remote *r, rtapi_u32 at, bool global)
{
    int i;
    for(i = 0; i < MAX_RECORDS; i++, at += 2) {
        rtapi_u8 pointer[2], record[RECORD_BYTES];
        COMP_TRY(sserial_read_remote(hm2, p, r->channel, at, pointer, 2));
        rtapi_u32 addr = pointer[0] | (rtapi_u32)pointer[1] << 8;
        if(!addr) return 0;
        COMP_TRY(sserial_read_remote(hm2, p, r->channel, addr, record, 4));
        if(record[0] == RECORD_MODE) {
            if(global) COMP_TRY(print_mode_record(hm2, p, r, addr, record));
            continue;
        }
        if(record[0] != RECORD_DATA) continue;
        struct field f;
        COMP_TRY(sserial_read_remote(hm2, p, r->channel, addr + 4, record + 4, RECORD_BYTES - 4));
        COMP_TRY(read_data_record(hm2, p, r->channel, addr, record, &f));
        if(!global) {
            if(f.min == f.max) f.min = 0, f.max = 1;
            COMP_TRY(sserial_add_field(hm2, r, &f));
        } else if(!in_process_table(r, f.addr))
            COMP_TRY(read_param_value(hm2, p, r, &f));
    }
    return -EINVAL;
}

/* ---- Cards ---------------------------------------------------------------- */

static void name_remote(struct hm2 *hm2, struct sserial_port *p, struct sserial_remote *r)
{
    int i;
    for(i = 0; i < 4; i++) {
        char c = (char)(r->name_word >> 8 * i & 0xFF);
        r->card[i] = isprint((unsigned char)c) ? c : '?';
    }
    r->card[1] = (char)tolower((unsigned char)r->card[1]);
    if(hm2_use_serial_numbers) snprintf(r->prefix, sizeof r->prefix, "hm2_%s.%04x", r->card, r->serial & 0xFFFF);
    else
        snprintf(r->prefix, sizeof r->prefix, "%.40s.%s.%d.%d", hm2->io->name, r->card, p->number, r->channel);
}

/* How many words its fields take, each way. */
static int count_words(struct hm2 *hm2, struct sserial_remote *r)
{
    int i, in = 0, out = 0;
    for(i = 0; i < r->fields; i++) {
        if(r->field[i].dir != FIELD_OUT) in += r->field[i].length;
        if(r->field[i].dir != FIELD_IN) out += r->field[i].length;
    }
    r->words_in = (in + 31) / 32;
    r->words_out = (out + 31) / 32;
    if(r->words_in <= SSERIAL_WORDS && r->words_out <= SSERIAL_WORDS) return 0;
    HM2_ERR(hm2, "%s has more data than a channel can move\n", r->prefix);
    return -EOVERFLOW;
}

static int meet(struct hm2 *hm2, struct sserial_port *p, int channel, int mode)
{
    rtapi_u32 word[3];
    int i;
    for(i = 0; i < 3; i++)
        if(!hm2_read_now(hm2, sserial_addr(p, SSERIAL_REG_USER + i, channel), &word[i], sizeof word[i])) return -EIO;
    if(!(word[2] & 0xFFFF) && word[1] != CARD_7I64 && word[1] != CARD_8I20) {
        p->mask &= ~(1u << channel);
        return 0;
    }
    struct sserial_remote *r = p->remote[channel] = hal_malloc(sizeof *r);
    if(!r) return -ENOMEM;
    r->channel = channel;
    r->mode = mode;
    r->serial = word[0];
    r->name_word = word[1];
    r->ptoc = word[2] & 0xFFFF;
    r->gtoc = word[2] >> 16;
    name_remote(hm2, p, r);
    int built_in = r->ptoc ? 0 : sserial_builtin(hm2, p, r);
    COMP_TRY(built_in);
    if(r->ptoc) {
        int result = read_table(hm2, p, r, r->ptoc, false);
        if(result == 0 && r->gtoc) result = read_table(hm2, p, r, r->gtoc, true);
        if(result < 0) {
            HM2_ERR(hm2, "%s: its description cannot be read (%d)\n", r->prefix, result);
            return result;
        }
    }
    return count_words(hm2, r);
}

static int set_baud_rate(struct hm2 *hm2, struct sserial_port *p, int version)
{
    rtapi_u8 start, stride;
    int channel, i;
    if(hm2_sserial_baudrate < 0) return 0;
    if(version <= FIRMWARE_WITH_BAUD) {
        HM2_ERR(hm2, "sserial_baudrate needs a smart-serial firmware above %d, this is %d\n", FIRMWARE_WITH_BAUD,
                version);
        return -EINVAL;
    }
    COMP_TRY(read_local(hm2, p, LOCAL_START, &start));
    COMP_TRY(read_local(hm2, p, LOCAL_STRIDE, &stride));
    for(channel = 0; channel < SSERIAL_CHANNELS; channel++)
        for(i = 0; i < 4 && p->mask >> channel & 1; i++)
            COMP_TRY(write_local(hm2, p, start + (rtapi_u32)channel * stride + LOCAL_BAUD + (rtapi_u32)i,
                                 (rtapi_u8)(hm2_sserial_baudrate >> 8 * i)));
    return 0;
}

int sserial_discover(struct hm2 *hm2, struct sserial_port *p, const char modes[SSERIAL_CHANNELS])
{
    rtapi_u8 major, minor;
    int channel;
    COMP_TRY(command(hm2, p, SSERIAL_RESET_ON, COMMAND_NS));
    COMP_TRY(command(hm2, p, SSERIAL_RESET_OFF, COMMAND_NS));
    COMP_TRY(read_local(hm2, p, LOCAL_MAJOR, &major));
    COMP_TRY(read_local(hm2, p, LOCAL_MINOR, &minor));
    HM2_PRINT(hm2, "Smart Serial Firmware Version %i\n", minor);
    COMP_TRY(set_baud_rate(hm2, p, minor));
    COMP_TRY(command(hm2, p, SSERIAL_STOP, COMMAND_NS));
    for(channel = 0; channel < SSERIAL_CHANNELS; channel++)
        if(p->mask >> channel & 1 &&
           !hm2_write_now(hm2, sserial_addr(p, SSERIAL_REG_CS, channel),
                          SSERIAL_MODE(modes[channel] - '0'))) return -EIO;
    COMP_TRY(command(hm2, p, SSERIAL_SETUP | p->mask, SETUP_NS));
    for(channel = 0; channel < SSERIAL_CHANNELS; channel++)
        if(p->mask >> channel & 1) COMP_TRY(meet(hm2, p, channel, modes[channel] - '0'));
    return command(hm2, p, SSERIAL_STOP, COMMAND_NS);
}
