/* SPDX-License-Identifier: GPL-2.0-or-later
 * rtapi_io.h - x86 port I/O (value first, then port). On other machines reads
 * give 0 and writes do nothing. Needs I/O privilege; see docs/realtime.md. */
#ifndef RTAPI_IO_H
#define RTAPI_IO_H

#if defined(__i386__) || defined(__x86_64__)
#include <sys/io.h>
#define rtapi_inb(port) inb(port)
#define rtapi_inw(port) inw(port)
#define rtapi_inl(port) inl(port)
#define rtapi_outb(value, port) outb(value, port)
#define rtapi_outw(value, port) outw(value, port)
#define rtapi_outl(value, port) outl(value, port)
#define rtapi_ioperm(from, num, on) ioperm(from, num, on)
#else
static inline unsigned char rtapi_inb(unsigned short port) { (void)port; return 0; }
static inline unsigned short rtapi_inw(unsigned short port) { (void)port; return 0; }
static inline unsigned int rtapi_inl(unsigned short port) { (void)port; return 0; }
static inline void rtapi_outb(unsigned char value, unsigned short port) { (void)value; (void)port; }
static inline void rtapi_outw(unsigned short value, unsigned short port) { (void)value; (void)port; }
static inline void rtapi_outl(unsigned int value, unsigned short port) { (void)value; (void)port; }
static inline int rtapi_ioperm(unsigned long from, unsigned long num, int on)
{
    (void)from; (void)num; (void)on;
    return 0;
}
#endif

#endif
