/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hm2_rpspi.c - HostMot2 boards on SPI, with the parameters of the driver for Raspberry Pi 2 and 3. Uses
 * the kernel's SPI driver. [init]; the rest: hm2_spi_link.c
 */
#include <rtapi_app.h>
#include "hm2_spi_link.h"

MODULE_LICENSE("GPL");
MODULE_AUTHOR("Kerf developers");
MODULE_DESCRIPTION("HostMot2 boards on SPI");

static char *config[SPI_PLACES];
RTAPI_MP_ARRAY_STRING(config, SPI_PLACES, "config string of each board");
static int spiclk_rate = 31250;
RTAPI_MP_INT(spiclk_rate, "rate, kHz");
static int spiclk_rate_rd = -1;
RTAPI_MP_INT(spiclk_rate_rd, "rate of reading, kHz (that of writing)");
static int spi_probe = 1;
RTAPI_MP_INT(spi_probe, "where to look: 1 SPI0/CE0, 2 SPI0/CE1, 4 SPI1/CE0, 8 SPI1/CE1, 16 SPI1/CE2");
static int spiclk_base = 400000000, spi_pull_miso = 1, spi_pull_mosi = 1, spi_pull_sclk = 1, spi_debug = -1;
RTAPI_MP_INT(spiclk_base, "without effect");
RTAPI_MP_INT(spi_pull_miso, "without effect");
RTAPI_MP_INT(spi_pull_mosi, "without effect");
RTAPI_MP_INT(spi_pull_sclk, "without effect");
RTAPI_MP_INT(spi_debug, "without effect");

int rtapi_app_main(void)
{
    struct spi_places places = {.driver = "hm2_rpspi", .probe = spi_probe, .most = SPI_PLACES,
        .default_khz = spiclk_rate,
                                .config = config, .queues = true};
    int i;
    for(i = 0; i < SPI_PLACES; i++) places.khz_read[i] = spiclk_rate_rd;
    return spi_places_start(&places);
}

void rtapi_app_exit(void)
{
    spi_places_stop();
}
