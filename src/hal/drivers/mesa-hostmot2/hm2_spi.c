/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hm2_spi.c - HostMot2 boards on SPI, by the names of their devices. [init]; the rest: hm2_spi_link.c
 */
#include <rtapi_app.h>
#include "hm2_spi_link.h"

MODULE_LICENSE("GPL");
MODULE_AUTHOR("Kerf developers");
MODULE_DESCRIPTION("HostMot2 boards on SPI");

#define MAX_BOARDS 8
static char *spidev_path[MAX_BOARDS] = {"/dev/spidev1.0"};
RTAPI_MP_ARRAY_STRING(spidev_path, MAX_BOARDS, "device of each board");
static int spidev_rate[MAX_BOARDS] = {24000, 24000, 24000, 24000, 24000, 24000, 24000, 24000};
RTAPI_MP_ARRAY_INT(spidev_rate, MAX_BOARDS, "rate of each board, kHz");
static char *config[MAX_BOARDS];
RTAPI_MP_ARRAY_STRING(config, MAX_BOARDS, "config string of each board");

static struct spi_board *board[MAX_BOARDS];
static int comp_id, boards;

static void stop(void)
{
    while(boards > 0) spi_board_stop(board[--boards]);
}

static int start(void)
{
    int i;
    for(i = 0; i < MAX_BOARDS && spidev_path[i] && *spidev_path[i]; i++) {
        struct spi_board *b = hal_malloc(sizeof *b);
        if(!b) return -ENOMEM;
        b->fd = -1;
        b->queues = true;
        b->read_hz = b->write_hz = (rtapi_u32)(spidev_rate[i] > 0 ? spidev_rate[i] : 1) * 1000;
        board[boards++] = b;
        COMP_TRY(spi_board_start(b, "hm2_spi", spidev_path[i], comp_id, config[i], board, i));
    }
    return 0;
}

int rtapi_app_main(void)
{
    int r;
    comp_id = hal_init("hm2_spi");
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
