/* A component as written for any version: legacy pins, array parameters. */
#include "rtapi.h"
#include "rtapi_app.h"
#include "hal.h"

MODULE_LICENSE("GPL");

#define MAX_CHAN 4
static int num_chan = 1;
RTAPI_MP_INT(num_chan, "number of channels");
static char *names[MAX_CHAN];
RTAPI_MP_ARRAY_STRING(names, MAX_CHAN, "names");

typedef struct {
    hal_float_t *in, *out;
    hal_bit_t *enable;
    hal_s32_t *count;
    hal_float_t gain;
    hal_u32_t limit;
} channel_t;

static int comp_id;
static channel_t *channels;

static void update(void *arg, long period)
{
    channel_t *c = arg;
    (void)period;
    if (*c->enable) {
        *c->out = *c->in * c->gain;
        *c->count += 1;
        if (c->limit && *c->count > (int)c->limit) *c->count = 0;
    }
}

static int export_channel(int n, channel_t *c, const char *name)
{
    int r;
    if ((r = hal_pin_float_newf(HAL_IN, &c->in, comp_id, "%s.in", name)) < 0) return r;
    if ((r = hal_pin_float_newf(HAL_OUT, &c->out, comp_id, "%s.out", name)) < 0) return r;
    if ((r = hal_pin_bit_newf(HAL_IN, &c->enable, comp_id, "%s.enable", name)) < 0) return r;
    if ((r = hal_pin_s32_newf(HAL_OUT, &c->count, comp_id, "%s.count", name)) < 0) return r;
    if ((r = hal_param_float_newf(HAL_RW, &c->gain, comp_id, "%s.gain", name)) < 0) return r;
    if ((r = hal_param_u32_newf(HAL_RW, &c->limit, comp_id, "%s.limit", name)) < 0) return r;
    *c->enable = 1;
    c->gain = 1.0 + n;
    return hal_export_functf(update, c, 1, 0, comp_id, "%s.update", name);
}

// The name that a record's element had before 2.10.
int hal_stream_of_before(hal_stream_t *stream, union hal_stream_data *record);
int hal_stream_of_before(hal_stream_t *stream, union hal_stream_data *record)
{
    return hal_stream_write(stream, record);
}

int rtapi_app_main(void)
{
    comp_id = hal_init("oldstyle");
    if (comp_id < 0) return comp_id;
    channels = hal_malloc(num_chan * sizeof(channel_t));
    if (!channels) {
        hal_exit(comp_id);
        return -1;
    }
    for (int n = 0; n < num_chan; n++) {
        char name[16];
        rtapi_snprintf(name, sizeof name, "old.%d", n);
        int r = export_channel(n, &channels[n], names[n] && names[n][0] ? names[n] : name);
        if (r < 0) {
            rtapi_print_msg(RTAPI_MSG_ERR, "OLDSTYLE: could not export channel %d\n", n);
            hal_exit(comp_id);
            return r;
        }
    }
    return hal_ready(comp_id);
}

void rtapi_app_exit(void) { hal_exit(comp_id); }
