/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hm2_eth.h - boards on the network: packets of the protocol LBP16 over UDP.
 */
#ifndef HM2_ETH_H
#define HM2_ETH_H

#include <netinet/in.h>
#include "hm2_llio.h"
#include "components/comp_util.h"

#define ETH_PORT 27181
#define ETH_PACKET 1400                /* bytes, either way */
#define ETH_READS 64                   /* in one packet */
#define ETH_MAX_BOARDS 4
#define ETH_NAME_LEN 16

/* ---- LBP16: a command, then its address, then the data of a write; little-endian. */
#define LBP_WRITE 0x8000u
#define LBP_ADDRESS 0x4000u
#define LBP_SPACE(n) ((rtapi_u32)(n) << 10)
#define LBP_16BIT 0x0100u
#define LBP_32BIT 0x0200u
#define LBP_INCREMENT 0x0080u
#define LBP_MAX_COUNT 127
enum { SPACE_HM2 = 0, SPACE_EEPROM = 2, SPACE_TIMERS = 4, SPACE_STATUS = 6, SPACE_INFO = 7 };

struct eth_queued_read {
    void *buffer;
    int bytes;
};

struct eth_packet {
    rtapi_u8 data[ETH_PACKET];
    int used;
};

/* In HAL memory. */
struct eth_board {
    struct hm2_llio io;
    const char *ip;
    struct sockaddr_in remote, local;
    char interface[16];                /* empty: not found */
    bool loopback, arp_set;
    int fd;                            /* -1: closed */
    rtapi_u8 mac[6];
    bool packs_all;                    /* settings too go into one packet outside of realtime */
    bool enqueue;                      /* does so now */

    hal_sint_t read_timeout, error_limit, error_increment, error_decrement;
    hal_bool_t error, error_exceeded;
    hal_uint_t error_total;
    hal_sint_t error_level;

    struct eth_packet reads, writes, single; /* being put together */
    rtapi_u8 answer[ETH_PACKET];       /* the last one received */
    struct eth_queued_read queued[ETH_READS];
    int num_queued, expected;          /* of the answer, bytes */
    rtapi_u32 read_counter, write_counter;
    bool write_sent;
    bool lost;                         /* a packet did not fit or could not be sent */
    long long deadline;                /* of the answer, real time, ns */
    rtapi_u32 iterations, told_iteration; /* cycles; of the last message */
    int unanswered_writes;             /* single ones, outside of realtime */
    bool told_direct, told_full;       /* a direct read in a cycle; no room for a read */
};

/* What a board's name says. */
struct eth_model {
    const char *name;
    int compared;                      /* characters of it */
    const char *hal_name;
    int connectors, pins;              /* pins of each */
    const char *connector[HM2_MAX_CONNECTORS];
    const char *fpga;
    int leds;
    const char *const *io_name;
    int io_names;
};
/* NULL: not a known board. */
const struct eth_model *eth_find_model(const char *name);

/* ---- hm2_eth_packet.c ------------------------------------------------------ */

extern const struct hm2_llio_ops eth_ops;
extern int eth_debug;
/* [any] Real time, ns: a board does not wait for a simulated clock. */
long long eth_now(void);
/* [any] Reads count elements of size bytes from a memory space. In a cycle waits as long as for the
 * cycle's answer, else up to 200 ms, and asks again a few times. 0 or -errno. */
int eth_read_space(struct eth_board *b, int space, rtapi_u32 addr, void *buffer, int count, int size);

/* ---- hm2_eth_net.c: [init], ordinary network set-up ------------------------- */

/* Opens the socket and finds the interface to the board. 0 or -errno, with a message. */
int eth_open(struct eth_board *b);
/* The board's hardware address stays known; a failure is only told. */
void eth_set_arp(struct eth_board *b);
void eth_close(struct eth_board *b);
/* Keeps other programs off the interfaces of n boards. how: auto, iptables, nft, nftables, none. */
void eth_firewall_start(const char *how, struct eth_board *const *boards, int n);
void eth_firewall_stop(void);

#endif
