/* SPDX-License-Identifier: GPL-2.0-or-later
 * rtapi_slab.h - memory for modules. [init] only: never in a cycle. */
#ifndef RTAPI_SLAB_H
#define RTAPI_SLAB_H

#include <stdlib.h>
#include "rtapi_gfp.h"

#define rtapi_kmalloc(sz, flags) malloc(sz)
#define rtapi_kzalloc(sz, flags) calloc(1, sz)
#define rtapi_krealloc(ptr, sz, flags) realloc(ptr, sz)
#define rtapi_kfree(ptr) free(ptr)

#endif
