/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hm2_spi_link.h - HostMot2 boards on an SPI bus of the kernel (/dev/spidev...).
 */
#ifndef HM2_SPI_LINK_H
#define HM2_SPI_LINK_H

#include "hm2_llio.h"
#include "components/comp_util.h"

#define SPI_WORDS 1024                 /* of one transfer */
#define SPI_READS 64

struct spi_board {
    struct hm2_llio io;
    int fd;                            /* -1: closed */
    rtapi_u32 read_hz, write_hz;
    bool queues;                       /* one transfer for all reads of a cycle */
    const char *path;
    rtapi_u32 reads[SPI_WORDS], writes[SPI_WORDS];
    int used_reads, used_writes;       /* words */
    struct {
        void *buffer;
        int at, words;
    } queued[SPI_READS];
    int num_queued;
    bool told;                         /* the bus failed */
};

/* [init] Opens the device, finds out which board it is and registers it; number: of its kind so far
 * among before[n]. 0 or -errno, with a message. */
int spi_board_start(struct spi_board *b, const char *driver, const char *path, int comp_id, const char *config,
                    struct spi_board *const *before, int n);
/* Boards by bus and chip select: bit n of probe is place n of SPI0/CE0, CE1, SPI1/CE0, CE1, CE2. Lists
 * in the order of the boards; a path of NULL or empty is the usual one, a rate up to 0 the default. */
#define SPI_PLACES 5
struct spi_places {
    const char *driver;
    int probe, most;                   /* places that this driver knows */
    int khz[SPI_PLACES], khz_read[SPI_PLACES], default_khz;
    char **path, **config;
    bool queues;
};
/* [init] Component and boards: 0 or -errno, with a message; and their end. */
int spi_places_start(const struct spi_places *p);
void spi_places_stop(void);
/* [init] */
void spi_board_stop(struct spi_board *b);

#endif
