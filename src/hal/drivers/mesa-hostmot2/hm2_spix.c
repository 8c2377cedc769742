/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hm2_spix.c - HostMot2 boards on SPI, by bus and chip select. Uses the kernel's SPI driver on every
 * computer. [init]; the rest: hm2_spi_link.c
 */
#include <string.h>
#include <rtapi_app.h>
#include "hm2_spi_link.h"

MODULE_LICENSE("GPL");
MODULE_AUTHOR("Kerf developers");
MODULE_DESCRIPTION("HostMot2 boards on SPI");

#define MAX_BOARDS SPI_PLACES
#define DEFAULT_KHZ 25000
static char *config[MAX_BOARDS];
RTAPI_MP_ARRAY_STRING(config, MAX_BOARDS, "config string of each board");
static int spiclk_rate[MAX_BOARDS];
RTAPI_MP_ARRAY_INT(spiclk_rate, MAX_BOARDS, "rate of each board, kHz (25000)");
static int spiclk_rate_rd[MAX_BOARDS];
RTAPI_MP_ARRAY_INT(spiclk_rate_rd, MAX_BOARDS, "rate of reading, kHz (that of writing)");
static int spi_probe = 1;
RTAPI_MP_INT(spi_probe, "where to look: 1 SPI0/CE0, 2 SPI0/CE1, 4 SPI1/CE0, 8 SPI1/CE1, 16 SPI1/CE2");
static char *force_driver = "";
RTAPI_MP_STRING(force_driver, "spix_spidev");
static char *spidev_path[MAX_BOARDS];
RTAPI_MP_ARRAY_STRING(spidev_path, MAX_BOARDS, "device of each place, if it is not the usual one");
static int spi_noqueue;
RTAPI_MP_INT(spi_noqueue, "nonzero: a transfer for each block");
static int spi_debug = -1;
RTAPI_MP_INT(spi_debug, "without effect");
static int spi_pull_miso = -1, spi_pull_mosi = -1, spi_pull_sclk = -1;
RTAPI_MP_INT(spi_pull_miso, "obsolete");
RTAPI_MP_INT(spi_pull_mosi, "obsolete");
RTAPI_MP_INT(spi_pull_sclk, "obsolete");

int rtapi_app_main(void)
{
    struct spi_places places = {.driver = "hm2_spix", .probe = spi_probe, .most = MAX_BOARDS,
        .default_khz = DEFAULT_KHZ,
                                .path = spidev_path, .config = config, .queues = !spi_noqueue};
    if(*force_driver && strcmp(force_driver, "spix_spidev")) {
        rtapi_print_msg(RTAPI_MSG_ERR, "hm2_spix: force_driver=%s: there is only spix_spidev here\n", force_driver);
        return -EINVAL;
    }
    memcpy(places.khz, spiclk_rate, sizeof places.khz);
    memcpy(places.khz_read, spiclk_rate_rd, sizeof places.khz_read);
    return spi_places_start(&places);
}

void rtapi_app_exit(void)
{
    spi_places_stop();
}
