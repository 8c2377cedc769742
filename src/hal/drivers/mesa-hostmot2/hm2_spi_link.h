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
/* [init] */
void spi_board_stop(struct spi_board *b);

#endif
