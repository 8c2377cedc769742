/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hal_parport.h - parallel ports for HAL drivers: names of rtapi_parport.h.
 */
#ifndef HAL_PARPORT_H
#define HAL_PARPORT_H

#include "hal.h"
#include "rtapi_parport.h"

typedef rtapi_parport_t hal_parport_t;

/* [init] See rtapi_parport_get: 0 or -errno. comp_id: the driver's component. */
static inline int hal_parport_get(int comp_id, hal_parport_t *port, unsigned short base, unsigned short base_hi,
                                  unsigned int modes)
{
    char *name = hal_comp_name(comp_id);
    return name ? rtapi_parport_get(name, port, base, base_hi, modes) : -EINVAL;
}

/* [init] Gives the port back. */
static inline void hal_parport_release(hal_parport_t *port)
{
    rtapi_parport_release(port);
}

#endif
