/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * uart.c - serial channels for bytes, for drivers of what hangs on them (hostmot2-serial.h).
 */
#include <rtapi_string.h>
#include "hm2.h"
#include "hostmot2-serial.h"

enum { DATA, FIFO_COUNT, BITRATE, MODE, REGISTERS };

#define FIFO 16                        /* bytes */
#define TX_MODE_MASK 0x7F
#define RX_MODE_MASK 0xFF
#define COUNT_MASK 0x1F

struct channel {
    char name[HAL_NAME_LEN + 1];
    struct hm2 *hm2;
    rtapi_u32 tx[REGISTERS], rx[REGISTERS]; /* addresses; 0: no such side */
    double clock;
    rtapi_u32 bitrate, tx_mode, rx_mode;    /* in the registers */
};

struct uart {
    int count;
    struct channel *channel;
};

static int claim(struct hm2 *hm2, const struct hm2_md *md, void **state)
{
    struct uart *s = *state;
    int i, k, n = hm2_count(hm2, md, HM2_NUM_UARTS);
    COMP_TRY(n);
    COMP_TRY(hm2_check_md(hm2, md, 0, REGISTERS, 0x10, 0xF));
    if(!n) return 0;
    if(!s) {
        s = *state = hal_malloc(sizeof *s);
        if(!s || !(s->channel = hal_malloc((long)sizeof *s->channel * n))) return -ENOMEM;
        s->count = n;
    }
    if(n > s->count) n = s->count;
    for(i = 0; i < n; i++) {
        struct channel *c = &s->channel[i];
        rtapi_u32 *addr = md->gtag == HM2_GTAG_UART_TX ? c->tx : c->rx;
        rtapi_snprintf(c->name, sizeof c->name, "%.40s.uart.%d", hm2->io->name, i);
        c->hm2 = hm2;
        c->clock = md->clock;
        for(k = 0; k < REGISTERS; k++) addr[k] = hm2_register_addr(md, k, i);
    }
    hm2->instances[md->gtag] = (rtapi_u8)n;
    return n;
}

static void write_channel(struct channel *c)
{
    if(!c->bitrate) return; /* nobody has set it up */
    hm2_queue_write(c->hm2, c->tx[BITRATE], c->bitrate);
    hm2_queue_write(c->hm2, c->rx[BITRATE], c->bitrate);
    hm2_queue_write(c->hm2, c->tx[MODE], c->tx_mode);
    hm2_queue_write(c->hm2, c->rx[MODE], c->rx_mode);
}

static void write_settings(struct hm2 *hm2, void *state, bool force)
{
    struct uart *s = state;
    int i;
    (void)hm2;
    for(i = 0; force && i < s->count; i++) write_channel(&s->channel[i]);
}

const struct hm2_function_ops hm2_uart = {
    .gtag = {HM2_GTAG_UART_TX, HM2_GTAG_UART_RX},
    .claim = claim,
    .write = write_settings,
};

/* ---- For drivers ---------------------------------------------------------- */

static struct channel *find(const char *name)
{
    struct hm2 *hm2;
    int i;
    for(hm2 = hm2_boards; hm2; hm2 = hm2->next) {
        struct uart *s = hm2_state(hm2, &hm2_uart);
        for(i = 0; s && i < s->count; i++)
            if(!strcmp(s->channel[i].name, name) && s->channel[i].tx[DATA] && s->channel[i].rx[DATA])
                return &s->channel[i];
    }
    if(rtapi_task_self() < 0) rtapi_print_msg(RTAPI_MSG_ERR, "hm2: no board has a serial channel '%s'\n", name);
    return NULL;
}

int hm2_uart_setup(char *name, int bitrate, rtapi_s32 tx_mode, rtapi_s32 rx_mode)
{
    struct channel *c = find(name);
    if(!c || bitrate <= 0) return -EINVAL;
    double reg = hm2_clip(bitrate * 1048576.0 / c->clock, 1, 0xFFFFF);
    if((rtapi_u32)reg != c->bitrate) {
        c->bitrate = (rtapi_u32)reg;
        c->rx_mode = 0;
        hm2_queue_write(c->hm2, c->rx[MODE], 0);
        hm2_queue_write(c->hm2, c->tx[FIFO_COUNT], 0);
        hm2_queue_write(c->hm2, c->rx[FIFO_COUNT], 0);
    }
    if(tx_mode >= 0) c->tx_mode = (rtapi_u32)tx_mode & TX_MODE_MASK;
    if(rx_mode >= 0) c->rx_mode = (rtapi_u32)rx_mode & RX_MODE_MASK;
    write_channel(c);
    return 0;
}
EXPORT_SYMBOL(hm2_uart_setup);

/* Up to four bytes in a register; which one says how many. */
int hm2_uart_send(char *name, unsigned char data[], int count)
{
    struct channel *c = find(name);
    int at = 0, k;
    if(!c || count < 0) return -EINVAL;
    if(!c->bitrate) {
        rtapi_print_msg(RTAPI_MSG_ERR, "%s is not set up: it has no bit rate\n", name);
        return -EINVAL;
    }
    if(count > FIFO) count = FIFO;
    while(at < count) {
        int n = count - at < 4 ? count - at : 4;
        rtapi_u32 word = 0;
        for(k = 0; k < n; k++) word |= (rtapi_u32)data[at + k] << 8 * k;
        hm2_queue_write(c->hm2, c->tx[DATA] + 4 * (rtapi_u32)(n - 1), word);
        at += n;
    }
    return count;
}
EXPORT_SYMBOL(hm2_uart_send);

int hm2_uart_read(char *name, unsigned char data[])
{
    struct channel *c = find(name);
    rtapi_u32 word;
    int count, at = 0, k;
    if(!c) return -EINVAL;
    if(!c->hm2->io->ops->read(c->hm2->io, c->rx[FIFO_COUNT], &word, sizeof word)) return -EIO;
    count = (int)(word & COUNT_MASK);
    if(count > FIFO) count = FIFO;
    while(at < count) {
        int n = count - at < 4 ? count - at : 4;
        if(!c->hm2->io->ops->read(c->hm2->io, c->rx[DATA] + 4 * (rtapi_u32)(n - 1), &word, sizeof word)) return -EIO;
        for(k = 0; k < n; k++) data[at + k] = (unsigned char)(word >> 8 * k);
        at += n;
    }
    return count;
}
EXPORT_SYMBOL(hm2_uart_read);
