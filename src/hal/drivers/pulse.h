/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * pulse.h - pulses that a write function begins and a reset function ends in the same cycle.
 */
#ifndef KERF_PULSE_H
#define KERF_PULSE_H

#include <hal.h>
#include <rtapi.h>

#define PULSE_ROUND_NS 5

/* [rt] The pulses' length, ns: at most a quarter of the period, in the parameter, too. */
static inline rtapi_u32 pulse_width(hal_uint_t parameter, long period)
{
    rtapi_u32 width = hal_get_ui32(parameter);
    return width > (rtapi_u32)(period / 4) ? hal_set_ui32(parameter, (rtapi_u32)(period / 4)) : width;
}

/* [rt] Waits until width ns after the time. Reading the time takes longer than a round; in simulated time, which
 * stands while a function runs, the number of rounds ends the wait. */
static inline void pulse_wait(long long begun, rtapi_u32 width)
{
    rtapi_u32 rounds;
    for(rounds = width / PULSE_ROUND_NS; rounds && rtapi_get_time() - begun < width; rounds--) {}
}

#endif
