/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * matrix_kb.c - keys of a matrix keyboard, scanned here or by hardware that sends
 * key codes.
 *
 * Thread: one function per keyboard [any]; one row per call when scanning
 */
#include <rtapi.h>
#include <rtapi_app.h>
#include <rtapi_ctype.h>
#include <rtapi_string.h>
#include <hal.h>
#include "components/comp_util.h"

MODULE_LICENSE("GPL");
MODULE_AUTHOR("Kerf developers");
MODULE_DESCRIPTION("Matrix keyboard");

#define MAX_INSTANCES 8
#define MAX_COLUMNS 32
#define NO_CHANGE 0x40

static char *config[MAX_INSTANCES];
RTAPI_MP_ARRAY_STRING(config, MAX_INSTANCES, "ROWSxCOLUMNS, with s if the component scans");
static char *names[MAX_INSTANCES];
RTAPI_MP_ARRAY_STRING(names, MAX_INSTANCES, "names of the keyboards");

struct keyboard {
    int rows, columns, scans, row_shift;
    rtapi_u32 key_down, key_up;         /* added to a key's number for its two events */
    int held;                           /* keys that are down */
    hal_bool_t *key;                    /* rows * columns */
    hal_uint_t keycode;
    /* Only if it scans. */
    hal_bool_t *row_out, *col_in, negative_logic;
    hal_uint_t rollover;
    int row;
    rtapi_u32 *last, *stable;           /* of each row: last sample, debounced state */
};

static int comp_id;

static void key_event(struct keyboard *k, rtapi_u32 code)
{
    rtapi_u32 number, rollover = k->scans ? hal_get_ui32(k->rollover) : 2;
    int down = (code & k->key_down) == k->key_down, row, column;
    if(code == NO_CHANGE || !(down || (code & k->key_down) == k->key_up)) return;
    number = code & ~k->key_down;
    row = (int)(number >> k->row_shift);
    column = (int)(number & ((1u << k->row_shift) - 1));
    if(row >= k->rows || column >= k->columns) return;
    if(!down) {
        if(k->held > 0) k->held--;
        hal_set_bool(k->key[row * k->columns + column], 0);
    } else if((rtapi_u32)k->held < rollover) {
        k->held++;
        hal_set_bool(k->key[row * k->columns + column], 1);
    }
}

static void scan_row(struct keyboard *k)
{
    int column, negative = hal_get_bool(k->negative_logic), row = k->row;
    rtapi_u32 sample = 0, before = k->last[row], changed;
    for(column = 0; column < k->columns; column++)
        sample |= (rtapi_u32)(hal_get_bool(k->col_in[column]) != negative) << column;
    changed = sample == before ? sample ^ k->stable[row] : 0;
    if(changed) {
        for(column = 0; column < k->columns; column++) {
            rtapi_u32 code;
            if(!(changed >> column & 1)) continue;
            code = (sample >> column & 1 ? k->key_down : k->key_up) + ((rtapi_u32)row << k->row_shift)
                + (rtapi_u32)column;
            hal_set_ui32(k->keycode, code);
            key_event(k, code);
        }
    } else {
        hal_set_ui32(k->keycode, NO_CHANGE);
    }
    k->stable[row] = before;
    k->last[row] = sample;
    hal_set_bool(k->row_out[row], negative);
    k->row = row + 1 < k->rows ? row + 1 : 0;
    hal_set_bool(k->row_out[k->row], !negative);
}

/* HAL function of a keyboard. */
static void run(void *arg, long period)
{
    struct keyboard *k = arg;
    (void)period;
    if(k->scans) scan_row(k);
    else key_event(k, hal_get_ui32(k->keycode));
}

static int parse_size(struct keyboard *k, const char *text)
{
    const char *at = text;
    if(!isdigit((unsigned char)*at)) goto bad;
    for(; isdigit((unsigned char)*at) && k->rows < 1000; at++) k->rows = k->rows * 10 + (*at - '0');
    if(tolower((unsigned char)*at++) != 'x' || !isdigit((unsigned char)*at)) goto bad;
    for(; isdigit((unsigned char)*at) && k->columns < 1000; at++) k->columns = k->columns * 10 + (*at - '0');
    k->scans = strpbrk(text, "sS") != NULL;
    if(k->rows < 1 || k->columns < 1) goto bad;
    if(k->columns > MAX_COLUMNS) {
        rtapi_print_msg(RTAPI_MSG_ERR, "matrix_kb: maximum number of columns is %d. Sorry\n", MAX_COLUMNS);
        return -1;
    }
    for(k->row_shift = 1; 1 << k->row_shift < k->columns; k->row_shift++) {}
    k->key_down = 0xC0;
    k->key_up = 0x80;
    while(((rtapi_u32)k->rows << k->row_shift) > k->key_down) {
        k->key_down <<= 1;
        k->key_up <<= 1;
    }
    return 0;
bad:
    rtapi_print_msg(RTAPI_MSG_ERR, "matrix_kb: Invalid size format. should be NxN\n");
    return -1;
}

static int export_scanning(struct keyboard *k, const char *name)
{
    int i;
    k->row_out = hal_malloc((long)sizeof *k->row_out * k->rows);
    k->col_in = hal_malloc((long)sizeof *k->col_in * k->columns);
    k->last = hal_malloc((long)sizeof *k->last * k->rows);
    k->stable = hal_malloc((long)sizeof *k->stable * k->rows);
    if(!k->row_out || !k->col_in || !k->last || !k->stable) return -ENOMEM;
    for(i = 0; i < k->rows; i++)
        COMP_TRY(hal_pin_new_bool(comp_id, HAL_OUT, &k->row_out[i], 0, "%s.row-%02d-out", name, i));
    for(i = 0; i < k->columns; i++)
        COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &k->col_in[i], 0, "%s.col-%02d-in", name, i));
    COMP_TRY(hal_pin_new_ui32(comp_id, HAL_OUT, &k->keycode, 0, "%s.keycode", name));
    COMP_TRY(hal_param_new_bool(comp_id, HAL_RW, &k->negative_logic, 1, "%s.negative-logic", name));
    COMP_TRY(hal_param_new_ui32(comp_id, HAL_RW, &k->rollover, 2, "%s.key_rollover", name));
    return 0;
}

static int export_keyboard(int n)
{
    char name[HAL_NAME_LEN + 1];
    int row, column;
    struct keyboard *k = hal_malloc(sizeof *k);
    if(!k) return -ENOMEM;
    COMP_TRY(parse_size(k, config[n]));
    if(names[n] && names[n][0]) rtapi_snprintf(name, sizeof name, "%s", names[n]);
    else rtapi_snprintf(name, sizeof name, "matrix_kb.%d", n);
    k->key = hal_malloc((long)sizeof *k->key * k->rows * k->columns);
    if(!k->key) return -ENOMEM;
    for(row = 0; row < k->rows; row++)
        for(column = 0; column < k->columns; column++)
            COMP_TRY(hal_pin_new_bool(comp_id, HAL_OUT, &k->key[row * k->columns + column], 0,
                                      "%s.key.r%xc%x", name, (unsigned)row, (unsigned)column));
    if(k->scans) COMP_TRY(export_scanning(k, name));
    else COMP_TRY(hal_pin_new_ui32(comp_id, HAL_IN, &k->keycode, 0, "%s.keycode", name));
    return hal_export_functf(run, k, 1, 0, comp_id, "%s", name);
}

int rtapi_app_main(void)
{
    int i, count, named, r = 0;
    for(count = 0; count < MAX_INSTANCES && config[count] && config[count][0]; count++) {}
    for(named = 0; named < MAX_INSTANCES && names[named] && names[named][0]; named++) {}
    if(count == 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "The matrix_kb component requires at least one valid format string\n");
        return -EINVAL;
    }
    if(named && named != count) {
        rtapi_print_msg(RTAPI_MSG_ERR, "matrix_kb: Number of sizes and number of names must match\n");
        return -1;
    }
    comp_id = hal_init("matrix_kb");
    if(comp_id < 0) return comp_id;
    for(i = 0; r >= 0 && i < count; i++) r = export_keyboard(i);
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
