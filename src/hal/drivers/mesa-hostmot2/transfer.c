/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * transfer.c - registers over the board driver: single ones, and the blocks of every cycle.
 */
#include <rtapi_slab.h>
#include "hm2.h"

#define MAX_REGION_WORDS 127

static rtapi_u32 *add_region(struct hm2 *hm2, struct hm2_region *regions, int *count, rtapi_u32 addr, int words)
{
    struct hm2_region *r = &regions[*count];
    if(*count >= HM2_MAX_REGIONS || words < 1 || words > MAX_REGION_WORDS) {
        HM2_ERR(hm2, "firmware has too many modules: no room for %d registers at 0x%04X\n", words, addr);
        return NULL;
    }
    r->buffer = rtapi_kzalloc(sizeof *r->buffer * (size_t)words, RTAPI_GFP_KERNEL);
    if(!r->buffer) return NULL;
    r->addr = (rtapi_u16)addr;
    r->words = words;
    ++*count;
    return r->buffer;
}

rtapi_u32 *hm2_read_region(struct hm2 *hm2, rtapi_u32 addr, int words)
{
    return add_region(hm2, hm2->reads, &hm2->num_reads, addr, words);
}

rtapi_u32 *hm2_write_region(struct hm2 *hm2, rtapi_u32 addr, int words)
{
    return add_region(hm2, hm2->writes, &hm2->num_writes, addr, words);
}

int hm2_read_now(struct hm2 *hm2, rtapi_u32 addr, void *buffer, int bytes)
{
    if(hm2->io->ops->read(hm2->io, addr, buffer, bytes)) return 1;
    HM2_ERR(hm2, "cannot read %d bytes at 0x%04X\n", bytes, addr);
    return 0;
}

int hm2_write_now(struct hm2 *hm2, rtapi_u32 addr, rtapi_u32 value)
{
    return hm2->io->ops->write(hm2->io, addr, &value, sizeof value);
}

void hm2_queue_write(struct hm2 *hm2, rtapi_u32 addr, rtapi_u32 value)
{
    const struct hm2_llio_ops *ops = hm2->io->ops;
    if(ops->queue_write) ops->queue_write(hm2->io, addr, &value, sizeof value);
    else ops->write(hm2->io, addr, &value, sizeof value);
}

void hm2_write_changed(struct hm2 *hm2, rtapi_u32 addr, rtapi_u32 value, rtapi_u32 *last, bool force)
{
    if(!force && value == *last) return;
    *last = value;
    hm2_queue_write(hm2, addr, value);
}

rtapi_u32 hm2_timer_register(rtapi_s32 timer)
{
    return timer < 0 || timer > 4 ? 0 : (rtapi_u32)timer << 12 | 1u << 15;
}
