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

#define MAX_BOARDS 5
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

static const char *const usual_path[MAX_BOARDS] = {"/dev/spidev0.0", "/dev/spidev0.1", "/dev/spidev1.0",
                                                   "/dev/spidev1.1", "/dev/spidev1.2"};
static struct spi_board *board[MAX_BOARDS];
static int comp_id, boards;

static void stop(void)
{
    while(boards > 0) spi_board_stop(board[--boards]);
}

static int start_board(int place)
{
    struct spi_board *b = hal_malloc(sizeof *b);
    const char *own = spidev_path[boards];
    int khz = spiclk_rate[boards] > 0 ? spiclk_rate[boards] : DEFAULT_KHZ;
    int khz_read = spiclk_rate_rd[boards] > 0 ? spiclk_rate_rd[boards] : khz;
    if(!b) return -ENOMEM;
    b->fd = -1;
    b->queues = !spi_noqueue;
    b->write_hz = (rtapi_u32)(khz + 1) * 1000;
    b->read_hz = (rtapi_u32)(khz_read + 1) * 1000;
    board[boards++] = b;
    return spi_board_start(b, "hm2_spix", own && *own ? own : usual_path[place], comp_id, config[boards - 1], board,
                           boards - 1);
}

static int start(void)
{
    int place;
    if(*force_driver && strcmp(force_driver, "spix_spidev")) {
        rtapi_print_msg(RTAPI_MSG_ERR, "hm2_spix: force_driver=%s: there is only spix_spidev here\n", force_driver);
        return -EINVAL;
    }
    if(!(spi_probe & 31)) {
        rtapi_print_msg(RTAPI_MSG_ERR,
                        "hm2_spix: spi_probe=%d looks nowhere: add up 1 SPI0/CE0, 2 SPI0/CE1, 4 SPI1/CE0, "
                        "8 SPI1/CE1, 16 SPI1/CE2\n", spi_probe);
        return -EINVAL;
    }
    for(place = 0; place < MAX_BOARDS; place++)
        if(spi_probe >> place & 1) COMP_TRY(start_board(place));
    return 0;
}

int rtapi_app_main(void)
{
    int r;
    comp_id = hal_init("hm2_spix");
    if(comp_id < 0) return comp_id;
    r = start();
    if(r < 0) {
        hal_exit(comp_id);
        stop();
        return r;
    }
    return hal_ready(comp_id);
}

void rtapi_app_exit(void)
{
    hal_exit(comp_id);
    stop();
}
