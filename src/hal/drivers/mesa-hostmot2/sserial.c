/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * sserial.c - smart-serial ports in the cycle.
 *
 * A port runs by a command in each cycle (do it); the board has the answers of all cards in the next
 * one. Errors are counted up, good cycles down; above fault-lim the port stops and its inputs become
 * false, until run is switched off and on. Ports do not depend on each other.
 */
#include <string.h>
#include "sserial.h"

#define LATE_CYCLES 4                  /* before it is told */
#define REGISTERS 6
#define REGISTERS_B 10
#define STRIDE 0x40
#define MULTIPLE 0x3C
#define MULTIPLE_B 0x3FC

struct sserial {
    struct hm2_md md;
    struct sserial_port *port[HM2_SSERIAL_PORTS];
};

/* ---- Registration --------------------------------------------------------- */

/* Channels of a port that have pins; those that the config string leaves out lose them. */
static rtapi_u32 channels_with_pins(struct hm2 *hm2, int gtag, int port)
{
    rtapi_u32 mask = 0;
    int i;
    for(i = 0; i < hm2->pins; i++) {
        struct hm2_pin *pin = &hm2->pin[i];
        int channel = (pin->sec_pin & 0xF) - 1;
        if(pin->sec_tag != gtag || pin->sec_unit != port || channel < 0 || channel >= SSERIAL_CHANNELS) continue;
        if(hm2->config.sserial_mode[port][channel] == 'x') pin->sec_tag = 0;
        else mask |= 1u << channel;
    }
    return mask;
}

static void release_pins(struct hm2 *hm2, int gtag, int port, rtapi_u32 mask)
{
    int i;
    for(i = 0; i < hm2->pins; i++) {
        struct hm2_pin *pin = &hm2->pin[i];
        int channel = (pin->sec_pin & 0xF) - 1;
        if(pin->sec_tag == gtag && pin->sec_unit == port && channel >= 0 && !(mask >> channel & 1)) pin->sec_tag = 0;
    }
}

static int export_port(struct hm2 *hm2, struct sserial_port *p)
{
    static const struct hm2_item items[] = {
        HM2_ITEM(BIT, IN, sserial_port, run, "run", 1),
        HM2_ITEM(U32, OUT, sserial_port, port_state, "port_state", 0),
        HM2_ITEM(U32, OUT, sserial_port, port_state2, "port_state2", 0),
        HM2_ITEM(U32, OUT, sserial_port, port_state3, "port_state3", 0),
        HM2_ITEM(U32, OUT, sserial_port, fault_count, "fault-count", 0),
        HM2_ITEM(U32, RW, sserial_port, fault_inc, "fault-inc", 10),
        HM2_ITEM(U32, RW, sserial_port, fault_dec, "fault-dec", 1),
        HM2_ITEM(U32, RW, sserial_port, fault_lim, "fault-lim", 200),
    };
    COMP_TRY(hm2_export(hm2, items, HM2_COUNT(items), p, "sserial.port-%d.", p->number));
    return hal_pin_new_si32(hm2->io->comp_id, HAL_OUT, &p->debug, 0, "%s.%d.debug", hm2->io->name, p->number);
}

/* The command is written behind everything else. */
static int add_regions(struct hm2 *hm2, struct sserial_port *p)
{
    int in = 0, out = 2, i; /* parameters too go out in up to two words */
    for(i = 0; i < SSERIAL_CHANNELS; i++) {
        const struct sserial_remote *r = p->remote[i];
        if(r && r->words_in > in) in = r->words_in;
        if(r && r->words_out > out) out = r->words_out;
    }
    p->command_in = hm2_read_region(hm2, sserial_addr(p, SSERIAL_REG_COMMAND, 0), 1);
    p->data_in = hm2_read_region(hm2, sserial_addr(p, SSERIAL_REG_DATA, 0), 1);
    p->cs_in = hm2_read_region(hm2, sserial_addr(p, SSERIAL_REG_CS, 0), SSERIAL_CHANNELS);
    if(!p->command_in || !p->data_in || !p->cs_in) return -ENOMEM;
    for(i = 0; i < in; i++)
        if(!(p->user_in[i] = hm2_read_region(hm2, sserial_addr(p, SSERIAL_REG_USER + i, 0),
                                             SSERIAL_CHANNELS))) return -ENOMEM;
    for(i = 0; i < out; i++)
        if(!(p->user_out[i] = hm2_write_region(hm2, sserial_addr(p, SSERIAL_REG_USER + i, 0), SSERIAL_CHANNELS)))
            return -ENOMEM;
    p->command_out = hm2_write_region(hm2, sserial_addr(p, SSERIAL_REG_COMMAND, 0), 1);
    if(!p->command_out) return -ENOMEM;
    *p->command_out = SSERIAL_NOTHING;
    return 0;
}

static int claim_port(struct hm2 *hm2, struct sserial *s, int number)
{
    rtapi_u32 mask = channels_with_pins(hm2, s->md.gtag, number);
    if(!mask) return 0;
    struct sserial_port *p = hal_malloc(sizeof *p);
    if(!p) return -ENOMEM;
    p->md = &s->md;
    p->number = number;
    p->mask = mask;
    hm2_pins_enable_now(hm2, s->md.gtag);
    COMP_TRY(sserial_discover(hm2, p, hm2->config.sserial_mode[number]));
    release_pins(hm2, s->md.gtag, number, p->mask);
    if(!p->mask) return 0;
    s->port[number] = p;
    COMP_TRY(export_port(hm2, p));
    return add_regions(hm2, p);
}

static int claim(struct hm2 *hm2, const struct hm2_md *md, void **state)
{
    bool b = md->gtag == HM2_GTAG_SMARTSERIALB;
    int i, n = md->instances < HM2_SSERIAL_PORTS ? md->instances : HM2_SSERIAL_PORTS;
    COMP_TRY(hm2_check_md(hm2, md, 0, b ? REGISTERS_B : REGISTERS, STRIDE, b ? MULTIPLE_B : MULTIPLE));
    if(*state) {
        HM2_ERR(hm2, "firmware has two kinds of smart-serial modules: inconsistent firmware\n");
        return -EINVAL;
    }
    struct sserial *s = *state = hal_malloc(sizeof *s);
    if(!s) return -ENOMEM;
    s->md = *md;
    hm2->instances[md->gtag] = SSERIAL_CHANNELS;
    for(i = 0; i < n; i++) COMP_TRY(claim_port(hm2, s, i));
    return n;
}

/* ---- Errors --------------------------------------------------------------- */

static const struct {
    int bit;
    const char *text;
    bool of_card;                      /* not of the line */
} status_bits[] = {
    {0, "CRC error", false},          {1, "Invalid cookie", false},      {2, "Overrun", false},
    {3, "Timeout", false},            {4, "Extra character", false},     {5, "Serial Break Error", false},
    {6, "Remote Fault", false},       {7, "Too many errors", false},     {8, "Remote fault", true},
    {13, "Communication error", false}, {14, "No Remote ID", false},     {15, "Communication Not Ready", false},
    {24, "Watchdog Fault", true},     {25, "No Enable", true},           {26, "Over Temperature", true},
    {27, "Over Current", true},       {28, "Over Voltage", true},        {29, "Under Voltage", true},
    {30, "Illegal Remote Mode", true}, {31, "LBPCOM Fault", true},
};

/* Each error of a card once, until it is gone. */
static void tell_card_errors(struct hm2 *hm2, struct sserial_remote *r, rtapi_u32 status)
{
    int i;
    for(i = 0; i < HM2_COUNT(status_bits); i++) {
        rtapi_u32 bit = 1u << status_bits[i].bit;
        if(!status_bits[i].of_card) continue;
        if(!(status & bit)) r->told &= ~bit;
        else if(!(r->told & bit)) {
            r->told |= bit;
            HM2_ERR(hm2, "Smart serial card %s remote error = (%i) %s\n", r->prefix, status_bits[i].bit,
                    status_bits[i].text);
        }
    }
}

static void tell_line_errors(struct hm2 *hm2, struct sserial_port *p)
{
    int c, i, said = 0;
    if(*p->command_in) HM2_ERR(hm2, "Smart Serial Comms Error: port %d does not do its command 0x%04X\n", p->number,
                               *p->command_in);
    for(c = 0; c < SSERIAL_CHANNELS; c++) {
        if(!p->remote[c] || !(*p->data_in >> c & 1)) continue;
        for(i = 0; i < HM2_COUNT(status_bits); i++)
            if(p->cs_in[c] >> status_bits[i].bit & 1) {
                HM2_ERR(hm2, "Smart Serial Comms Error: %s: (%i) %s\n", p->remote[c]->prefix, status_bits[i].bit,
                        status_bits[i].text);
                said++;
            }
        if(!said) HM2_ERR(hm2, "Smart Serial Comms Error: %s does not answer\n", p->remote[c]->prefix);
    }
}

static void stop_by_errors(struct hm2 *hm2, struct sserial_port *p)
{
    int c, i;
    tell_line_errors(hm2, p);
    HM2_ERR(hm2, "***Smart Serial Port %i will be stopped***: check cables and supplies of its cards, then switch "
            "sserial.port-%d.run off and on\n", p->number, p->number);
    for(c = 0; c < SSERIAL_CHANNELS; c++)
        for(i = 0; p->remote[c] && i < p->remote[c]->fields; i++) field_release(&p->remote[c]->field[i]);
    p->state = SSERIAL_ERROR;
    p->stop_due = true;
}

/* ---- Data ----------------------------------------------------------------- */

static void show_remote(struct sserial_port *p, struct sserial_remote *r)
{
    rtapi_u32 words[SSERIAL_WORDS] = {0};
    const struct field *low = NULL;
    int i, at = 0;
    for(i = 0; i < r->words_in; i++) words[i] = p->user_in[i][r->channel];
    for(i = 0; i < r->fields; i++) {
        struct field *f = &r->field[i];
        if(f->dir == FIELD_OUT) continue;
        field_show(f, field_extract(words, at, f->length), low);
        low = f->type == FIELD_ENCODER_L ? f : low;
        at += f->length;
    }
}

static void gather_remote(struct sserial_port *p, struct sserial_remote *r)
{
    rtapi_u32 words[SSERIAL_WORDS] = {0};
    int i, at = 0;
    for(i = 0; i < r->fields; i++) {
        struct field *f = &r->field[i];
        if(f->dir == FIELD_IN) continue;
        field_insert(words, at, f->length, field_read(f));
        at += f->length;
    }
    for(i = 0; i < r->words_out; i++) p->user_out[i][r->channel] = words[i];
}

/* ---- States --------------------------------------------------------------- */

static void tell_channel(struct hm2 *hm2, struct sserial_port *p, int channel, rtapi_u32 what)
{
    hm2_queue_write(hm2, sserial_addr(p, SSERIAL_REG_CS, channel), what);
}

static void begin_start(struct hm2 *hm2, struct sserial_port *p)
{
    int c;
    for(c = 0; c < SSERIAL_CHANNELS; c++)
        if(p->remote[c]) tell_channel(hm2, p, c, SSERIAL_MODE(p->remote[c]->mode));
    *p->command_out = SSERIAL_START | p->mask;
    p->state = SSERIAL_STARTING;
    hal_set_ui32(p->fault_count, 0);
}

/* Counts this cycle's errors; true when there are too many. */
static bool count_errors(struct hm2 *hm2, struct sserial_port *p)
{
    rtapi_u64 count = hal_get_ui32(p->fault_count), dec = hal_get_ui32(p->fault_dec);
    bool late = *p->command_in != 0;
    if(!late) p->late = 0;
    else {
        count += hal_get_ui32(p->fault_inc);
        if(++p->late >= LATE_CYCLES && !p->told_late) {
            p->told_late = true;
            HM2_ERR(hm2,
                    "Smart Serial port %i: DoIt not cleared from previous servo thread. The thread is too fast for "
                    "the cards\n", p->number);
        }
    }
    if(!late && *p->data_in & p->mask) count += hal_get_ui32(p->fault_inc);
    count = count > dec ? count - dec : 0;
    hal_set_ui32(p->fault_count, count > RTAPI_UINT32_MAX ? RTAPI_UINT32_MAX : (rtapi_u32)count);
    return count > hal_get_ui32(p->fault_lim);
}

static void process_running(struct hm2 *hm2, struct sserial_port *p)
{
    int c;
    if(count_errors(hm2, p)) {
        stop_by_errors(hm2, p);
        return;
    }
    if(*p->command_in) return;
    for(c = 0; c < SSERIAL_CHANNELS; c++) {
        if(!p->remote[c]) continue;
        tell_card_errors(hm2, p->remote[c], p->cs_in[c]);
        if(!(*p->data_in >> c & 1)) show_remote(p, p->remote[c]);
    }
}

static void process(struct hm2 *hm2, void *state, long period)
{
    struct sserial *s = state;
    int i;
    (void)period;
    for(i = 0; i < HM2_SSERIAL_PORTS; i++) {
        struct sserial_port *p = s->port[i];
        if(!p) continue;
        if(p->state == SSERIAL_RUNNING) process_running(hm2, p);
        hal_set_ui32(p->port_state, (rtapi_u32)p->state);
        hal_set_ui32(p->port_state2, *p->data_in);
        hal_set_ui32(p->port_state3, *p->command_in);
    }
}

static void prepare_port(struct hm2 *hm2, struct sserial_port *p)
{
    bool done = *p->command_in == 0, run = hal_get_bool(p->run);
    int c;
    *p->command_out = SSERIAL_NOTHING;
    switch(p->state) {
    case SSERIAL_IDLE: case SSERIAL_PARAM:
        if(!run && p->state == SSERIAL_IDLE) break;
        if(!sserial_write_params(hm2, p) && p->state == SSERIAL_IDLE) begin_start(hm2, p);
        break;
    case SSERIAL_STARTING:
        if(!done) break;
        p->state = SSERIAL_RUNNING;
        p->late = 0;
        p->told_late = false;
        *p->command_out = SSERIAL_DO_IT | p->mask;
        break;
    case SSERIAL_RUNNING:
        if(!run) p->state = SSERIAL_STOPPING;
        for(c = 0; c < SSERIAL_CHANNELS; c++)
            if(p->remote[c]) gather_remote(p, p->remote[c]);
        if(done && run) *p->command_out = SSERIAL_DO_IT | p->mask;
        break;
    case SSERIAL_STOPPING:
        *p->command_out = SSERIAL_STOP;
        p->state = SSERIAL_STOPPED;
        break;
    case SSERIAL_STOPPED:
        if(done) p->state = SSERIAL_IDLE;
        break;
    case SSERIAL_ERROR:
        if(p->stop_due) *p->command_out = SSERIAL_STOP;
        p->stop_due = false;
        if(!run) p->state = SSERIAL_STOPPING;
        break;
    }
}

static void prepare(struct hm2 *hm2, void *state, long period)
{
    struct sserial *s = state;
    int i;
    (void)period;
    for(i = 0; i < HM2_SSERIAL_PORTS; i++)
        if(s->port[i]) prepare_port(hm2, s->port[i]);
}

const struct hm2_function_ops hm2_sserial = {
    .gtag = {HM2_GTAG_SMARTSERIAL, HM2_GTAG_SMARTSERIALB},
    .claim = claim,
    .process = process,
    .prepare = prepare,
};

/* ---- Parameters of cards ---------------------------------------------------- */

enum { STEP_NONE, STEP_STOP, STEP_SETUP, STEP_UNLOCK, STEP_WRITE, STEP_LOCK, STEP_END };

static bool is_kept(const struct sserial_param *q)
{
    return q->field.type == FIELD_NV_UNSIGNED || q->field.type == FIELD_NV_SIGNED || q->field.type == FIELD_NV_FLOAT;
}

static rtapi_u64 param_bits(const struct sserial_param *q)
{
    rtapi_u64 mask = q->field.length >= FIELD_BITS ? ~(rtapi_u64)0 : ((rtapi_u64)1 << q->field.length) - 1;
    union {
        float f;
        rtapi_u32 u;
    } narrow;
    switch(q->field.type) {
    case FIELD_UNSIGNED: case FIELD_NV_UNSIGNED: return hal_get_ui32(q->field.value.u) & mask;
    case FIELD_SIGNED: case FIELD_NV_SIGNED: return (rtapi_u64)(rtapi_s64)hal_get_si32(q->field.value.s) & mask;
    default:
        narrow.f = (float)hal_get_real(q->field.value.r);
        return narrow.u;
    }
}

static bool find_changed(struct sserial_port *p)
{
    int c, i;
    for(c = 0; c < SSERIAL_CHANNELS; c++)
        for(i = 0; p->remote[c] && i < p->remote[c]->params; i++) {
            struct sserial_param *q = &p->remote[c]->param[i];
            if(q->field.dir == FIELD_IN || param_bits(q) == q->written) continue;
            p->param_remote = p->remote[c];
            p->param = q;
            return true;
        }
    return false;
}

/* Access to memory that keeps its contents: 1 opens it, 0 closes it. */
static void access_memory(struct hm2 *hm2, struct sserial_port *p, rtapi_u32 what)
{
    int c = p->param_remote->channel;
    p->user_out[0][c] = what;
    tell_channel(hm2, p, c, SSERIAL_NON_VOLATILE);
    *p->command_out = SSERIAL_DO_IT | 1u << c;
}

static void write_value(struct hm2 *hm2, struct sserial_port *p)
{
    struct sserial_param *q = p->param;
    int c = p->param_remote->channel, log2 = q->field.length > 32 ? 3 : q->field.length > 16 ? 2 : q->field.length > 8;
    q->written = param_bits(q);
    p->user_out[0][c] = (rtapi_u32)q->written;
    p->user_out[1][c] = (rtapi_u32)(q->written >> 32);
    tell_channel(hm2, p, c, SSERIAL_WRITE(log2) | q->field.addr);
    *p->command_out = SSERIAL_DO_IT | 1u << c;
}

/* Each step waits until the board has done the one before. */
bool sserial_write_params(struct hm2 *hm2, struct sserial_port *p)
{
    if(p->step == STEP_NONE) {
        if(!find_changed(p)) return false;
        p->state = SSERIAL_PARAM;
        p->step = STEP_STOP;
    } else if(*p->command_in)
        return true;
    switch(p->step) {
    case STEP_STOP: *p->command_out = SSERIAL_STOP; break;
    case STEP_SETUP:
        tell_channel(hm2, p, p->param_remote->channel, SSERIAL_MODE(p->param_remote->mode));
        *p->command_out = SSERIAL_SETUP | 1u << p->param_remote->channel;
        break;
    case STEP_UNLOCK:
        if(is_kept(p->param)) access_memory(hm2, p, 1);
        break;
    case STEP_WRITE: write_value(hm2, p); break;
    case STEP_LOCK:
        if(!is_kept(p->param)) break;
        access_memory(hm2, p, 0);
        HM2_ERR(hm2, "%s.%s is kept by the card: it counts from the next power-up of the card on\n",
                p->param_remote->prefix, p->param->field.name);
        break;
    case STEP_END: *p->command_out = SSERIAL_STOP; break;
    default:
        p->step = STEP_NONE;
        p->state = SSERIAL_IDLE;
        return true;
    }
    p->step++;
    return true;
}
