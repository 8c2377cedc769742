/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hm2_7i43.c - 7I43 boards on parallel ports. [init]; the rest: hm2_epp_link.c
 */
#include <rtapi_app.h>
#include "hm2_epp_link.h"

MODULE_LICENSE("GPL");
MODULE_AUTHOR("Kerf developers");
MODULE_DESCRIPTION("7I43 boards on parallel ports");

static int ioaddr[EPP_BOARDS] = {0, -1, -1, -1, -1, -1, -1, -1};
RTAPI_MP_ARRAY_INT(ioaddr, EPP_BOARDS, "port of each board: address, or number of Linux' port");
static int ioaddr_hi[EPP_BOARDS];
RTAPI_MP_ARRAY_INT(ioaddr_hi, EPP_BOARDS, "extended registers of each port; 0: 0x400 above it");
static int epp_wide[EPP_BOARDS] = {1, 1, 1, 1, 1, 1, 1, 1};
RTAPI_MP_ARRAY_INT(epp_wide, EPP_BOARDS, "0: bytes; 1: 32 bits at once if the port can");
static char *config[EPP_BOARDS];
RTAPI_MP_ARRAY_STRING(config, EPP_BOARDS, "config string of each board");
static int debug_epp;
RTAPI_MP_INT(debug_epp, "nonzero tells the ports");

static const struct epp_model this_board = {
    .driver = "hm2_7i43", .connectors = 2, .connector = {"P4", "P3"}, .leds = 8, .programmed_elsewhere = true,
    .ioaddr = ioaddr, .ioaddr_hi = ioaddr_hi, .wide = epp_wide, .config = config, .debug = &debug_epp,
};

int rtapi_app_main(void)
{
    return epp_start(&this_board);
}

void rtapi_app_exit(void)
{
    epp_stop();
}
