/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * userkins.c - template of a user's kinematics module: copy, rename, change the two functions.
 *
 * In, out: kinematics.h; pins userkins.in, .out; parameters .param-rw, .param-ro;
 *          function userkins.0.fdemo
 * Thread:  servo
 */
#include "kins_common.h"
#include "rtapi_app.h"

MODULE_AUTHOR("Kerf");
MODULE_DESCRIPTION("Template of user kinematics");
MODULE_LICENSE("GPL");

static struct {
    hal_uint_t in, out;
    hal_real_t param_rw, param_ro;
    hal_sint_t fpin;
} *pins;
static int inverse_seen;

int kinematicsForward(const double *joint, EmcPose *world, const KINEMATICS_FORWARD_FLAGS *fflags,
                      KINEMATICS_INVERSE_FLAGS *iflags)
{
    static int told;
    EmcPose p = {{joint[0], joint[1], joint[2]}, 0, 0, 0, 0, 0, 0};
    (void)fflags;
    (void)iflags;
    if (hal_get_ui32(pins->in) != 0 && !inverse_seen && !told) {
        rtapi_print_msg(RTAPI_MSG_INFO, "%s the 'in' pin not echoed until Inverse called\n", "userkins.c");
        told = 1;
    }
    *world = p;
    return 0;
}

int kinematicsInverse(const EmcPose *world, double *joint, const KINEMATICS_INVERSE_FLAGS *iflags,
                      KINEMATICS_FORWARD_FLAGS *fflags)
{
    (void)iflags;
    (void)fflags;
    inverse_seen = 1;
    hal_set_ui32(pins->out, hal_get_ui32(pins->in));
    joint[0] = world->tran.x;
    joint[1] = world->tran.y;
    joint[2] = world->tran.z;
    return 0;
}

KINEMATICS_TYPE kinematicsType(void) { return KINEMATICS_IDENTITY; }

KINS_NOT_SWITCHABLE
EXPORT_SYMBOL(kinematicsType);
EXPORT_SYMBOL(kinematicsForward);
EXPORT_SYMBOL(kinematicsInverse);

static void fdemo(void *arg, long period)
{
    static int told;
    (void)arg;
    (void)period;
    if (!told) {
        rtapi_print("fdemo function added to thread\n");
        told = 1;
    }
    hal_set_si32(pins->fpin, hal_get_si32(pins->fpin) + 1);
}

static int comp_id;

int rtapi_app_main(void)
{
    comp_id = hal_init("userkins");
    if (comp_id < 0)
        return comp_id;
    pins = hal_malloc(sizeof(*pins));
    if (!pins || hal_pin_new_ui32(comp_id, HAL_IN, &pins->in, 0, "userkins.in") < 0 ||
        hal_pin_new_ui32(comp_id, HAL_OUT, &pins->out, 0, "userkins.out") < 0 ||
        hal_param_new_real(comp_id, HAL_RW, &pins->param_rw, 0, "userkins.param-rw") < 0 ||
        hal_param_new_real(comp_id, HAL_RO, &pins->param_ro, 0, "userkins.param-ro") < 0 ||
        hal_pin_new_si32(comp_id, HAL_OUT, &pins->fpin, 0, "userkins.0.fpin") < 0 ||
        hal_export_functf(fdemo, NULL, 1, 0, comp_id, "userkins.0.fdemo") < 0) {
        hal_exit(comp_id);
        return -1;
    }
    return hal_ready(comp_id);
}

void rtapi_app_exit(void) { hal_exit(comp_id); }
