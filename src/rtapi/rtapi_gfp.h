/* SPDX-License-Identifier: GPL-2.0-or-later
 * rtapi_gfp.h - allocation flags; without effect in user space. */
#ifndef RTAPI_GFP_H
#define RTAPI_GFP_H

typedef unsigned long rtapi_gfp_t;
enum rtapi_gfp_e {
    RTAPI_GFP_BUFFER,
    RTAPI_GFP_ATOMIC,
    RTAPI_GFP_KERNEL,
    RTAPI_GFP_USER,
    RTAPI_GFP_NOBUFFER,
    RTAPI_GFP_NFS,
    RTAPI_GFP_DMA
};

#endif
