/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hm2_mesa_uart.c - module mesa_uart: bytes of a serial channel of a HostMot2 board as pins, an
 * example of hostmot2-serial.h that works.
 *
 * Thread: <uart>.send and <uart>.receive [servo], at most 16 bytes each
 */
#include <rtapi_app.h>
#include "hal.h"
#include "hostmot2-serial.h"
#include "components/comp_util.h"

MODULE_LICENSE("GPL");
MODULE_AUTHOR("Kerf developers");
MODULE_DESCRIPTION("Bytes of a serial channel as pins");

#define MAX_CHANNELS 16
#define BYTES 16
#define BAUD 250000
#define TX_MODE 0x40

static char *names[MAX_CHANNELS];
RTAPI_MP_ARRAY_STRING(names, MAX_CHANNELS, "channels, such as hm2_7i96s.0.uart.0");

struct channel {
    char *name;
    hal_uint_t tx[BYTES], rx[BYTES];
    hal_sint_t tx_bytes, rx_bytes;
};

static int comp_id;

static void send(void *arg, long period)
{
    struct channel *c = arg;
    unsigned char data[BYTES];
    int i, n = hal_get_si32(c->tx_bytes);
    (void)period;
    n = n < 0 ? 0 : n > BYTES ? BYTES : n;
    for(i = 0; i < n; i++) data[i] = (unsigned char)hal_get_ui32(c->tx[i]);
    if(n) hm2_uart_send(c->name, data, n);
}

static void receive(void *arg, long period)
{
    struct channel *c = arg;
    unsigned char data[BYTES];
    int i, n = hm2_uart_read(c->name, data);
    (void)period;
    for(i = 0; i < n; i++) hal_set_ui32(c->rx[i], data[i]);
    hal_set_si32(c->rx_bytes, n < 0 ? 0 : n);
}

static int start(char *name)
{
    struct channel *c = hal_malloc(sizeof *c);
    int i;
    if(!c) return -ENOMEM;
    c->name = name;
    COMP_TRY(hm2_uart_setup(name, BAUD, TX_MODE, -1));
    for(i = 0; i < BYTES; i++) {
        COMP_TRY(hal_pin_new_ui32(comp_id, HAL_IN, &c->tx[i], 0, "%s.tx-data-%02d", name, i));
        COMP_TRY(hal_pin_new_ui32(comp_id, HAL_OUT, &c->rx[i], 0, "%s.rx-data-%02d", name, i));
    }
    COMP_TRY(hal_pin_new_si32(comp_id, HAL_IN, &c->tx_bytes, 0, "%s.tx-bytes", name));
    COMP_TRY(hal_pin_new_si32(comp_id, HAL_OUT, &c->rx_bytes, 0, "%s.rx-bytes", name));
    COMP_TRY(hal_export_functf(send, c, 1, 0, comp_id, "%s.send", name));
    return hal_export_functf(receive, c, 1, 0, comp_id, "%s.receive", name);
}

int rtapi_app_main(void)
{
    int i, r = 0;
    comp_id = hal_init("mesa_uart");
    if(comp_id < 0) return comp_id;
    if(!names[0] || !*names[0]) {
        rtapi_print_msg(RTAPI_MSG_ERR, "mesa_uart: names= names no channel, such as hm2_7i96s.0.uart.0\n");
        r = -EINVAL;
    }
    for(i = 0; r >= 0 && i < MAX_CHANNELS && names[i] && *names[i]; i++) r = start(names[i]);
    if(r < 0) {
        hal_exit(comp_id);
        return r;
    }
    return hal_ready(comp_id);
}

void rtapi_app_exit(void)
{
    hal_exit(comp_id);
}
