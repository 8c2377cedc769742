/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * bspi.c - buffered SPI channels, for drivers of what hangs on them (hostmot2-serial.h).
 *
 * A channel has 16 frames, each with its own chip select, rate and length; what comes back of all of
 * them is one queue, in the order in which they were sent.
 */
#include <rtapi_string.h>
#include "hm2.h"
#include "hostmot2-serial.h"

enum { DATA, DESCRIPTOR, COUNT, REGISTERS };

#define FRAMES 16
#define CD_NO_ECHO 31
#define CD_NO_CLEAR 30
#define CD_SAMPLE_LATE 29
#define CD_DELAY 24
#define CD_CS 16
#define CD_DIVIDER 8
#define CD_CPHA 7
#define CD_CPOL 6

struct channel {
    char name[HAL_NAME_LEN + 1];
    rtapi_u32 descriptor[FRAMES];
    rtapi_u32 addr[FRAMES];            /* where a frame's data are written */
    rtapi_u32 echo_addr, descriptor_addr, count_addr;
    struct hm2 *hm2;
    double clock_mhz;
    int (*read)(void *), (*write)(void *);
    void *read_data, *write_data;
};

struct bspi {
    int count;
    struct channel *channel;
};

static int claim(struct hm2 *hm2, const struct hm2_md *md, void **state)
{
    int i, k, n = hm2_count(hm2, md, HM2_NUM_BSPIS);
    COMP_TRY(n);
    COMP_TRY(hm2_check_md(hm2, md, 0, REGISTERS, 0x40, 0x7));
    if(*state || !n) return 0;
    struct bspi *s = *state = hal_malloc(sizeof *s);
    if(!s || !(s->channel = hal_malloc((long)sizeof *s->channel * n))) return -ENOMEM;
    s->count = n;
    for(i = 0; i < n; i++) {
        struct channel *c = &s->channel[i];
        rtapi_snprintf(c->name, sizeof c->name, "%.40s.bspi.%d", hm2->io->name, i);
        c->hm2 = hm2;
        c->clock_mhz = md->clock / 1e6;
        c->echo_addr = hm2_register_addr(md, DATA, i);
        c->descriptor_addr = md->base + md->register_stride + 4 * (rtapi_u32)i;
        c->count_addr = md->base + 2 * md->register_stride + 4 * (rtapi_u32)i;
        for(k = 0; k < FRAMES; k++) c->addr[k] = c->echo_addr + 4 * (rtapi_u32)k;
    }
    hm2->instances[md->gtag] = (rtapi_u8)n;
    return n;
}

/* They go into the board like into a stack. */
static void write_descriptors(struct channel *c)
{
    int k;
    for(k = FRAMES - 1; k >= 0; k--) hm2_queue_write(c->hm2, c->descriptor_addr, c->descriptor[k]);
}

static void process(struct hm2 *hm2, void *state, long period)
{
    struct bspi *s = state;
    int i;
    (void)hm2;
    (void)period;
    for(i = 0; i < s->count; i++)
        if(s->channel[i].read) s->channel[i].read(s->channel[i].read_data);
}

static void prepare(struct hm2 *hm2, void *state, long period)
{
    struct bspi *s = state;
    int i;
    (void)hm2;
    (void)period;
    for(i = 0; i < s->count; i++)
        if(s->channel[i].write) s->channel[i].write(s->channel[i].write_data);
}

static void write_settings(struct hm2 *hm2, void *state, bool force)
{
    struct bspi *s = state;
    int i;
    (void)hm2;
    for(i = 0; force && i < s->count; i++) write_descriptors(&s->channel[i]);
}

const struct hm2_function_ops hm2_bspi = {
    .gtag = {HM2_GTAG_BSPI},
    .claim = claim,
    .process = process,
    .prepare = prepare,
    .write = write_settings,
};

/* ---- For drivers ---------------------------------------------------------- */

static struct channel *find(const char *name)
{
    struct hm2 *hm2;
    int i;
    for(hm2 = hm2_boards; hm2; hm2 = hm2->next) {
        struct bspi *s = hm2_state(hm2, &hm2_bspi);
        for(i = 0; s && i < s->count; i++)
            if(!strcmp(s->channel[i].name, name)) return &s->channel[i];
    }
    if(rtapi_task_self() < 0) rtapi_print_msg(RTAPI_MSG_ERR, "hm2: no board has a buffered SPI channel '%s'\n", name);
    return NULL;
}

static struct channel *find_frame(const char *name, int frame)
{
    struct channel *c = find(name);
    return c && frame >= 0 && frame < FRAMES ? c : NULL;
}

int hm2_bspi_setup_chan(char *name, int chan, int cs, int bits, double mhz, int delay, int cpol, int cpha, int noclear,
                        int noecho, int samplelate)
{
    struct channel *c = find_frame(name, chan);
    if(!c || cs < 0 || cs > 15 || bits < 1 || bits > 64 || delay < 0 || delay > 1000000 || !(mhz > 0)) return -1;
    if(mhz > c->clock_mhz / 2) mhz = c->clock_mhz / 2;
    double divider = hm2_clip(c->clock_mhz / (mhz * 2) - 1, 0, 255);
    rtapi_u32 wait = delay ? (rtapi_u32)(delay * c->clock_mhz / 1000 - 1) & 0x1F : 0x10;
    c->descriptor[chan] = (rtapi_u32)(noecho != 0) << CD_NO_ECHO | (rtapi_u32)(noclear != 0) << CD_NO_CLEAR |
                          (rtapi_u32)(samplelate != 0) << CD_SAMPLE_LATE | wait << CD_DELAY | (rtapi_u32)cs << CD_CS |
                          (rtapi_u32)divider << CD_DIVIDER | (rtapi_u32)(cpha != 0) << CD_CPHA |
                          (rtapi_u32)(cpol != 0) << CD_CPOL | (rtapi_u32)(bits - 1);
    write_descriptors(c);
    return 0;
}
EXPORT_SYMBOL(hm2_bspi_setup_chan);

int hm2_bspi_set_read_function(char *name, int (*func)(void *subdata), void *subdata)
{
    struct channel *c = find(name);
    if(!c || !func) return -1;
    c->read_data = subdata;
    c->read = func;
    return 0;
}
EXPORT_SYMBOL(hm2_bspi_set_read_function);

int hm2_bspi_set_write_function(char *name, int (*func)(void *subdata), void *subdata)
{
    struct channel *c = find(name);
    if(!c || !func) return -1;
    c->write_data = subdata;
    c->write = func;
    return 0;
}
EXPORT_SYMBOL(hm2_bspi_set_write_function);

int hm2_bspi_write_chan(char *name, int chan, rtapi_u32 val)
{
    struct channel *c = find_frame(name, chan);
    if(!c) return -1;
    hm2_queue_write(c->hm2, c->addr[chan], val);
    return 0;
}
EXPORT_SYMBOL(hm2_bspi_write_chan);

int hm2_tram_add_bspi_frame(char *name, int chan, rtapi_u32 **wbuff, rtapi_u32 **rbuff)
{
    struct channel *c = find_frame(name, chan);
    if(!c || !wbuff) return -1;
    bool echo = !(c->descriptor[chan] >> CD_NO_ECHO);
    if(echo && !rbuff) return -1;
    *wbuff = hm2_write_region(c->hm2, c->addr[chan], 1);
    if(echo) *rbuff = hm2_read_region(c->hm2, c->echo_addr, 1);
    return *wbuff && (!echo || *rbuff) ? 0 : -1;
}
EXPORT_SYMBOL(hm2_tram_add_bspi_frame);

/* Frames have their memory from the start. */
int hm2_allocate_bspi_tram(char *name)
{
    return find(name) ? 0 : -1;
}
EXPORT_SYMBOL(hm2_allocate_bspi_tram);

int hm2_bspi_clear_fifo(char *name)
{
    struct channel *c = find(name);
    if(!c) return -1;
    hm2_queue_write(c->hm2, c->count_addr, 0);
    return 0;
}
EXPORT_SYMBOL(hm2_bspi_clear_fifo);
