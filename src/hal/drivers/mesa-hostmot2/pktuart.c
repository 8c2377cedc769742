/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * pktuart.c - serial channels for whole frames, for drivers of what hangs on them
 * (hostmot2-serial.h).
 */
#include <rtapi_string.h>
#include "hm2.h"
#include "hostmot2-serial.h"

enum { DATA, COUNT, BITRATE, MODE, REGISTERS };

#define MAX_FRAMES 16
#define MAX_FRAME 1023                 /* bytes */
#define CLEAR 0x80010000u              /* of the mode register */
#define TX_AUTO 0x20u
#define TX_ENABLE 0x40u
#define RX_MASK_ENABLE 0x04u
#define RX_ENABLE 0x08u
#define PARITY_ENABLE 0x20000u
#define PARITY_ODD 0x40000u
#define TWO_STOP_BITS 0x80000u
#define GAP_TIMES_4 0x100000u
#define FRAMES(status) ((status) >> 16 & 0x1F)
#define MOST_GAP 255u

struct side {
    rtapi_u32 addr[REGISTERS];
    int version;
    double clock;
    bool present;
    rtapi_u32 bitrate, mode;           /* in the registers */
    rtapi_u32 *status;                 /* mode register, as read */
};

struct channel {
    char name[HAL_NAME_LEN + 1];
    struct hm2 *hm2;
    struct side tx, rx;
};

struct pktuart {
    int count;
    struct channel *channel;
};

/* ---- Registration --------------------------------------------------------- */

static int claim(struct hm2 *hm2, const struct hm2_md *md, void **state)
{
    struct pktuart *s = *state;
    int i, k, n = hm2_count(hm2, md, HM2_NUM_PKTUARTS);
    COMP_TRY(n);
    COMP_TRY(hm2_check_md(hm2, md, md->version <= 3 ? -1 : 3, REGISTERS, 4, 0xF));
    if(!n) return 0;
    if(!s) {
        s = *state = hal_malloc(sizeof *s);
        if(!s || !(s->channel = hal_malloc((long)sizeof *s->channel * n))) return -ENOMEM;
        s->count = n;
    }
    if(n > s->count) n = s->count;
    rtapi_u32 *status = hm2_read_region(hm2, hm2_register_addr(md, MODE, 0), n);
    if(!status) return -ENOMEM;
    for(i = 0; i < n; i++) {
        struct channel *c = &s->channel[i];
        struct side *side = md->gtag == HM2_GTAG_PKTUART_TX ? &c->tx : &c->rx;
        rtapi_snprintf(c->name, sizeof c->name, "%.40s.pktuart.%d", hm2->io->name, i);
        c->hm2 = hm2;
        for(k = 0; k < REGISTERS; k++) side->addr[k] = hm2_register_addr(md, k, i);
        side->version = md->version;
        side->clock = md->clock;
        side->status = &status[i];
        side->present = true;
    }
    hm2->instances[md->gtag] = (rtapi_u8)n;
    return n;
}

static void write_side(struct hm2 *hm2, const struct side *s)
{
    if(!s->bitrate) return; /* nobody has set it up */
    hm2_queue_write(hm2, s->addr[BITRATE], s->bitrate);
    hm2_queue_write(hm2, s->addr[MODE], s->mode);
}

static void write_settings(struct hm2 *hm2, void *state, bool force)
{
    struct pktuart *s = state;
    int i;
    for(i = 0; force && i < s->count; i++) {
        write_side(hm2, &s->channel[i].tx);
        write_side(hm2, &s->channel[i].rx);
    }
}

const struct hm2_function_ops hm2_pktuart = {
    .gtag = {HM2_GTAG_PKTUART_TX, HM2_GTAG_PKTUART_RX},
    .claim = claim,
    .write = write_settings,
};

/* ---- Set-up --------------------------------------------------------------- */

static struct channel *find(const char *name)
{
    struct hm2 *hm2;
    int i;
    for(hm2 = hm2_boards; hm2; hm2 = hm2->next) {
        struct pktuart *s = hm2_state(hm2, &hm2_pktuart);
        for(i = 0; s && i < s->count; i++)
            if(!strcmp(s->channel[i].name, name) && s->channel[i].tx.present && s->channel[i].rx.present)
                return &s->channel[i];
    }
    if(rtapi_task_self() < 0) rtapi_print_msg(RTAPI_MSG_ERR, "hm2: no board has a frame channel '%s'\n", name);
    return NULL;
}

static void put(struct channel *c, rtapi_u32 addr, rtapi_u32 value, bool queue)
{
    if(queue) hm2_queue_write(c->hm2, addr, value);
    else hm2_write_now(c->hm2, addr, value);
}

static rtapi_u32 rate_register(const struct side *s, rtapi_u32 baud)
{
    if(s->version < 2) return (rtapi_u32)hm2_clip(baud * 1048576.0 / s->clock, 1, 0xFFFFF);
    return (rtapi_u32)hm2_clip(baud * 16777216.0 / s->clock, 1, 0xFFFFFF);
}

/* Bit times between frames, as the version can have them. */
static rtapi_u32 gap_bits(const struct side *s, rtapi_u32 gap, bool transmit)
{
    if(gap <= MOST_GAP) return gap << 8;
    if(s->version < 3) return MOST_GAP << 8;
    if(gap > 4 * MOST_GAP) gap = 4 * MOST_GAP;
    return ((transmit ? (gap + 3) >> 2 : gap >> 2) << 8) | GAP_TIMES_4;
}

static rtapi_u32 frame_bits(const struct side *s, rtapi_u32 flags)
{
    rtapi_u32 mode = 0;
    if(flags & HM2_PKTUART_CONFIG_PARITYEN) mode |= PARITY_ENABLE;
    if(flags & HM2_PKTUART_CONFIG_PARITYODD) mode |= PARITY_ODD;
    if(flags & HM2_PKTUART_CONFIG_STOPBITS2 && s->version >= 3) mode |= TWO_STOP_BITS;
    return mode;
}

static void apply(struct channel *c, struct side *s, rtapi_u32 bitrate, rtapi_u32 mode, rtapi_u32 flags, bool queue)
{
    bool force = flags & HM2_PKTUART_CONFIG_FORCECONFIG;
    if(flags & HM2_PKTUART_CONFIG_FLUSH) put(c, s->addr[MODE], CLEAR, queue);
    if(force || bitrate != s->bitrate) put(c, s->addr[BITRATE], bitrate, queue);
    if(force || mode != s->mode || flags & HM2_PKTUART_CONFIG_FLUSH) put(c, s->addr[MODE], mode, queue);
    s->bitrate = bitrate;
    s->mode = mode;
}

static void configure_tx(struct channel *c, const hm2_pktuart_config_t *cfg, bool queue)
{
    rtapi_u32 mode = (cfg->drivedelay > 15 ? 15 : cfg->drivedelay) | gap_bits(&c->tx, cfg->ifdelay, true) |
                     frame_bits(&c->tx, cfg->flags);
    if(cfg->flags & HM2_PKTUART_CONFIG_DRIVEEN) mode |= TX_ENABLE;
    if(cfg->flags & HM2_PKTUART_CONFIG_DRIVEAUTO) mode |= TX_AUTO;
    apply(c, &c->tx, rate_register(&c->tx, cfg->baudrate), mode, cfg->flags, queue);
}

static void configure_rx(struct channel *c, const hm2_pktuart_config_t *cfg, bool queue)
{
    double hz = cfg->filterrate ? cfg->filterrate : 2.0 * cfg->baudrate;
    rtapi_u32 filter = (rtapi_u32)hm2_clip(c->rx.clock / hz, 0, c->rx.version < 2 ? 0xFF : 0xFFFF);
    rtapi_u32 rate = rate_register(&c->rx, cfg->baudrate);
    rtapi_u32 mode = gap_bits(&c->rx, cfg->ifdelay, false) | frame_bits(&c->rx, cfg->flags) | (filter & 0xFF) << 22;
    if(c->rx.version >= 2) rate |= filter >> 8 << 24;
    if(cfg->flags & HM2_PKTUART_CONFIG_RXEN) mode |= RX_ENABLE;
    if(cfg->flags & HM2_PKTUART_CONFIG_RXMASKEN) mode |= RX_MASK_ENABLE;
    apply(c, &c->rx, rate, mode, cfg->flags, queue);
}

int hm2_pktuart_config(const char *name, const hm2_pktuart_config_t *rxcfg, const hm2_pktuart_config_t *txcfg,
                       int queue)
{
    struct channel *c = find(name);
    if(!c || (rxcfg && !rxcfg->baudrate) || (txcfg && !txcfg->baudrate)) return -EINVAL;
    if(rxcfg) configure_rx(c, rxcfg, queue);
    if(txcfg) configure_tx(c, txcfg, queue);
    return 0;
}
EXPORT_SYMBOL(hm2_pktuart_config);

int hm2_pktuart_setup(char *name, unsigned int bitrate, rtapi_s32 tx_mode, rtapi_s32 rx_mode, int txclear, int rxclear)
{
    struct channel *c = find(name);
    if(!c || !bitrate) return -EINVAL;
    rtapi_u32 tx = tx_mode < 0 ? c->tx.mode : (rtapi_u32)tx_mode, rx = rx_mode < 0 ? c->rx.mode : (rtapi_u32)rx_mode;
    apply(c, &c->tx, rate_register(&c->tx, bitrate), tx, txclear ? HM2_PKTUART_CONFIG_FLUSH : 0, true);
    apply(c, &c->rx, rate_register(&c->rx, bitrate), rx, rxclear ? HM2_PKTUART_CONFIG_FLUSH : 0, true);
    return 0;
}
EXPORT_SYMBOL(hm2_pktuart_setup);

static rtapi_u32 parity_flags(unsigned int parity)
{
    return parity == 1 ? HM2_PKTUART_CONFIG_PARITYEN | HM2_PKTUART_CONFIG_PARITYODD
                       : parity == 2 ? HM2_PKTUART_CONFIG_PARITYEN : 0;
}

int hm2_pktuart_setup_rx(char *name, unsigned int bitrate, unsigned int filter_hz, unsigned int parity, int frame_delay,
                         bool rx_enable, bool rx_mask)
{
    hm2_pktuart_config_t cfg = {.baudrate = bitrate, .filterrate = filter_hz, .flags = parity_flags(parity)};
    cfg.ifdelay = frame_delay > 0 ? (rtapi_u32)frame_delay : 0;
    if(rx_enable) cfg.flags |= HM2_PKTUART_CONFIG_RXEN;
    if(rx_mask) cfg.flags |= HM2_PKTUART_CONFIG_RXMASKEN;
    return hm2_pktuart_config(name, &cfg, NULL, 1);
}
EXPORT_SYMBOL(hm2_pktuart_setup_rx);

int hm2_pktuart_setup_tx(char *name, unsigned int bitrate, unsigned int parity, int frame_delay, bool drive_enable,
                         bool drive_auto, int enable_delay)
{
    hm2_pktuart_config_t cfg = {.baudrate = bitrate, .flags = parity_flags(parity)};
    cfg.ifdelay = frame_delay > 0 ? (rtapi_u32)frame_delay : 0;
    cfg.drivedelay = enable_delay > 0 ? (rtapi_u32)enable_delay : 0;
    if(drive_enable) cfg.flags |= HM2_PKTUART_CONFIG_DRIVEEN;
    if(drive_auto) cfg.flags |= HM2_PKTUART_CONFIG_DRIVEAUTO;
    return hm2_pktuart_config(name, NULL, &cfg, 1);
}
EXPORT_SYMBOL(hm2_pktuart_setup_tx);

static int reset(const char *name, bool queue)
{
    struct channel *c = find(name);
    if(!c) return -EINVAL;
    put(c, c->tx.addr[MODE], CLEAR, queue);
    put(c, c->rx.addr[MODE], CLEAR, queue);
    put(c, c->tx.addr[MODE], c->tx.mode, queue);
    put(c, c->rx.addr[MODE], c->rx.mode, queue);
    return 0;
}

int hm2_pktuart_reset(char *name)
{
    return reset(name, false);
}
EXPORT_SYMBOL(hm2_pktuart_reset);

int hm2_pktuart_queue_reset(char *name)
{
    return reset(name, true);
}
EXPORT_SYMBOL(hm2_pktuart_queue_reset);

/* ---- Frames --------------------------------------------------------------- */

int hm2_pktuart_send(char *name, const unsigned char data[], rtapi_u8 *num_frames, const rtapi_u16 frame_sizes[])
{
    struct channel *c = find(name);
    int frame, wanted = *num_frames < MAX_FRAMES ? *num_frames : MAX_FRAMES, sent = 0;
    *num_frames = 0;
    if(!c) return -EINVAL;
    for(frame = 0; frame < wanted; frame++) {
        int at, k, size = frame_sizes[frame];
        if(size < 1 || size > MAX_FRAME) return -EINVAL;
        for(at = 0; at < size; at += 4) {
            rtapi_u32 word = 0;
            for(k = 0; k < 4 && at + k < size; k++) word |= (rtapi_u32)data[sent + at + k] << 8 * k;
            hm2_queue_write(c->hm2, c->tx.addr[DATA], word);
        }
        hm2_queue_write(c->hm2, c->tx.addr[COUNT], (rtapi_u32)size);
        sent += size;
        ++*num_frames;
    }
    return sent;
}
EXPORT_SYMBOL(hm2_pktuart_send);

static int read_word(struct channel *c, int reg, rtapi_u32 *word)
{
    return c->hm2->io->ops->read(c->hm2->io, c->rx.addr[reg], word, sizeof *word) ? 0 : -EIO;
}

int hm2_pktuart_read(char *name, unsigned char data[], rtapi_u8 *num_frames, rtapi_u16 *max_frame_length,
                     rtapi_u16 frame_sizes[])
{
    struct channel *c = find(name);
    int frame, wanted = *num_frames, total = 0, at, k;
    rtapi_u32 status, count, word;
    *num_frames = 0;
    if(!c) return -EINVAL;
    COMP_TRY(read_word(c, MODE, &status));
    if((int)FRAMES(status) < wanted) wanted = (int)FRAMES(status);
    for(frame = 0; frame < wanted; frame++) {
        COMP_TRY(read_word(c, COUNT, &count));
        int size = (int)(count & MAX_FRAME);
        if(size > *max_frame_length) return -EMSGSIZE;
        for(at = 0; at < size; at += 4) {
            COMP_TRY(read_word(c, DATA, &word));
            for(k = 0; k < 4 && at + k < size; k++) data[total + at + k] = (unsigned char)(word >> 8 * k);
        }
        frame_sizes[frame] = (rtapi_u16)size;
        total += size;
        ++*num_frames;
    }
    return total;
}
EXPORT_SYMBOL(hm2_pktuart_read);

static int queue_words(struct channel *c, int reg, rtapi_u32 *to, int n)
{
    const struct hm2_llio_ops *ops = c->hm2->io->ops;
    int i;
    for(i = 0; i < n; i++)
        if(!(ops->queue_read ? ops->queue_read : ops->read)(c->hm2->io, c->rx.addr[reg], &to[i],
                                                            sizeof to[i])) return -EIO;
    return n - 1;
}

int hm2_pktuart_queue_get_frame_sizes(char *name, rtapi_u32 fsizes[])
{
    struct channel *c = find(name);
    if(!c) return -EINVAL;
    int n = (int)FRAMES(*c->rx.status);
    return queue_words(c, COUNT, fsizes, n < MAX_FRAMES ? n : MAX_FRAMES);
}
EXPORT_SYMBOL(hm2_pktuart_queue_get_frame_sizes);

int hm2_pktuart_queue_read_data(char *name, rtapi_u32 *data, int bytes)
{
    struct channel *c = find(name);
    return c && bytes >= 0 ? queue_words(c, DATA, data, (bytes + 3) / 4) : -EINVAL;
}
EXPORT_SYMBOL(hm2_pktuart_queue_read_data);

int hm2_pktuart_get_clock(char *name)
{
    struct channel *c = find(name);
    return c ? (int)c->tx.clock : -EINVAL;
}
EXPORT_SYMBOL(hm2_pktuart_get_clock);

int hm2_pktuart_get_version(char *name)
{
    struct channel *c = find(name);
    return c ? 16 * c->rx.version + c->tx.version : -EINVAL;
}
EXPORT_SYMBOL(hm2_pktuart_get_version);

rtapi_u32 hm2_pktuart_get_rx_status(char *name)
{
    struct channel *c = find(name);
    return c ? *c->rx.status : (rtapi_u32)-EINVAL;
}
EXPORT_SYMBOL(hm2_pktuart_get_rx_status);

rtapi_u32 hm2_pktuart_get_tx_status(char *name)
{
    struct channel *c = find(name);
    return c ? *c->tx.status : (rtapi_u32)-EINVAL;
}
EXPORT_SYMBOL(hm2_pktuart_get_tx_status);
