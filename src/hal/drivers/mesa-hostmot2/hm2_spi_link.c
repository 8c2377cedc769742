/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hm2_spi_link.c - transfers over SPI.
 *
 * A transfer is words of 32 bits, the highest byte first: a command, then its words; what is read
 * comes back in their places. The reads of a cycle are one transfer that ends with the cookie: when
 * that is wrong, none of it is believed.
 *
 * Thread: the transfers [servo]; the kernel moves the bytes meanwhile
 */
#include <errno.h>
#include <fcntl.h>
#include <linux/spi/spidev.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>
#include "hm2_spi_link.h"
#include "hm2_db25.h"

#define READ 0xA000u
#define WRITE 0xB000u
#define INCREMENT 0x0800u
#define MAX_COUNT 127
#define ADDR_COOKIE 0x0100
#define ADDR_BOARD_NAME 0x040C
#define COOKIE 0x55AACAFEu

/* ---- Names of pins ----------------------------------------------------------- */

static const char *const io_7c81[] = {
    DB25("P1"), "J5-TX0", "J6-TX1", DB25("P2"), "J5-TXEN0", "J6-TXEN1", DB25("P7"), "P5-RX0", "P6-RX1",
};

static const struct model {
    const char *name, *hal_name;
    int connectors, pins;
    const char *connector[3];
    int leds;
    const char *const *io_name;
    int io_names;
} models[] = {
    {"MESA7C80", "7c80", 2, 27, {"Embedded I/O", "Embedded I/O + P1 expansion"}, 4, NULL, 0},
    {"MESA7C81", "7c81", 3, 19, {"P1", "P2", "P7"}, 4, io_7c81, sizeof io_7c81 / sizeof io_7c81[0]},
    {"MESA7I90", "7i90", 3, 24, {"P1", "P2", "P3"}, 2, NULL, 0},
    {"MESA7I43", "7i43", 2, 24, {"P4", "P3"}, 8, NULL, 0},
};

/* ---- Transfers --------------------------------------------------------------- */

static int transfer(struct spi_board *b, rtapi_u32 *words, int n, rtapi_u32 hz)
{
    struct spi_ioc_transfer t = {.speed_hz = hz, .bits_per_word = 8, .len = (rtapi_u32)n * 4};
    int i, r;
    for(i = 0; i < n; i++) words[i] = __builtin_bswap32(words[i]);
    t.tx_buf = t.rx_buf = (__u64)(unsigned long)words;
    r = ioctl(b->fd, SPI_IOC_MESSAGE(1), &t);
    for(i = 0; i < n; i++) words[i] = __builtin_bswap32(words[i]);
    if(r >= 0) return 1;
    if(!b->told) rtapi_print_msg(RTAPI_MSG_ERR, "%s: transfer over %s failed: %s\n", b->io.name, b->path,
                                 strerror(errno));
    b->told = true;
    hm2_llio_fail(&b->io);
    return 0;
}

static rtapi_u32 command(rtapi_u32 what, rtapi_u32 addr, int count)
{
    return addr << 16 | what | INCREMENT | (rtapi_u32)count << 4;
}

static int read_now(struct hm2_llio *io, rtapi_u32 addr, void *buffer, int bytes)
{
    struct spi_board *b = (struct spi_board *)io;
    rtapi_u32 words[MAX_COUNT + 1] = {0};
    int n = bytes / 4;
    if(n < 1 || n > MAX_COUNT) return 0;
    words[0] = command(READ, addr, n);
    if(!transfer(b, words, n + 1, b->read_hz)) return 0;
    memcpy(buffer, words + 1, (size_t)n * 4);
    return 1;
}

static int write_now(struct hm2_llio *io, rtapi_u32 addr, const void *buffer, int bytes)
{
    struct spi_board *b = (struct spi_board *)io;
    rtapi_u32 words[MAX_COUNT + 1];
    int n = bytes / 4;
    if(n < 1 || n > MAX_COUNT) return 0;
    words[0] = command(WRITE, addr, n);
    memcpy(words + 1, buffer, (size_t)n * 4);
    return transfer(b, words, n + 1, b->write_hz);
}

static int queue_read(struct hm2_llio *io, rtapi_u32 addr, void *buffer, int bytes)
{
    struct spi_board *b = (struct spi_board *)io;
    int n = bytes / 4;
    if(!b->queues) return read_now(io, addr, buffer, bytes);
    if(n < 1 || n > MAX_COUNT || b->num_queued == SPI_READS || b->used_reads + n + 3 > SPI_WORDS) return 0;
    b->reads[b->used_reads] = command(READ, addr, n);
    memset(b->reads + b->used_reads + 1, 0, (size_t)n * 4);
    b->queued[b->num_queued].buffer = buffer;
    b->queued[b->num_queued].at = b->used_reads + 1;
    b->queued[b->num_queued++].words = n;
    b->used_reads += n + 1;
    return 1;
}

static int send_reads(struct hm2_llio *io)
{
    (void)io;
    return 1; /* the answer comes while the question goes */
}

static int receive_reads(struct hm2_llio *io)
{
    struct spi_board *b = (struct spi_board *)io;
    int i, at = b->used_reads, n = b->num_queued;
    b->used_reads = b->num_queued = 0;
    if(!at) return 1;
    b->reads[at] = command(READ, ADDR_COOKIE, 1);
    b->reads[at + 1] = 0;
    if(!transfer(b, b->reads, at + 2, b->read_hz)) return 0;
    if(b->reads[at + 1] != COOKIE) {
        rtapi_print_msg(RTAPI_MSG_ERR, "%s: what came over %s is damaged (cookie 0x%08X): lower the rate, shorten the "
                        "cable\n", io->name, b->path, b->reads[at + 1]);
        hm2_llio_fail(io);
        return 0;
    }
    for(i = 0; i < n; i++) memcpy(b->queued[i].buffer, b->reads + b->queued[i].at, (size_t)b->queued[i].words * 4);
    return 1;
}

static int send_writes(struct hm2_llio *io)
{
    struct spi_board *b = (struct spi_board *)io;
    int n = b->used_writes;
    b->used_writes = 0;
    return !n || transfer(b, b->writes, n, b->write_hz);
}

static int queue_write(struct hm2_llio *io, rtapi_u32 addr, const void *buffer, int bytes)
{
    struct spi_board *b = (struct spi_board *)io;
    int n = bytes / 4;
    if(!b->queues) return write_now(io, addr, buffer, bytes);
    if(n < 1 || n > MAX_COUNT) return 0;
    if(b->used_writes + n + 1 > SPI_WORDS && !send_writes(io)) return 0;
    b->writes[b->used_writes] = command(WRITE, addr, n);
    memcpy(b->writes + b->used_writes + 1, buffer, (size_t)n * 4);
    b->used_writes += n + 1;
    return 1;
}

static const struct hm2_llio_ops ops = {
    .read = read_now,
    .write = write_now,
    .queue_read = queue_read,
    .send_queued_reads = send_reads,
    .receive_queued_reads = receive_reads,
    .queue_write = queue_write,
    .send_queued_writes = send_writes,
};

/* ---- Boards [init] ------------------------------------------------------------ */

static int open_device(struct spi_board *b, const char *driver)
{
    __u8 mode = SPI_MODE_0, bits = 8;
    b->fd = rtapi_open_as_root(b->path, O_RDWR);
    if(b->fd < 0) {
        int error = -b->fd;
        b->fd = -1;
        rtapi_print_msg(RTAPI_MSG_ERR, "%s: cannot open %s: %s (is SPI switched on, dtparam=spi=on?)\n", driver,
                        b->path,
                        strerror(error));
        return -error;
    }
    if(ioctl(b->fd, SPI_IOC_WR_MODE, &mode) < 0 || ioctl(b->fd, SPI_IOC_WR_BITS_PER_WORD, &bits) < 0 ||
       ioctl(b->fd, SPI_IOC_WR_MAX_SPEED_HZ, &b->write_hz) < 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "%s: cannot set up %s: %s\n", driver, b->path, strerror(errno));
        return -EIO;
    }
    return 0;
}

static const struct model *identify(struct spi_board *b, const char *driver)
{
    static const rtapi_u32 expected[] = {COOKIE, 0x54534F48, 0x32544F4D, 0x00000400};
    rtapi_u32 got[4];
    char name[9] = "";
    size_t i;
    if(!read_now(&b->io, ADDR_COOKIE, got, sizeof got)) return NULL;
    if(memcmp(got, expected, sizeof got)) {
        rtapi_print_msg(RTAPI_MSG_ERR, "%s: no HostMot2 board answers at %s: got %08x %08x %08x %08x\n", driver,
                        b->path,
                        got[0], got[1], got[2], got[3]);
        return NULL;
    }
    if(!read_now(&b->io, ADDR_BOARD_NAME, name, 8)) return NULL;
    for(i = 0; i < sizeof models / sizeof models[0]; i++)
        if(!strcmp(name, models[i].name)) return &models[i];
    rtapi_print_msg(RTAPI_MSG_ERR, "set_llio_info_spi(): Unknown hostmot2 board name %.8s\n", name);
    return NULL;
}

int spi_board_start(struct spi_board *b, const char *driver, const char *path, int comp_id, const char *config,
                    struct spi_board *const *before, int n)
{
    const struct model *m;
    int i, number = 0;
    b->path = path;
    rtapi_snprintf(b->io.name, sizeof b->io.name, "%s", driver);
    COMP_TRY(open_device(b, driver));
    m = identify(b, driver);
    if(!m) return -ENODEV;
    for(i = 0; i < n; i++)
        if(!strncmp(before[i]->io.name + 4, m->hal_name, 4)) number++;
    rtapi_snprintf(b->io.name, sizeof b->io.name, "hm2_%s.%d", m->hal_name, number);
    b->io.ops = &ops;
    b->io.comp_id = comp_id;
    b->io.num_connectors = m->connectors;
    b->io.pins_per_connector = m->pins;
    for(i = 0; i < m->connectors; i++) b->io.connector_name[i] = m->connector[i];
    b->io.io_name = m->io_name;
    b->io.io_names = m->io_names;
    b->io.num_leds = m->leds;
    b->io.fpga_part = "";
    return hm2_register(&b->io, config);
}

void spi_board_stop(struct spi_board *b)
{
    hm2_unregister(&b->io);
    if(b->fd >= 0) close(b->fd);
    b->fd = -1;
}

/* ---- Places [init] -------------------------------------------------------------- */

static struct spi_board *placed[SPI_PLACES];
static int places_id, num_placed;

static int start_place(const struct spi_places *p, int place)
{
    static const char *const usual[SPI_PLACES] = {"/dev/spidev0.0", "/dev/spidev0.1", "/dev/spidev1.0",
                                                  "/dev/spidev1.1", "/dev/spidev1.2"};
    struct spi_board *b = hal_malloc(sizeof *b);
    int n = num_placed, khz = p->khz[n] > 0 ? p->khz[n] : p->default_khz;
    const char *own = p->path ? p->path[n] : NULL;
    if(!b) return -ENOMEM;
    b->fd = -1;
    b->queues = p->queues;
    b->write_hz = (rtapi_u32)(khz + 1) * 1000;
    b->read_hz = (rtapi_u32)((p->khz_read[n] > 0 ? p->khz_read[n] : khz) + 1) * 1000;
    placed[num_placed++] = b;
    return spi_board_start(b, p->driver, own && *own ? own : usual[place], places_id, p->config[n], placed, n);
}

int spi_places_start(const struct spi_places *p)
{
    int place, r = 0;
    if(!(p->probe & ((1 << p->most) - 1))) {
        rtapi_print_msg(RTAPI_MSG_ERR, "%s: spi_probe=%d looks nowhere: add up 1 SPI0/CE0, 2 SPI0/CE1, 4 SPI1/CE0, "
                        "8 SPI1/CE1, 16 SPI1/CE2\n", p->driver, p->probe);
        return -EINVAL;
    }
    places_id = hal_init(p->driver);
    if(places_id < 0) return places_id;
    for(place = 0; place < p->most && r >= 0; place++)
        if(p->probe >> place & 1) r = start_place(p, place);
    if(r >= 0) return hal_ready(places_id);
    spi_places_stop();
    return r;
}

void spi_places_stop(void)
{
    hal_exit(places_id);
    while(num_placed > 0) spi_board_stop(placed[--num_placed]);
}
