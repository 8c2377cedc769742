/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * sserial_builtin.c - 8I20 and 7I64, which do not describe themselves. [init]
 */
#include <string.h>
#include "sserial.h"

#define CARD_7I64 0x34364937u
#define CARD_8I20 0x30324938u
#define ADDR_8I20_MAX_CURRENT 0x8E8
#define CURRENT_UNIT 0.01              /* A */

struct entry {
    const char *name;
    rtapi_u8 type, length, dir;
    double max;
};

static const struct entry of_8i20[] = {
    {"angle", FIELD_UNSIGNED, 16, FIELD_OUT, 1},
    {"current", FIELD_SIGNED, 16, FIELD_OUT, 0}, /* the card's own limit */
    {"card-temp", FIELD_UNSIGNED, 16, FIELD_IN, 65535},
    {"bus-voltage", FIELD_UNSIGNED, 16, FIELD_IN, 655.35},
    {"status.current-lim", FIELD_BOOLEAN, 1, FIELD_IN, 1},
    {"status.brake-on", FIELD_BOOLEAN, 1, FIELD_IN, 1},
    {"status.brake-old", FIELD_BOOLEAN, 1, FIELD_IN, 1},
    {"status.bus-underv", FIELD_BOOLEAN, 1, FIELD_IN, 1},
    {"status.wd-reset", FIELD_BOOLEAN, 1, FIELD_IN, 1},
    {"status.sw-reset", FIELD_BOOLEAN, 1, FIELD_IN, 1},
    {"status.ext-reset", FIELD_BOOLEAN, 1, FIELD_IN, 1},
    {"", FIELD_PAD, 1, FIELD_IN, 1},
    {"status.no-enable", FIELD_BOOLEAN, 1, FIELD_IN, 1},
    {"status.pid-on", FIELD_BOOLEAN, 1, FIELD_IN, 1},
    {"", FIELD_PAD, 6, FIELD_IN, 1},
    {"fault.watchdog", FIELD_BOOLEAN, 1, FIELD_IN, 1},
    {"fault.no-enable", FIELD_BOOLEAN, 1, FIELD_IN, 1},
    {"fault.overtemp", FIELD_BOOLEAN, 1, FIELD_IN, 1},
    {"", FIELD_PAD, 1, FIELD_IN, 1},
    {"fault.overcurrent", FIELD_BOOLEAN, 1, FIELD_IN, 1},
    {"fault.U-current", FIELD_BOOLEAN, 1, FIELD_IN, 1},
    {"fault.V-current", FIELD_BOOLEAN, 1, FIELD_IN, 1},
    {"fault.W-current", FIELD_BOOLEAN, 1, FIELD_IN, 1},
    {"fault.bus-underv", FIELD_BOOLEAN, 1, FIELD_IN, 1},
    {"fault.bus-high", FIELD_BOOLEAN, 1, FIELD_IN, 1},
    {"fault.bus-overv", FIELD_BOOLEAN, 1, FIELD_IN, 1},
    {"fault.module", FIELD_BOOLEAN, 1, FIELD_IN, 1},
    {"", FIELD_PAD, 1, FIELD_IN, 1},
    {"", FIELD_PAD, 1, FIELD_IN, 1},
    {"fault.overrun", FIELD_BOOLEAN, 1, FIELD_IN, 1},
    {"fault.framingr", FIELD_BOOLEAN, 1, FIELD_IN, 1},
};

static const struct entry of_7i64[] = {
    {"output", FIELD_BITS_EACH, 24, FIELD_OUT, 1},
    {"input", FIELD_BITS_EACH, 24, FIELD_IN, 1},
    {"", FIELD_PAD, 8, FIELD_IN, 1},
    {"analog0", FIELD_UNSIGNED, 16, FIELD_IN, 3.3},
    {"analog1", FIELD_UNSIGNED, 16, FIELD_IN, 3.3},
};

static const struct {
    const char *name;
    rtapi_u16 addr;
} params_8i20[] = {
    {"swrevision", 2164}, {"unitnumber", 2344}, {"nvmaxcurrent", 2}, {"nvbusundervmax", 36}, {"nvbusundervmin", 34},
    {"nvbusoverv", 38}, {"nvbrakeonv", 40}, {"nvbrakeoffv", 42}, {"nvrembaudrate", 6}, {"nvkqp", 10}, {"nvkqihi", 14},
    {"nvkqilo", 12}, {"nvkqil", 16}, {"nvkdp", 18}, {"nvkdihi", 22}, {"nvkdilo", 20}, {"nvkdil", 24},
};

static int add_entries(struct hm2 *hm2, struct sserial_remote *r, const struct entry *e, int n, double own_max)
{
    int i;
    for(i = 0; i < n; i++) {
        struct field f = {.type = e[i].type, .length = e[i].length, .dir = e[i].dir, .max = e[i].max ? e[i].max
            : own_max};
        if(f.type == FIELD_SIGNED) f.min = -f.max;
        snprintf(f.name, sizeof f.name, "%s", e[i].name);
        COMP_TRY(sserial_add_field(hm2, r, &f));
    }
    return 0;
}

static int add_8i20(struct hm2 *hm2, struct sserial_port *p, struct sserial_remote *r)
{
    rtapi_u16 current, value;
    int i;
    COMP_TRY(sserial_read_remote(hm2, p, r->channel, ADDR_8I20_MAX_CURRENT, &current, 2));
    COMP_TRY(add_entries(hm2, r, of_8i20, HM2_COUNT(of_8i20), current * CURRENT_UNIT));
    for(i = 0; i < HM2_COUNT(params_8i20); i++) {
        bool kept = !strncmp(params_8i20[i].name, "nv", 2);
        struct field f = {.type = kept ? FIELD_NV_UNSIGNED : FIELD_UNSIGNED, .length = 16,
                          .dir = kept ? FIELD_IO : FIELD_IN, .addr = params_8i20[i].addr};
        snprintf(f.name, sizeof f.name, "%s", params_8i20[i].name);
        COMP_TRY(sserial_read_remote(hm2, p, r->channel, f.addr, &value, 2));
        COMP_TRY(sserial_add_param(hm2, r, &f));
        r->param[i].written = value;
        hal_set_ui32(r->param[i].field.value.u, value);
    }
    return 1;
}

int sserial_builtin(struct hm2 *hm2, struct sserial_port *p, struct sserial_remote *r)
{
    if(r->name_word == CARD_8I20) return add_8i20(hm2, p, r);
    if(r->name_word != CARD_7I64) return 0;
    COMP_TRY(add_entries(hm2, r, of_7i64, HM2_COUNT(of_7i64), 1));
    return 1;
}
