/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hm2_modbus.c - Modbus devices on a frame channel (pktuart) of a HostMot2 board.
 *
 * One command after another: frame out, answer in, pins. A transfer takes some cycles, because what
 * is read comes with the board's next read. Every failure counts; five in a row switch a command off
 * until its reset, and the others go on.
 *
 * Thread: hm2_modbus.N.process [servo], between the board's read and write; bounded by the number of
 * commands and the length of a frame
 */
#include <errno.h>
#include <string.h>
#include <rtapi_app.h>
#include "hostmot2-serial.h"
#include "hm2_modbus.h"

MODULE_LICENSE("GPL");
MODULE_AUTHOR("Kerf developers");
MODULE_DESCRIPTION("Modbus devices on HostMot2 boards");

#define MAX_INSTANCES 8
static char *ports[MAX_INSTANCES];
RTAPI_MP_ARRAY_STRING(ports, MAX_INSTANCES, "frame channel of each instance");
static char *mbccbs[MAX_INSTANCES];
RTAPI_MP_ARRAY_STRING(mbccbs, MAX_INSTANCES, "file of each instance");
static int debug = -1;
RTAPI_MP_INT(debug, "nonzero tells every failure");

#define MOST_IN_A_ROW 5
#define FRAMES 16
#define FRAME_ERRORS 0x1C000u          /* start bit, overrun, parity */
#define LENGTH_MASK 0x3FFu

enum state { NEXT, ANSWER, SIZES, DATA, PAUSE };

/* In HAL memory. */
struct instance {
    int number;
    char port[HAL_NAME_LEN + 1];
    struct mb_file file;
    hal_bool_t suspend, reset, fault;
    hal_uint_t fault_command, last_error_code;
    hal_uint_t baudrate, parity, stopbits, icdelay, rxdelay, txdelay, drivedelay;
    bool was_reset;
    enum state state;
    long long now, deadline;           /* ns */
    int next_init, next;               /* positions in the lists */
    struct mb_command *c;              /* the one under way */
    rtapi_u8 frame[MB_FRAME];
    int frame_len;
    rtapi_u32 sizes[FRAMES], words[MB_FRAME / 4];
    int answer_len;
};

static struct instance *instance[MAX_INSTANCES];
static int comp_id, instances;

/* ---- Line -------------------------------------------------------------------- */

/* Bits of a character, with start and stop. */
static double char_bits(rtapi_u16 format)
{
    return 10 + (format & MB_FORMAT_PARITY ? 1 : 0) + (format & MB_FORMAT_TWO_STOP ? 1 : 0);
}

/* The silence between frames: 3.5 characters, above 19200 baud 1.75 ms. */
static rtapi_u32 silence_bits(rtapi_u32 baud, rtapi_u16 format)
{
    return (rtapi_u32)ceil(baud > 19200 ? 0.00175 * baud : 3.5 * char_bits(format));
}

static int set_line(struct instance *m, rtapi_u32 baud, rtapi_u16 format, rtapi_u16 rx, rtapi_u16 tx, rtapi_u16 drive)
{
    rtapi_u32 parity = format & MB_FORMAT_PARITY ? HM2_PKTUART_CONFIG_PARITYEN : 0, silence = silence_bits(baud,
        format);
    hm2_pktuart_config_t in = {.baudrate = baud, .ifdelay = rx ? rx : silence - 1}, out = {.baudrate = baud};
    if(format & MB_FORMAT_ODD) parity |= HM2_PKTUART_CONFIG_PARITYODD;
    if(format & MB_FORMAT_TWO_STOP) parity |= HM2_PKTUART_CONFIG_STOPBITS2;
    out.ifdelay = tx ? tx : silence + 1;
    out.drivedelay = drive ? drive : 1;
    in.flags = parity | HM2_PKTUART_CONFIG_RXEN | HM2_PKTUART_CONFIG_FLUSH | HM2_PKTUART_CONFIG_FORCECONFIG;
    if(!(format & MB_FORMAT_FULL_DUPLEX)) in.flags |= HM2_PKTUART_CONFIG_RXMASKEN;
    out.flags = parity | HM2_PKTUART_CONFIG_DRIVEAUTO | HM2_PKTUART_CONFIG_FLUSH | HM2_PKTUART_CONFIG_FORCECONFIG;
    hal_set_ui32(m->baudrate, baud);
    hal_set_ui32(m->parity, !(format & MB_FORMAT_PARITY) ? 0 : format & MB_FORMAT_ODD ? 1 : 2);
    hal_set_ui32(m->stopbits, format & MB_FORMAT_TWO_STOP ? 2 : 1);
    hal_set_ui32(m->rxdelay, in.ifdelay);
    hal_set_ui32(m->txdelay, out.ifdelay);
    hal_set_ui32(m->drivedelay, out.drivedelay);
    return hm2_pktuart_config(m->port, &in, &out, 1);
}

static rtapi_u16 check_sum(const rtapi_u8 *p, int n)
{
    rtapi_u16 sum = 0xFFFF;
    int bit;
    while(n-- > 0)
        for(sum ^= *p++, bit = 0; bit < 8; bit++) sum = sum & 1 ? sum >> 1 ^ 0xA001 : sum >> 1;
    return sum;
}

/* ---- Frames ------------------------------------------------------------------ */

static void put16(struct instance *m, rtapi_u16 value)
{
    m->frame[m->frame_len++] = (rtapi_u8)(value >> 8);
    m->frame[m->frame_len++] = (rtapi_u8)value;
}

static bool put_registers(struct instance *m, const struct mb_command *c)
{
    rtapi_u8 *registers = m->frame + m->frame_len;
    int i;
    memset(registers, 0, 2 * c->count);
    for(i = 0; i < c->pins; i++)
        if(!mb_put(&c->pin[i], registers)) return false;
    m->frame_len += 2 * c->count;
    return true;
}

static void put_coils(struct instance *m, const struct mb_command *c)
{
    int i, bytes = (c->count + 7) / 8;
    memset(m->frame + m->frame_len, 0, (size_t)bytes);
    for(i = 0; i < c->pins; i++)
        if(mb_get_bit(&c->pin[i])) m->frame[m->frame_len + c->pin[i].at / 8] |= (rtapi_u8)(1u << c->pin[i].at % 8);
    m->frame_len += bytes;
}

/* The command's frame without its check sum. 0, or the error's number. */
static int build(struct instance *m, const struct mb_command *c)
{
    m->frame_len = 0;
    if(c->fixed_len) {
        memcpy(m->frame, c->fixed, (size_t)c->fixed_len);
        m->frame_len = c->fixed_len;
        return 0;
    }
    m->frame[m->frame_len++] = c->mbid;
    m->frame[m->frame_len++] = c->func;
    put16(m, c->addr);
    switch(c->func) {
    case MB_W_COIL: put16(m, c->pins && mb_get_bit(&c->pin[0]) ? 0xFF00 : 0); return 0;
    case MB_W_REGISTER: return put_registers(m, c) ? 0 : ERANGE;
    case MB_W_COILS:
        put16(m, c->count);
        m->frame[m->frame_len++] = (rtapi_u8)((c->count + 7) / 8);
        put_coils(m, c);
        return 0;
    case MB_W_REGISTERS:
        put16(m, c->count);
        m->frame[m->frame_len++] = (rtapi_u8)(2 * c->count);
        return put_registers(m, c) ? 0 : ERANGE;
    default: put16(m, c->count); return 0;
    }
}

/* Is this the answer to the frame that was sent? 0, or the error's number. */
static int check_answer(const struct instance *m, const rtapi_u8 *p, int n)
{
    const struct mb_command *c = m->c;
    int func = m->frame[1], bytes = mb_is_bits(c->func) ? (c->count + 7) / 8 : 2 * c->count;
    if(n < 5) return EMSGSIZE;
    if(check_sum(p, n - 2) != (p[n - 2] | p[n - 1] << 8)) return EBADE;
    if(p[0] != m->frame[0]) return ECHRNG;
    if(p[1] == (func | 0x80)) return EBADMSG;
    if(p[1] != func) return EINVAL;
    if(!mb_is_read(func)) return n == 8 ? memcmp(p + 2, m->frame + 2, func == 5 || func == 6 ? 4 : 2) ? EINVAL : 0
        : EMSGSIZE;
    return c->fixed_len || (p[2] == bytes && n == bytes + 5) ? 0 : EMSGSIZE;
}

static void show(struct mb_command *c, const rtapi_u8 *values)
{
    int i;
    for(i = 0; i < c->pins; i++) {
        struct mb_pin *p = &c->pin[i];
        if(mb_is_bits(c->func)) mb_show_bit(p, values[p->at / 8] >> p->at % 8 & 1);
        else mb_show(p, values);
    }
}

/* ---- Commands ---------------------------------------------------------------- */

static void finish(struct instance *m)
{
    m->c->due = m->now + (long long)m->c->interval_us * 1000;
    m->c->done = true;
    m->c = NULL;
    m->state = NEXT;
}

static void succeed(struct instance *m)
{
    struct mb_command *c = m->c;
    if(!mb_is_read(c->func) && m->frame_len <= MB_FRAME) {
        memcpy(c->sent, m->frame, (size_t)m->frame_len);
        c->sent_len = m->frame_len;
    }
    c->in_a_row = 0;
    if(c->error_code) hal_set_ui32(c->error_code, 0);
    finish(m);
}

static void fail(struct instance *m, int error)
{
    struct mb_command *c = m->c;
    bool hopeless = error == ERANGE || error == EFBIG;
    c->sent_len = 0;
    hm2_pktuart_queue_reset(m->port);
    if(c->errors) {
        hal_set_ui32(c->errors, hal_get_ui32(c->errors) + 1);
        hal_set_ui32(c->error_code, (rtapi_u32)error);
        hal_set_ui32(m->fault_command, (rtapi_u32)(c - m->file.command));
    }
    hal_set_ui32(m->last_error_code, (rtapi_u32)error);
    hal_set_bool(m->fault, 1);
    c->in_a_row++;
    if(debug > 0 || (c->errors && !c->off && (hopeless ? c->in_a_row == 2 : c->in_a_row == MOST_IN_A_ROW)))
        rtapi_print_msg(RTAPI_MSG_ERR, "hm2_modbus.%d: command %d (device %d, function %d): %s%s\n", m->number,
                        (int)(c - m->file.command), c->mbid, c->func, strerror(error),
                        c->in_a_row >= MOST_IN_A_ROW || hopeless ? "; it is switched off until reset" : "");
    if(c->errors && (c->in_a_row >= MOST_IN_A_ROW || (hopeless && c->in_a_row >= 2))) {
        c->off = true;
        hal_set_bool(c->disabled, 1);
    }
    finish(m);
}

static void pause_for(struct instance *m, rtapi_u32 us)
{
    m->deadline = m->now + (long long)us * 1000;
    m->state = PAUSE;
}

static void send(struct instance *m)
{
    struct mb_command *c = m->c;
    rtapi_u8 one = 1;
    rtapi_u16 size;
    int error = build(m, c);
    if(error) {
        fail(m, error);
        return;
    }
    bool changed = m->frame_len != c->sent_len || memcmp(m->frame, c->sent, (size_t)m->frame_len);
    if(!c->fixed_len && !mb_is_read(c->func) && !changed && !(c->flags & MB_RESEND)) {
        finish(m);
        return;
    }
    rtapi_u8 wire[MB_FRAME + 2];
    rtapi_u16 sum = check_sum(m->frame, m->frame_len);
    memcpy(wire, m->frame, (size_t)m->frame_len);
    wire[m->frame_len] = (rtapi_u8)sum;
    wire[m->frame_len + 1] = (rtapi_u8)(sum >> 8);
    size = (rtapi_u16)(m->frame_len + 2);
    if(hm2_pktuart_send(m->port, wire, &one, &size) < 0 || one != 1) {
        fail(m, EIO);
        return;
    }
    m->deadline = m->now + (long long)c->timeout_us * 1000;
    m->state = (!c->mbid && !(c->flags & MB_BC_ANSWER)) || c->flags & MB_NO_ANSWER ? PAUSE : ANSWER;
}

static bool may_run(struct instance *m, struct mb_command *c)
{
    if(c->disabled) {
        bool off = hal_get_bool(c->disable);
        hal_set_bool(c->disabled, off || c->off);
        if(off) hal_set_ui32(c->error_code, EAGAIN);
        if(off || c->off) return false;
    }
    if(c->interval_us == MB_ONCE) return !c->done;
    return m->now >= c->due;
}

/* The init list once, then the commands in turn. At most one each time round. */
static void choose(struct instance *m)
{
    int i;
    if(hal_get_bool(m->suspend)) return;
    if(m->next_init < m->file.inits) {
        m->c = &m->file.init[m->next_init++];
        if(m->c->func) send(m);
        else if(m->c->addr == 1)
            set_line(m, m->c->timeout_us, (rtapi_u16)(m->file.format & ~7u) | (m->c->flags >> 8 & 7), m->c->delays[0],
                     m->c->delays[1], m->c->drive_delay), finish(m);
        else
            pause_for(m, m->c->timeout_us);
        return;
    }
    for(i = 0; i < m->file.commands; i++) {
        struct mb_command *c = &m->file.command[m->next];
        m->next = (m->next + 1) % m->file.commands;
        if(!may_run(m, c)) continue;
        m->c = c;
        if(c->func) send(m);
        else pause_for(m, c->timeout_us);
        if(m->c) return;
    }
}

static void take_sizes(struct instance *m)
{
    rtapi_u32 first = m->sizes[0];
    m->answer_len = (int)(first & LENGTH_MASK);
    if(first & FRAME_ERRORS) fail(m, EIO);
    else if(m->file.ic_delay && first >> 24 > m->file.ic_delay) fail(m, ENOMSG);
    else if(m->answer_len < 1 || m->answer_len > MB_FRAME) fail(m, EMSGSIZE);
    else if(hm2_pktuart_queue_read_data(m->port, m->words, m->answer_len) < 0) fail(m, EIO);
    else m->state = DATA;
}

static void take_answer(struct instance *m)
{
    const rtapi_u8 *p = (const rtapi_u8 *)m->words; /* the low byte came first */
    int error = check_answer(m, p, m->answer_len);
    if(error) {
        fail(m, error);
        return;
    }
    if(mb_is_read(m->c->func)) show(m->c, p + 3);
    succeed(m);
}

static void take_resets(struct instance *m)
{
    bool all = hal_get_bool(m->reset) && !m->was_reset;
    bool fault = false;
    int i;
    m->was_reset = hal_get_bool(m->reset);
    for(i = 0; i < m->file.commands; i++) {
        struct mb_command *c = &m->file.command[i];
        bool now = hal_get_bool(c->reset);
        if(all || (now && !c->was_reset)) {
            c->off = false;
            c->in_a_row = 0;
            hal_set_ui32(c->error_code, 0);
        }
        c->was_reset = now;
        fault |= c->off || c->in_a_row;
    }
    hal_set_bool(m->fault, fault);
}

/* HAL function hm2_modbus.N.process. */
static void process(void *arg, long period)
{
    struct instance *m = arg;
    m->now += period;
    take_resets(m);
    switch(m->state) {
    case NEXT: choose(m); break;
    case PAUSE:
        if(m->now >= m->deadline) succeed(m);
        break;
    case ANSWER:
        if(hm2_pktuart_get_rx_status(m->port) >> 16 & 0x1F) {
            if(hm2_pktuart_queue_get_frame_sizes(m->port, m->sizes) < 0) fail(m, EIO);
            else m->state = SIZES;
        } else if(m->now >= m->deadline) {
            if(m->c->flags & MB_TIMES_OUT) succeed(m);
            else fail(m, ETIMEDOUT);
        }
        break;
    case SIZES: take_sizes(m); break;
    case DATA: take_answer(m); break;
    }
}

/* ---- Set-up [init] ------------------------------------------------------------ */

static int export_pin(struct instance *m, struct mb_command *c, struct mb_pin *p)
{
    hal_pdir_t dir = mb_is_read(c->func) ? HAL_OUT : HAL_IN;
    char name[HAL_NAME_LEN + 1];
    int kind = mb_is_read(c->func) ? (p->mtype >> 4 == 0 ? HAL_U64 : p->mtype >> 4 == 1 ? HAL_S64 : HAL_FLOAT)
        : p->htype;
    rtapi_snprintf(name, sizeof name, "hm2_modbus.%d.%s", m->number, p->name);
    switch(p->htype) {
    case HAL_BIT: return hal_pin_new_bool(comp_id, dir, &p->value.b, 0, "%s", name);
    case HAL_FLOAT: COMP_TRY(hal_pin_new_real(comp_id, dir, &p->value.r, 0, "%s", name)); break;
    case HAL_S32: COMP_TRY(hal_pin_new_si32(comp_id, dir, &p->value.s, 0, "%s", name)); break;
    case HAL_U32: COMP_TRY(hal_pin_new_ui32(comp_id, dir, &p->value.u, 0, "%s", name)); break;
    case HAL_S64: COMP_TRY(hal_pin_new_sint(comp_id, dir, &p->value.s, 0, "%s", name)); break;
    default: COMP_TRY(hal_pin_new_uint(comp_id, dir, &p->value.u, 0, "%s", name));
    }
    if(!(p->flags & MB_PIN_SCALE) || mb_is_bits(c->func)) return 0;
    COMP_TRY(hal_pin_new_real(comp_id, HAL_IN, &p->scale.r, 1, "%s.scale", name));
    if(dir == HAL_OUT) COMP_TRY(hal_pin_new_real(comp_id, HAL_OUT, &p->scaled, 0, "%s.scaled", name));
    switch(kind) {
    case HAL_FLOAT: return hal_pin_new_real(comp_id, HAL_IN, &p->offset.r, 0, "%s.offset", name);
    case HAL_S32: return hal_pin_new_si32(comp_id, HAL_IN, &p->offset.s, 0, "%s.offset", name);
    case HAL_U32: return hal_pin_new_ui32(comp_id, HAL_IN, &p->offset.u, 0, "%s.offset", name);
    case HAL_S64: return hal_pin_new_sint(comp_id, HAL_IN, &p->offset.s, 0, "%s.offset", name);
    default: return hal_pin_new_uint(comp_id, HAL_IN, &p->offset.u, 0, "%s.offset", name);
    }
}

static int export_command(struct instance *m, int i)
{
    struct mb_command *c = &m->file.command[i];
    int k, n = m->number;
    bool off = c->flags & MB_DISABLED;
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &c->disable, off, "hm2_modbus.%d.command.%02d.disable", n, i));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_OUT, &c->disabled, off, "hm2_modbus.%d.command.%02d.disabled", n, i));
    COMP_TRY(hal_pin_new_ui32(comp_id, HAL_OUT, &c->errors, 0, "hm2_modbus.%d.command.%02d.errors", n, i));
    COMP_TRY(hal_pin_new_ui32(comp_id, HAL_OUT, &c->error_code, 0, "hm2_modbus.%d.command.%02d.error-code", n, i));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &c->reset, 0, "hm2_modbus.%d.command.%02d.reset", n, i));
    for(k = 0; k < c->pins; k++) COMP_TRY(export_pin(m, c, &c->pin[k]));
    return 0;
}

static int export_instance(struct instance *m)
{
    int i, n = m->number;
    struct {
        hal_uint_t *ref;
        const char *name;
    } params[] = {
        {&m->baudrate, "baudrate"}, {&m->parity, "parity"}, {&m->stopbits, "stopbits"}, {&m->icdelay, "icdelay"},
        {&m->rxdelay, "rxdelay"}, {&m->txdelay, "txdelay"}, {&m->drivedelay, "drivedelay"},
    };
    for(i = 0; i < (int)(sizeof params / sizeof params[0]); i++)
        COMP_TRY(hal_param_new_ui32(comp_id, HAL_RO, params[i].ref, 0, "hm2_modbus.%d.%s", n, params[i].name));
    hal_set_ui32(m->icdelay, m->file.ic_delay);
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &m->suspend, (m->file.format & MB_FORMAT_SUSPENDED) != 0,
                              "hm2_modbus.%d.suspend", n));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &m->reset, 0, "hm2_modbus.%d.reset", n));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_OUT, &m->fault, 0, "hm2_modbus.%d.fault", n));
    COMP_TRY(hal_pin_new_ui32(comp_id, HAL_OUT, &m->fault_command, 0, "hm2_modbus.%d.fault-command", n));
    COMP_TRY(hal_pin_new_ui32(comp_id, HAL_OUT, &m->last_error_code, 0, "hm2_modbus.%d.last-error-code", n));
    for(i = 0; i < m->file.commands; i++) COMP_TRY(export_command(m, i));
    return hal_export_functf(process, m, 1, 0, comp_id, "hm2_modbus.%d.process", n);
}

static int start_instance(int n)
{
    struct instance *m = instance[n] = hal_malloc(sizeof *m);
    int version;
    if(!m) return -ENOMEM;
    m->number = n;
    rtapi_snprintf(m->port, sizeof m->port, "%s", ports[n]);
    version = hm2_pktuart_get_version(m->port);
    if(version < 0) return version;
    if(version / 16 < 2 || version % 16 < 2) {
        rtapi_print_msg(RTAPI_MSG_ERR,
                        "hm2_modbus: %s has version %d, at least 2 is needed: write a newer firmware to the "
                        "board\n", m->port, version % 16);
        return -EINVAL;
    }
    if(!mbccbs[n] || !*mbccbs[n]) {
        rtapi_print_msg(RTAPI_MSG_ERR, "hm2_modbus: mbccbs= has no file for %s\n", m->port);
        return -EINVAL;
    }
    COMP_TRY(mb_file_read(mbccbs[n], &m->file));
    COMP_TRY(export_instance(m));
    return set_line(m, m->file.baud, m->file.format, m->file.rx_delay, m->file.tx_delay, m->file.drive_delay);
}

int rtapi_app_main(void)
{
    int r = 0;
    comp_id = hal_init("hm2_modbus");
    if(comp_id < 0) return comp_id;
    for(instances = 0; r >= 0 && instances < MAX_INSTANCES && ports[instances] && *ports[instances]; instances++)
        r = start_instance(instances);
    if(r >= 0 && !instances) {
        rtapi_print_msg(RTAPI_MSG_ERR, "hm2_modbus: ports= names no frame channel, such as hm2_7i96s.0.pktuart.0\n");
        r = -EINVAL;
    }
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
