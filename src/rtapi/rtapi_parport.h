/* SPDX-License-Identifier: GPL-2.0-or-later
 * rtapi_parport.h - parallel ports. get and release [init]; the accessors [rt]. */
#ifndef RTAPI_PARPORT_H
#define RTAPI_PARPORT_H

#include "rtapi_io.h"
#include "rtapi_stdint.h"

#define RTAPI_PARPORT_REGISTERS 8 /* from base on; the last one stands for the ECR */
#define RTAPI_PARPORT_OTHER_DEVICE 0x80000000u /* modes: registers that are no parallel port, which Linux does not know */

typedef struct rtapi_parport {
    unsigned short base;    /* I/O address of the data register */
    unsigned short base_hi; /* of the extended registers, 0 if none */
    int fd;                 /* of /dev/parportN while claimed, else -1 */
    int simulated;          /* the registers are `memory`: no pin of the computer moves */
    rtapi_u8 memory[RTAPI_PARPORT_REGISTERS];
} rtapi_parport_t;

#ifdef __cplusplus
extern "C" {
#endif
/* base below 16: number of a Linux port; else an I/O address. A port that Linux
 * knows is claimed for this process. In simulated time the port is memory with nothing connected: status and
 * data inputs are low. 0, -ENOENT, or another -errno. */
int rtapi_parport_get(const char *module_name, rtapi_parport_t *port, unsigned short base, unsigned short base_hi,
                      unsigned int modes);
void rtapi_parport_release(rtapi_parport_t *port);
#ifdef __cplusplus
}
#endif

/* A register, by its offset from base. */
static inline rtapi_u8 rtapi_parport_in(rtapi_parport_t *port, unsigned offset)
{
    return port->simulated ? port->memory[offset] : rtapi_inb((unsigned short)(port->base + offset));
}

static inline void rtapi_parport_out(rtapi_parport_t *port, unsigned offset, rtapi_u8 value)
{
    if (port->simulated) {
        port->memory[offset] = value;
    } else {
        rtapi_outb(value, (unsigned short)(port->base + offset));
    }
}

static inline rtapi_u8 rtapi_parport_data_read(rtapi_parport_t *port) { return rtapi_parport_in(port, 0); }
static inline rtapi_u8 rtapi_parport_status_read(rtapi_parport_t *port) { return rtapi_parport_in(port, 1); }
static inline rtapi_u8 rtapi_parport_control_read(rtapi_parport_t *port) { return rtapi_parport_in(port, 2); }
static inline rtapi_u8 rtapi_parport_epp_data_readb(rtapi_parport_t *port) { return rtapi_parport_in(port, 4); }
static inline rtapi_u32 rtapi_parport_epp_data_readl(rtapi_parport_t *port)
{
    return port->simulated ? port->memory[4] : rtapi_inl(port->base + 4);
}
static inline rtapi_u8 rtapi_parport_ecr_read(rtapi_parport_t *port)
{
    return port->simulated ? port->memory[RTAPI_PARPORT_REGISTERS - 1] : rtapi_inb(port->base_hi + 2);
}
static inline void rtapi_parport_data_write(rtapi_parport_t *port, rtapi_u8 value)
{
    rtapi_parport_out(port, 0, value);
}
static inline void rtapi_parport_status_write(rtapi_parport_t *port, rtapi_u8 value)
{
    rtapi_parport_out(port, 1, value);
}
static inline void rtapi_parport_control_write(rtapi_parport_t *port, rtapi_u8 value)
{
    rtapi_parport_out(port, 2, value);
}
static inline void rtapi_parport_epp_addr_write(rtapi_parport_t *port, rtapi_u8 value)
{
    rtapi_parport_out(port, 3, value);
}
static inline void rtapi_parport_epp_data_writeb(rtapi_parport_t *port, rtapi_u8 value)
{
    rtapi_parport_out(port, 4, value);
}
static inline void rtapi_parport_epp_data_writel(rtapi_parport_t *port, rtapi_u32 value)
{
    if (port->simulated) {
        port->memory[4] = (rtapi_u8)value;
    } else {
        rtapi_outl(value, port->base + 4);
    }
}
static inline void rtapi_parport_ecr_write(rtapi_parport_t *port, rtapi_u8 value)
{
    if (port->simulated) {
        port->memory[RTAPI_PARPORT_REGISTERS - 1] = value;
    } else {
        rtapi_outb(value, port->base_hi + 2);
    }
}

#endif
