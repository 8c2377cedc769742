/* A component in the typed interface: defaults, an init function, a constructor. */
#include <rtapi.h>
#include <rtapi_app.h>
#include <hal.h>

MODULE_LICENSE("GPL");

typedef struct {
    hal_real_t in, out;
    hal_sint_t ticks, big;
    hal_uint_t bits;
    hal_bool_t started;
    hal_real_t offset;
    hal_refs_u hidden;
} inst_t;

static int id;

static void begin(void *arg, long period)
{
    inst_t *p = arg;
    (void)period;
    hal_set_bool(p->started, true);
    hal_set_sint(p->big, -5000000000LL);
}

static void run(void *arg, long period)
{
    inst_t *p = arg;
    (void)period;
    hal_set_real(p->out, 2 * hal_get_real(p->in) + hal_get_real(p->offset));
    hal_set_si32(p->ticks, hal_get_si32(p->ticks) + 1);
    hal_set_ui32(p->bits, hal_get_ui32(p->bits) << 1 | 1);
    hal_set_real(p->hidden.r, hal_get_real(p->hidden.r) + 1);
}

static int make(const char *name, const char *arg)
{
    inst_t *p = hal_malloc(sizeof *p);
    if (!p) return -ENOMEM;
    hal_set_unready(id);
    if (hal_pin_new_real(id, HAL_IN, &p->in, 0.5, "%s.in", name) || hal_pin_new_real(id, HAL_OUT, &p->out, 0, "%s.out", name) ||
        hal_pin_new_si32(id, HAL_OUT, &p->ticks, 0, "%s.ticks", name) ||
        hal_pin_new_sint(id, HAL_OUT, &p->big, 0, "%s.big", name) ||
        hal_pin_new_ui32(id, HAL_IO, &p->bits, 0, "%s.bits", name) ||
        hal_pin_new_bool(id, HAL_OUT, &p->started, false, "%s.started", name) ||
        hal_param_new_real(id, HAL_RW, &p->offset, arg && *arg ? 10 : 0, "%s.offset", name) ||
        hal_param_new_fake(id, &p->hidden) ||
        hal_export_functf(begin, p, 1, 0, id, "%s.begin", name) || hal_export_functf(run, p, 1, 1, id, "%s.run", name)) {
        return -EINVAL;
    }
    return hal_ready(id);
}

int rtapi_app_main(void)
{
    if ((id = hal_init("typed")) < 0) return id;
    hal_set_constructor(id, make);
    int r = make("typed.0", NULL);
    if (r < 0) hal_exit(id);
    return r;
}

void rtapi_app_exit(void) { hal_exit(id); }
