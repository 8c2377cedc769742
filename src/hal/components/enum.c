/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * enum.c - names for numbers: bits to a number (encode), a number to bits (decode).
 *
 * Thread: one function per instance [any], bounded by the number of its names
 */
#include <rtapi.h>
#include <rtapi_app.h>
#include <rtapi_string.h>
#include <hal.h>
#include "components/comp_util.h"

MODULE_LICENSE("GPL");
MODULE_AUTHOR("Kerf developers");
MODULE_DESCRIPTION("Names for numbers");

#define MAX_INSTANCES 256

static char *enums[MAX_INSTANCES];
RTAPI_MP_ARRAY_STRING(enums, MAX_INSTANCES, "E or D, then the names: E;ONE;TWO;;FOUR");
static char *names[MAX_INSTANCES];
RTAPI_MP_ARRAY_STRING(names, MAX_INSTANCES, "names of the instances");

struct entry {
    hal_bool_t bit;
    hal_uint_t value;
};

struct instance {
    int entries;
    hal_uint_t number;                  /* output of an encoder, input of a decoder */
    struct entry entry[];
};

static int comp_id;

/* HAL function of an encoder: the value of the last name that is TRUE. */
static void encode(void *arg, long period)
{
    struct instance *inst = arg;
    rtapi_u32 number = 0;
    int i;
    (void)period;
    for(i = 0; i < inst->entries; i++)
        if(hal_get_bool(inst->entry[i].bit)) number = hal_get_ui32(inst->entry[i].value);
    hal_set_ui32(inst->number, number);
}

/* HAL function of a decoder. */
static void decode(void *arg, long period)
{
    struct instance *inst = arg;
    rtapi_u32 number = hal_get_ui32(inst->number);
    int i;
    (void)period;
    for(i = 0; i < inst->entries; i++)
        hal_set_bool(inst->entry[i].bit, number == hal_get_ui32(inst->entry[i].value));
}

/* The next name of a list separated by semicolons; moves *at behind it, NULL at the end. */
static int next_name(const char **at, int *length)
{
    if(!**at) return 0;
    *at += 1;                           /* the semicolon before it */
    *length = (int)strcspn(*at, ";");
    return 1;
}

static int export_instance(int n)
{
    const char *text = enums[n], *at;
    int is_encoder, length, value, count = 0;
    char prefix[HAL_NAME_LEN + 1];
    struct instance *inst;
    if(!strchr("EeDd", text[0]) || text[1] != ';') {
        rtapi_print_msg(RTAPI_MSG_ERR, "Each enum string must start with either E; or D; : \"%s\"\n", text);
        return -EINVAL;
    }
    is_encoder = text[0] == 'E' || text[0] == 'e';
    for(at = text + 1; next_name(&at, &length); at += length) count += length > 0;
    inst = hal_malloc((long)(sizeof *inst + sizeof inst->entry[0] * (size_t)count));
    if(!inst) return -ENOMEM;

    if(names[n] && names[n][0]) rtapi_snprintf(prefix, sizeof prefix, "%s", names[n]);
    else rtapi_snprintf(prefix, sizeof prefix, "enum-%s.%02d", is_encoder ? "encode" : "decode", n);
    COMP_TRY(hal_pin_new_ui32(comp_id, is_encoder ? HAL_OUT : HAL_IN, &inst->number, 0, "%s.%s", prefix,
                              is_encoder ? "output" : "input"));
    for(at = text + 1, value = 0; next_name(&at, &length); at += length, value++) {
        struct entry *e = &inst->entry[inst->entries];
        if(length == 0) continue;       /* a number without a name */
        COMP_TRY(hal_pin_new_bool(comp_id, is_encoder ? HAL_IN : HAL_OUT, &e->bit, 0, "%s.%.*s-%s", prefix,
                                  length, at, is_encoder ? "in" : "out"));
        COMP_TRY(hal_pin_new_ui32(comp_id, HAL_IN, &e->value, (rtapi_u32)value, "%s.%.*s-val", prefix, length, at));
        inst->entries++;
    }
    return hal_export_functf(is_encoder ? encode : decode, inst, 0, 0, comp_id, "%s", prefix);
}

int rtapi_app_main(void)
{
    int i, count, named, r = 0;
    for(count = 0; count < MAX_INSTANCES && enums[count] && enums[count][0]; count++) {}
    for(named = 0; named < MAX_INSTANCES && names[named] && names[named][0]; named++) {}
    if(count == 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "The enum component requires at least one enum string\n");
        return -EINVAL;
    }
    if(named && named != count) {
        rtapi_print_msg(RTAPI_MSG_ERR, "enum: number of names (%d) and of enum strings (%d) must match\n", named,
                        count);
        return -EINVAL;
    }
    rtapi_print_msg(RTAPI_MSG_ERR, "making %i instances\n", count);
    comp_id = hal_init("enum");
    if(comp_id < 0) return comp_id;
    for(i = 0; r >= 0 && i < count; i++) r = export_instance(i);
    if(r < 0) {
        hal_exit(comp_id);
        return r;
    }
    return hal_ready(comp_id);
}

void rtapi_app_exit(void)
{
    hal_exit(comp_id);
}
