/* SPDX-License-Identifier: GPL-2.0-or-later
 * rtapi_byteorder.h - byte order of this machine as 0 or 1. */
#ifndef RTAPI_BYTEORDER_H
#define RTAPI_BYTEORDER_H
#define RTAPI_BIG_ENDIAN (__BYTE_ORDER__ == __ORDER_BIG_ENDIAN__)
#define RTAPI_LITTLE_ENDIAN (__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__)
#define RTAPI_FLOAT_BIG_ENDIAN (__FLOAT_WORD_ORDER__ == __ORDER_BIG_ENDIAN__)
#endif
