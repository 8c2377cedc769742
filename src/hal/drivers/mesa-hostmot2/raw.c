/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * raw.c - any register, by pins (config word enable_raw).
 */
#include "hm2.h"

struct raw {
    hal_uint_t read_address, read_data, write_address, write_data;
    hal_bool_t write_strobe, dump_state;
    rtapi_u32 data;                    /* where the read goes */
};

static int claim(struct hm2 *hm2, const struct hm2_md *md, void **state)
{
    static const struct hm2_item items[] = {
        HM2_ITEM(U32, IN, raw, read_address, "read_address", 0),
        HM2_ITEM(U32, OUT, raw, read_data, "read_data", 0),
        HM2_ITEM(U32, IN, raw, write_address, "write_address", 0),
        HM2_ITEM(U32, IN, raw, write_data, "write_data", 0),
        HM2_ITEM(BIT, IN, raw, write_strobe, "write_strobe", 0),
        HM2_ITEM(BIT, IO, raw, dump_state, "dump_state", 0),
    };
    struct raw *s = *state = hal_malloc(sizeof *s);
    (void)md;
    if(!s) return -ENOMEM;
    COMP_TRY(hm2_export(hm2, items, HM2_COUNT(items), s, "raw."));
    return 1;
}

static void request(struct hm2 *hm2, void *state)
{
    struct raw *s = state;
    const struct hm2_llio_ops *ops = hm2->io->ops;
    rtapi_u32 addr = hal_get_ui32(s->read_address) & 0xFFFC;
    (ops->queue_read ? ops->queue_read : ops->read)(hm2->io, addr, &s->data, sizeof s->data);
}

static void process(struct hm2 *hm2, void *state, long period)
{
    struct raw *s = state;
    (void)hm2;
    (void)period;
    hal_set_ui32(s->read_data, s->data);
}

static void write_settings(struct hm2 *hm2, void *state, bool force)
{
    struct raw *s = state;
    if(force) return;
    if(hal_get_bool(s->write_strobe)) {
        hm2_queue_write(hm2, hal_get_ui32(s->write_address) & 0xFFFC, hal_get_ui32(s->write_data));
        hal_set_bool(s->write_strobe, 0);
    }
    if(hal_get_bool(s->dump_state)) {
        hm2_print_state(hm2);
        hal_set_bool(s->dump_state, 0);
    }
}

const struct hm2_function_ops hm2_raw = {
    .claim = claim,
    .request = request,
    .process = process,
    .write = write_settings,
};
