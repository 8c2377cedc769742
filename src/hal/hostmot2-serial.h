/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hostmot2-serial.h - the serial channels of a Mesa board, for drivers of what hangs on them.
 *
 * The hostmot2 driver exports these functions; load it and its board driver first. `name` is the
 * full name of a channel, such as "hm2_5i25.0.uart.1". All give a negative value for a name that
 * no board has. Setting up: [init]. Sending and reading: [rt], between the board's read and write
 * functions; they only queue what the next transfer moves, unless said otherwise.
 */
#ifndef HOSTMOT2_SERIAL_H
#define HOSTMOT2_SERIAL_H

#include "rtapi.h"
#include "rtapi_bool.h"
#include "rtapi_stdint.h"

RTAPI_BEGIN_DECLS

/* ---- Buffered SPI -------------------------------------------------------
 * chan 0..15, cs (chip select) 0..15, bits 1..64, mhz up to half the board's clock, delay 0..1e6 ns,
 * cpol, cpha, noclear, noecho, samplelate 0 or 1. 0 or -1. */
int hm2_bspi_setup_chan(char *name, int chan, int cs, int bits, double mhz, int delay, int cpol, int cpha, int noclear,
                        int noecho, int samplelate);
/* func(subdata) is called where the board reads or writes. */
int hm2_bspi_set_read_function(char *name, int (*func)(void *subdata), void *subdata);
int hm2_bspi_set_write_function(char *name, int (*func)(void *subdata), void *subdata);
/* Writes val at once. */
int hm2_bspi_write_chan(char *name, int chan, rtapi_u32 val);
/* Frames that each transfer moves: *wbuff is where to put what is sent, *rbuff where the echo of
 * the slave comes (needed unless the channel has noecho). Allocate after the last frame. */
int hm2_tram_add_bspi_frame(char *name, int chan, rtapi_u32 **wbuff, rtapi_u32 **rbuff);
int hm2_allocate_bspi_tram(char *name);
int hm2_bspi_clear_fifo(char *name);

/* ---- UART ---------------------------------------------------------------
 * bitrate in baud; a mode of -1 leaves it unchanged (tx_mode: 7 bits, rx_mode: 8 bits). A new bit
 * rate empties both queues. 0 or negative. */
int hm2_uart_setup(char *name, int bitrate, rtapi_s32 tx_mode, rtapi_s32 rx_mode);
/* Number of bytes queued, or negative. */
int hm2_uart_send(char *name, unsigned char data[], int count);
/* Number of bytes stored in data (room for 16), or negative. */
int hm2_uart_read(char *name, unsigned char data[]);

/* ---- PktUART: whole frames ---------------------------------------------- */

/* Flags of a direction. */
#define HM2_PKTUART_CONFIG_DRIVEEN 0x0001     /* transmit: drive enable */
#define HM2_PKTUART_CONFIG_DRIVEAUTO 0x0002   /* transmit: enable while sending */
#define HM2_PKTUART_CONFIG_RXEN 0x0010        /* receive: enable */
#define HM2_PKTUART_CONFIG_RXMASKEN 0x0020    /* receive: deaf while sending */
#define HM2_PKTUART_CONFIG_PARITYEN 0x0100
#define HM2_PKTUART_CONFIG_PARITYODD 0x0200   /* even without it */
#define HM2_PKTUART_CONFIG_STOPBITS2 0x0400   /* needs version 3 */
#define HM2_PKTUART_CONFIG_FLUSH 0x4000       /* empty the queues */
#define HM2_PKTUART_CONFIG_FORCECONFIG 0x8000 /* write also what has not changed */

typedef struct {
    rtapi_u32 baudrate;   /* bits per second */
    rtapi_u32 filterrate; /* receive, Hz; 0: twice the bit rate */
    rtapi_u32 drivedelay; /* transmit, 0..15 bit times */
    rtapi_u32 ifdelay;    /* between frames, bit times: up to 255, with version 3 to 1020 */
    rtapi_u32 flags;      /* HM2_PKTUART_CONFIG_* */
    rtapi_u32 unused[3];  /* 0 */
} hm2_pktuart_config_t;

/* NULL leaves that direction as it is. queue 1: with the next transfer; 0: at once. 0 or -errno. */
int hm2_pktuart_config(const char *name, const hm2_pktuart_config_t *rxcfg, const hm2_pktuart_config_t *txcfg,
                       int queue);
/* Older ways to say the same. parity: 0 none, 1 odd, 2 even. */
int hm2_pktuart_setup(char *name, unsigned int bitrate, rtapi_s32 tx_mode, rtapi_s32 rx_mode, int txclear, int rxclear);
int hm2_pktuart_setup_rx(char *name, unsigned int bitrate, unsigned int filter_hz, unsigned int parity, int frame_delay,
                         bool rx_enable, bool rx_mask);
int hm2_pktuart_setup_tx(char *name, unsigned int bitrate, unsigned int parity, int frame_delay, bool drive_enable,
                         bool drive_auto, int enable_delay);
/* Empties queues and counters: at once, with the next transfer. */
int hm2_pktuart_reset(char *name);
int hm2_pktuart_queue_reset(char *name);
/* Queues *num_frames (up to 16) frames that lie one after the other in data; *num_frames becomes
 * the number queued. Number of bytes, or negative. */
int hm2_pktuart_send(char *name, const unsigned char data[], rtapi_u8 *num_frames, const rtapi_u16 frame_sizes[]);
/* Reads at once: up to *num_frames frames, none longer than *max_frame_length. */
int hm2_pktuart_read(char *name, unsigned char data[], rtapi_u8 *num_frames, rtapi_u16 *max_frame_length,
                     rtapi_u16 frame_sizes[]);
/* The two steps of reading with the transfers: the sizes of up to 16 frames (with the flags of the
 * count register), then `bytes` bytes in whole words. Both give one less than the number moved. */
int hm2_pktuart_queue_get_frame_sizes(char *name, rtapi_u32 fsizes[]);
int hm2_pktuart_queue_read_data(char *name, rtapi_u32 *data, int bytes);
/* Clock of the channels, Hz; version: 16 * receive + transmit; mode and status words. */
int hm2_pktuart_get_clock(char *name);
int hm2_pktuart_get_version(char *name);
rtapi_u32 hm2_pktuart_get_rx_status(char *name);
rtapi_u32 hm2_pktuart_get_tx_status(char *name);

RTAPI_END_DECLS

#endif
