/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * millturn.c - one machine as mill (type 0) and as lathe (type 1).
 *
 * In, out: kinematics.h; pins millturn.in, .out, kinstype.is-0, .is-1; function millturn.0.fdemo
 * Thread:  servo
 * Method:  mill: X Y Z A = joints 0 to 3; lathe: X = joint 2, Y = -joint 1, Z = joint 0.
 */
#include "kins_main.h"
#include "ownswitch.h"

MODULE_AUTHOR("Kerf");
MODULE_DESCRIPTION("Switchable kinematics: mill and lathe");
MODULE_LICENSE("GPL");

static struct {
    hal_uint_t in, out;
    hal_sint_t fpin;
} *pins;
static int inverse_seen;

int kinematicsForward(const double *j, EmcPose *world, const KINEMATICS_FORWARD_FLAGS *fflags,
                      KINEMATICS_INVERSE_FLAGS *iflags)
{
    static int told;
    EmcPose p = {{j[0], j[1], j[2]}, j[3], 0, 0, 0, 0, 0};
    (void)fflags;
    (void)iflags;
    if (hal_get_ui32(pins->in) != 0 && !inverse_seen && !told) {
        rtapi_print_msg(RTAPI_MSG_INFO, "%s the 'in' pin not echoed until Inverse called\n", "millturn.c");
        told = 1;
    }
    if (type_now == 1) {
        p.tran.x = j[2];
        p.tran.y = -j[1];
        p.tran.z = j[0];
    }
    *world = p;
    return 0;
}

int kinematicsInverse(const EmcPose *world, double *j, const KINEMATICS_INVERSE_FLAGS *iflags,
                      KINEMATICS_FORWARD_FLAGS *fflags)
{
    (void)iflags;
    (void)fflags;
    inverse_seen = 1;
    hal_set_ui32(pins->out, hal_get_ui32(pins->in));
    j[0] = type_now == 1 ? world->tran.z : world->tran.x;
    j[1] = type_now == 1 ? -world->tran.y : world->tran.y;
    j[2] = type_now == 1 ? world->tran.x : world->tran.z;
    j[3] = world->a;
    return 0;
}

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

const char kins_name[] = "millturn";

int kins_setup(int comp_id)
{
    pins = hal_malloc(sizeof(*pins));
    if (!pins || hal_pin_new_ui32(comp_id, HAL_IN, &pins->in, 0, "millturn.in") < 0 ||
        hal_pin_new_ui32(comp_id, HAL_OUT, &pins->out, 0, "millturn.out") < 0 ||
        hal_pin_new_si32(comp_id, HAL_OUT, &pins->fpin, 0, "millturn.0.fpin") < 0 ||
        hal_export_functf(fdemo, NULL, 1, 0, comp_id, "millturn.0.fdemo") < 0 || ownswitch_pins(comp_id, 2) != 0)
        return -1;
    return 0;
}
