/* SPDX-License-Identifier: GPL-2.0-or-later
 * A driver of a device on a Mesa board: one UART, one channel of whole frames, one SPI chip. */
#include <rtapi.h>
#include <rtapi_app.h>
#include <hal.h>
#include <hostmot2-serial.h>

MODULE_LICENSE("GPL");
static char *uart = "hm2_test.0.uart.0", *frames = "hm2_test.0.pktuart.0", *spi = "hm2_test.0.bspi.0";
RTAPI_MP_STRING(uart, "name of the UART");
static rtapi_u32 *sent, *got;
static int comp;

static int spi_read(void *count)
{
    *(int *)count += (int)(*got & 0xff);
    return 0;
}

static void run(void *arg, long period)
{
    unsigned char bytes[16];
    rtapi_u8 count = 1;
    rtapi_u16 size = 3, sizes[16];
    rtapi_u32 raw[16];
    (void)arg, (void)period;
    int n = hm2_uart_read(uart, bytes);
    if (n > 0) hm2_uart_send(uart, bytes, n);
    hm2_pktuart_send(frames, bytes, &count, &size);
    count = 16;
    hm2_pktuart_read(frames, bytes, &count, &size, sizes);
    if (hm2_pktuart_queue_get_frame_sizes(frames, raw) > 0) hm2_pktuart_queue_read_data(frames, raw, 64);
    if (hm2_pktuart_get_rx_status(frames) & (1u << 21)) hm2_pktuart_queue_reset(frames);
    *sent = hm2_pktuart_get_tx_status(frames);
}

int rtapi_app_main(void)
{
    static int count;
    hm2_pktuart_config_t rx = {.baudrate = 9600, .ifdelay = 35, .flags = HM2_PKTUART_CONFIG_RXEN | HM2_PKTUART_CONFIG_FLUSH};
    hm2_pktuart_config_t tx = {.baudrate = 9600, .flags = HM2_PKTUART_CONFIG_DRIVEAUTO | HM2_PKTUART_CONFIG_PARITYEN};
    if ((comp = hal_init("serial_driver")) < 0) return comp;
    int result = hm2_uart_setup(uart, 115200, -1, 0xff);
    if (result >= 0 && hm2_pktuart_get_version(frames) >= 0x33) result = hm2_pktuart_config(frames, &rx, &tx, 0);
    if (result >= 0) result = hm2_pktuart_setup_rx(frames, 9600, 19200, 2, 35, true, false);
    if (result >= 0) result = hm2_pktuart_setup_tx(frames, 9600, 2, 35, false, true, 1);
    if (result >= 0) result = hm2_bspi_setup_chan(spi, 0, 0, 32, 25, 800, 0, 0, 0, 0, 0);
    if (result >= 0) result = hm2_tram_add_bspi_frame(spi, 0, &sent, &got);
    if (result >= 0) result = hm2_allocate_bspi_tram(spi);
    if (result >= 0) result = hm2_bspi_set_read_function(spi, spi_read, &count);
    if (result >= 0) result = hal_export_funct("serial-driver", run, NULL, 0, 0, comp);
    if (result < 0) hal_exit(comp);
    return result < 0 ? result : hal_ready(comp);
}

void rtapi_app_exit(void)
{
    hm2_pktuart_reset(frames);
    hal_exit(comp);
}
