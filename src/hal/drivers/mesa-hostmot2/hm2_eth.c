/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hm2_eth.c - HostMot2 boards on the network.
 *
 * Loading sets up the network (hm2_eth_net.c) and finds out which board answers; in a cycle only
 * packets go (hm2_eth_packet.c).
 */
#include <ctype.h>
#include <string.h>
#include <rtapi_app.h>
#include "hm2_eth.h"

MODULE_LICENSE("GPL");
MODULE_AUTHOR("Kerf developers");
MODULE_DESCRIPTION("HostMot2 boards on the network");

static char *board_ip[ETH_MAX_BOARDS];
RTAPI_MP_ARRAY_STRING(board_ip, ETH_MAX_BOARDS, "address of each board");
static char *config[ETH_MAX_BOARDS];
RTAPI_MP_ARRAY_STRING(config, ETH_MAX_BOARDS, "config string of each board");
static char *board_rtnet[ETH_MAX_BOARDS];
RTAPI_MP_ARRAY_STRING(board_rtnet, ETH_MAX_BOARDS, "network of each board: posix");
static char *firewall = "auto";
RTAPI_MP_STRING(firewall, "auto, iptables, nft or none");
static int debug;
RTAPI_MP_INT(debug, "nonzero prints the packets");

#define ADDR_IDROM_OFFSET 0x010C
#define IDROM_IO_PORTS 0x1C
#define IDROM_PORT_WIDTH 0x24

static int comp_id;
static struct eth_board *board[ETH_MAX_BOARDS];
static int boards;

/* Name of the board, from its own information. */
static int read_name(struct eth_board *b, char name[ETH_NAME_LEN + 1])
{
    int i, r = eth_read_space(b, SPACE_INFO, 0, name, ETH_NAME_LEN / 2, 2);
    name[ETH_NAME_LEN] = 0;
    if(r < 0)
        rtapi_print_msg(RTAPI_MSG_ERR, "hm2_eth: ERROR: could not read the name of board %s: %s\n", b->ip,
                        strerror(-r));
    for(i = 0; i < ETH_NAME_LEN && name[i]; i++)
        if(!isprint((unsigned char)name[i])) name[i] = '?';
    return r;
}

static int read_mac(struct eth_board *b)
{
    rtapi_u8 reversed[6];
    int i, r = eth_read_space(b, SPACE_EEPROM, 2, reversed, 3, 2);
    if(r < 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "hm2_eth: ERROR: Could not retrieve hardware address (MAC) of %s: %s\n", b->ip,
                        strerror(-r));
        rtapi_print_msg(RTAPI_MSG_ERR, "hm2_eth: does `ping %s` reach it? Is another program using the board?\n",
                        b->ip);
        return r;
    }
    for(i = 0; i < 6; i++) b->mac[i] = reversed[5 - i];
    rtapi_print("hm2_eth: INFO: Hardware address (MAC): %02x:%02x:%02x:%02x:%02x:%02x\n", b->mac[0], b->mac[1],
                b->mac[2],
                b->mac[3], b->mac[4], b->mac[5]);
    return 0;
}

/* A board that no table has: as many connectors as its firmware says, without names. */
static int guess_model(struct eth_board *b, const char *name, struct eth_model *m)
{
    rtapi_u32 offset = 0, ports = 0, width = 0;
    int i;
    rtapi_print_msg(RTAPI_MSG_ERR, "Unrecognized ethernet board found: %.16s -- port names will be wrong\n", name);
    COMP_TRY(eth_read_space(b, SPACE_HM2, ADDR_IDROM_OFFSET, &offset, 1, 4));
    offset &= 0xFFFF;
    COMP_TRY(eth_read_space(b, SPACE_HM2, offset + IDROM_IO_PORTS, &ports, 1, 4));
    COMP_TRY(eth_read_space(b, SPACE_HM2, offset + IDROM_PORT_WIDTH, &width, 1, 4));
    memset(m, 0, sizeof *m);
    m->connectors = ports <= HM2_MAX_CONNECTORS ? (int)ports : HM2_MAX_CONNECTORS;
    m->pins = width <= 32 ? (int)width : 0;
    for(i = 0; i < m->connectors; i++) m->connector[i] = "??";
    m->fpga = "??";
    return 0;
}

/* The name in HAL: of the kind of board, numbered among its kind. */
static void name_board(struct eth_board *b, const char *kind)
{
    size_t n;
    int i, number = 0;
    snprintf(b->io.name, sizeof b->io.name, "hm2_%s.", kind);
    n = strlen(b->io.name);
    for(i = 0; i < boards; i++)
        if(!strncmp(board[i]->io.name, b->io.name, n)) number++;
    snprintf(b->io.name + n, sizeof b->io.name - n, "%d", number);
}

static int identify(struct eth_board *b)
{
    char name[ETH_NAME_LEN + 1], kind[5] = "";
    const struct eth_model *known;
    struct eth_model guessed;
    int i;
    COMP_TRY(read_name(b, name));
    known = eth_find_model(name);
    if(!known) {
        COMP_TRY(guess_model(b, name, &guessed));
        for(i = 0; i < 4 && name[i]; i++) kind[i] = (char)tolower((unsigned char)name[i]);
    }
    const struct eth_model *m = known ? known : &guessed;
    name_board(b, known ? known->hal_name : kind);
    b->packs_all = !strncmp(name, "litehm2", 7);
    b->io.num_connectors = m->connectors;
    b->io.pins_per_connector = m->pins;
    memcpy(b->io.connector_name, m->connector, sizeof b->io.connector_name);
    b->io.io_name = m->io_name;
    b->io.io_names = m->io_names;
    b->io.num_leds = m->leds;
    b->io.fpga_part = m->fpga;
    rtapi_print("hm2_eth: discovered %.*s\n", ETH_NAME_LEN, name);
    return 0;
}

static int export_pins(struct eth_board *b)
{
    const char *name = b->io.name;
    COMP_TRY(hal_param_new_si32(comp_id, HAL_RW, &b->read_timeout, 80, "%s.packet-read-timeout", name));
    COMP_TRY(hal_param_new_si32(comp_id, HAL_RW, &b->error_limit, 10, "%s.packet-error-limit", name));
    COMP_TRY(hal_param_new_si32(comp_id, HAL_RW, &b->error_increment, 2, "%s.packet-error-increment", name));
    COMP_TRY(hal_param_new_si32(comp_id, HAL_RO, &b->error_decrement, 1, "%s.packet-error-decrement", name));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_OUT, &b->error, 0, "%s.packet-error", name));
    COMP_TRY(hal_pin_new_ui32(comp_id, HAL_IO, &b->error_total, 0, "%s.packet-error-total", name));
    COMP_TRY(hal_pin_new_si32(comp_id, HAL_OUT, &b->error_level, 0, "%s.packet-error-level", name));
    return hal_pin_new_bool(comp_id, HAL_OUT, &b->error_exceeded, 0, "%s.packet-error-exceeded", name);
}

/* Network only: afterwards the firewall can be set up for all boards. */
static int reach_board(int n)
{
    struct eth_board *b = hal_malloc(sizeof *b);
    const char *net = board_rtnet[n];
    if(!b) return -ENOMEM;
    if(net && *net && strcmp(net, "posix")) {
        rtapi_print_msg(RTAPI_MSG_ERR, "hm2_eth: ERROR: board_rtnet=%s: only posix is supported here\n", net);
        return -EINVAL;
    }
    b->told_iteration = 1u << 31; /* long ago */
    b->fd = -1;
    b->ip = board_ip[n];
    b->io.ops = &eth_ops;
    b->io.comp_id = comp_id;
    b->io.split_read = true;
    board[boards++] = b;
    COMP_TRY(eth_open(b));
    COMP_TRY(read_mac(b));
    eth_set_arp(b);
    return 0;
}

static int start(void)
{
    int n;
    for(n = 0; n < ETH_MAX_BOARDS && board_ip[n] && *board_ip[n]; n++) COMP_TRY(reach_board(n));
    eth_firewall_start(firewall, board, boards);
    int all = boards;
    for(n = 0; n < all; n++) {
        boards = n; /* so many have a name */
        int r = identify(board[n]);
        if(r == 0) r = export_pins(board[n]);
        if(r == 0) r = hm2_register(&board[n]->io, config[n]);
        boards = all;
        if(r < 0) return r;
    }
    return 0;
}

static void stop(void)
{
    int n;
    for(n = 0; n < boards; n++) {
        hm2_unregister(&board[n]->io);
        eth_close(board[n]);
    }
    boards = 0;
    eth_firewall_stop();
}

/* HAL function hm2_eth.realtime-init: nothing is left to do here with a posix network. */
static void realtime_init(void *arg, long period)
{
    (void)arg;
    (void)period;
}

int rtapi_app_main(void)
{
    int r;
    rtapi_print("hm2_eth: loading Mesa AnyIO HostMot2 ethernet driver version 0.2\n");
    eth_debug = debug;
    comp_id = hal_init("hm2_eth");
    if(comp_id < 0) return comp_id;
    r = start();
    if(r >= 0) r = hal_export_funct("hm2_eth.realtime-init", realtime_init, NULL, 0, 0, comp_id);
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
