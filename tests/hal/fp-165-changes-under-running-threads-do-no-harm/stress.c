/* Functions that write and check values whose two halves must be equal. */
#include <rtapi.h>
#include <rtapi_app.h>
#include <hal.h>

MODULE_LICENSE("GPL");

#define FUNCTS 16
typedef struct {
    hal_sint_t out, in, errors;
    rtapi_s64 n;
} inst_t;
static int id;

static void run(void *arg, long period)
{
    inst_t *p = arg;
    (void)period;
    rtapi_s64 v = hal_get_sint(p->in);
    if ((rtapi_s32)(v >> 32) != (rtapi_s32)v) {
        hal_set_sint(p->errors, hal_get_sint(p->errors) + 1);
    }
    p->n = (p->n + 1) & 0x7fffffff;
    hal_set_sint(p->out, p->n << 32 | p->n);
}

int rtapi_app_main(void)
{
    if ((id = hal_init("stress")) < 0) return id;
    inst_t *p = hal_malloc(FUNCTS * sizeof *p);
    if (!p) return -ENOMEM;
    for (int i = 0; i < FUNCTS; i++) {
        if (hal_pin_new_sint(id, HAL_OUT, &p[i].out, 0, "stress.%d.out", i) ||
            hal_pin_new_sint(id, HAL_IN, &p[i].in, 0, "stress.%d.in", i) ||
            hal_pin_new_sint(id, HAL_OUT, &p[i].errors, 0, "stress.%d.errors", i) ||
            hal_export_functf(run, &p[i], 0, 0, id, "stress.%d", i)) {
            return -EINVAL;
        }
    }
    return hal_ready(id);
}

void rtapi_app_exit(void) { hal_exit(id); }
