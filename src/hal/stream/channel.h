/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * channel.h - what sampler and streamer have in common: channels of typed pins
 * beside a stream.
 */
#ifndef CHANNEL_H
#define CHANNEL_H

#include "hal.h"

#define CHANNELS 8
#define SAMPLER_KEY 0x48534130  /* + channel */
#define STREAMER_KEY 0x48535430 /* + channel */

/* [init] Pin `prefix.pin.M` of the type of element M. */
static inline int channel_pin_new(hal_stream_t *fifo, int m, hal_pdir_t dir, hal_refs_u *ref, int comp_id,
                                  const char *prefix, int channel)
{
    switch (hal_stream_element_type(fifo, m)) {
    case HAL_BIT: return hal_pin_new_bool(comp_id, dir, &ref->b, 0, "%s.%d.pin.%d", prefix, channel, m);
    case HAL_FLOAT: return hal_pin_new_real(comp_id, dir, &ref->r, 0, "%s.%d.pin.%d", prefix, channel, m);
    case HAL_S32: return hal_pin_new_si32(comp_id, dir, &ref->s, 0, "%s.%d.pin.%d", prefix, channel, m);
    case HAL_U32: return hal_pin_new_ui32(comp_id, dir, &ref->u, 0, "%s.%d.pin.%d", prefix, channel, m);
    case HAL_S64: return hal_pin_new_sint(comp_id, dir, &ref->s, 0, "%s.%d.pin.%d", prefix, channel, m);
    case HAL_U64: return hal_pin_new_uint(comp_id, dir, &ref->u, 0, "%s.%d.pin.%d", prefix, channel, m);
    default: return -EINVAL;
    }
}

#endif
