/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hm2_epp_link.c - transfers over a parallel port in EPP mode: an address, low byte first, whose top
 * bit makes the board count it up, then data of 8 or 32 bits. The port's hardware does the handshake.
 *
 * Thread: transfers [servo], about a microsecond for each byte
 */
#include <string.h>
#include "hm2_epp_link.h"

#define CONTROL 0x04                   /* EPP, no reset */
#define ECR_EPP 0x94
#define TIMEOUT 0x01                   /* of the status register; writing it clears it */
#define INCREMENT 0x8000u
#define EXTENDED 0x400                 /* from the port to its extended registers */
#define ADDR_COOKIE 0x0100
#define COOKIE 0x55AACAFEu

struct epp_board {
    struct hm2_llio io;
    hal_parport_t port;
    bool wide, claimed;
};

static struct epp_board *board[EPP_BOARDS];
static const struct epp_model *model;
static int comp_id, boards;

/* ---- Transfers ---------------------------------------------------------------- */

static bool timed_out(struct epp_board *b, const char *what, rtapi_u32 addr, int bytes)
{
    rtapi_u8 status = rtapi_parport_status_read(&b->port);
    if(!(status & TIMEOUT)) return false;
    rtapi_parport_status_write(&b->port, status);
    rtapi_parport_status_write(&b->port, status & (rtapi_u8)~TIMEOUT);
    rtapi_print_msg(RTAPI_MSG_ERR, "%s: EPP timeout on data cycle of %s(addr=0x%04x, size=%d): check cable and power\n",
                    b->io.name, what, addr, bytes);
    hm2_llio_fail(&b->io);
    return true;
}

static void select_addr(struct epp_board *b, rtapi_u32 addr)
{
    rtapi_parport_epp_addr_write(&b->port, (rtapi_u8)addr);
    rtapi_parport_epp_addr_write(&b->port, (rtapi_u8)((addr | INCREMENT) >> 8));
}

static int read_registers(struct hm2_llio *io, rtapi_u32 addr, void *buffer, int bytes)
{
    struct epp_board *b = (struct epp_board *)io;
    rtapi_u8 *to = buffer;
    int i;
    select_addr(b, addr);
    if(b->wide) {
        for(i = 0; i < bytes; i += 4) {
            rtapi_u32 word = rtapi_parport_epp_data_readl(&b->port);
            memcpy(to + i, &word, sizeof word);
        }
    } else
        for(i = 0; i < bytes; i++) to[i] = rtapi_parport_epp_data_readb(&b->port);
    return !timed_out(b, "read", addr, bytes);
}

static int write_registers(struct hm2_llio *io, rtapi_u32 addr, const void *buffer, int bytes)
{
    struct epp_board *b = (struct epp_board *)io;
    const rtapi_u8 *from = buffer;
    int i;
    select_addr(b, addr);
    if(b->wide) {
        for(i = 0; i < bytes; i += 4) {
            rtapi_u32 word;
            memcpy(&word, from + i, sizeof word);
            rtapi_parport_epp_data_writel(&b->port, word);
        }
    } else
        for(i = 0; i < bytes; i++) rtapi_parport_epp_data_writeb(&b->port, from[i]);
    return !timed_out(b, "write", addr, bytes);
}

static const struct hm2_llio_ops ops = {.read = read_registers, .write = write_registers};

/* ---- Boards [init] -------------------------------------------------------------- */

static void set_up_port(struct epp_board *b)
{
    rtapi_parport_control_write(&b->port, CONTROL);
    if(b->port.base_hi) rtapi_parport_ecr_write(&b->port, ECR_EPP);
    rtapi_u8 status = rtapi_parport_status_read(&b->port);
    rtapi_parport_status_write(&b->port, status);
    rtapi_parport_status_write(&b->port, status & (rtapi_u8)~TIMEOUT);
}

static rtapi_u32 read_cookie(struct epp_board *b)
{
    rtapi_u32 cookie = 0;
    read_registers(&b->io, ADDR_COOKIE, &cookie, sizeof cookie);
    return cookie;
}

static int start_board(int n)
{
    struct epp_board *b = hal_malloc(sizeof *b);
    int base = model->ioaddr[n], hi = model->ioaddr_hi[n], i;
    if(!b) return -ENOMEM;
    if(!hi && base >= 16) hi = base + EXTENDED;
    board[boards++] = b;
    rtapi_snprintf(b->io.name, sizeof b->io.name, "%s.%d", model->driver, n);
    COMP_TRY(hal_parport_get(comp_id, &b->port, (unsigned short)base, (unsigned short)hi, 0));
    b->claimed = true;
    b->wide = model->wide[n] != 0;
    set_up_port(b);
    if(*model->debug)
        rtapi_print("%s: port 0x%04X, extended registers 0x%04X\n", b->io.name, b->port.base, b->port.base_hi);
    if(b->wide && read_cookie(b) != COOKIE) {
        b->wide = false;
        set_up_port(b);
        if(read_cookie(b) == COOKIE)
            rtapi_print("%s: the port does not transfer 32 bits at once: bytes are used\n", b->io.name);
    }
    if(model->programmed_elsewhere && read_cookie(b) != COOKIE) {
        rtapi_print_msg(RTAPI_MSG_ERR, "%s: the board at 0x%04X has no firmware yet, and this driver cannot load it: "
                        "load it with another program first\n", b->io.name, b->port.base);
        return -ENODEV;
    }
    b->io.ops = &ops;
    b->io.comp_id = comp_id;
    b->io.num_connectors = model->connectors;
    b->io.pins_per_connector = 24;
    for(i = 0; i < model->connectors; i++) b->io.connector_name[i] = model->connector[i];
    b->io.num_leds = model->leds;
    b->io.fpga_part = "";
    return hm2_register(&b->io, model->config[n]);
}

static void stop_boards(void)
{
    while(boards > 0) {
        struct epp_board *b = board[--boards];
        hm2_unregister(&b->io);
        if(b->claimed) hal_parport_release(&b->port);
    }
}

int epp_start(const struct epp_model *m)
{
    int n, r = 0;
    model = m;
    comp_id = hal_init(m->driver);
    if(comp_id < 0) return comp_id;
    for(n = 0; n < EPP_BOARDS && m->ioaddr[n] >= 0 && r >= 0; n++) r = start_board(n);
    if(r < 0) {
        hal_exit(comp_id);
        stop_boards();
        return r;
    }
    return hal_ready(comp_id);
}

void epp_stop(void)
{
    hal_exit(comp_id);
    stop_boards();
}
