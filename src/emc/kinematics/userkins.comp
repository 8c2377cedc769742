// SPDX-License-Identifier: GPL-2.0-or-later
component userkins "Template of a kinematics module of one's own";
description """
Copy this file, rename the component, write the formulas of your machine into kinematicsForward and
kinematicsInverse, build it with *halcompile --install* and name it in the INI file, [KINS]KINEMATICS.

As it stands joints 0, 1 and 2 are X, Y and Z. The pins and parameters only show how to make some:
*userkins.in* is copied to *userkins.out* when joints are computed.""";
pin out s32 fpin = 0 "Counts the runs of fdemo.";
function fdemo "An example of a function for a thread.";
option extra_setup;
license "GPL";
author "Kerf developers";
see_also "halcompile(1)";
;;
#include "emcmotcfg.h"
#include "kinematics.h"

static struct {
    hal_u32_t *in, *out;
    hal_float_t param_rw, param_ro;
    int inverse_seen;
} *data;

// [init] Pins and parameters that belong to the module, not to an instance of the component.
EXTRA_SETUP()
{
    (void)prefix, (void)extra_arg;
    data = hal_malloc(sizeof(*data));
    if(!data) return -1;
    if(hal_pin_u32_newf(HAL_IN, &data->in, comp_id, "userkins.in") < 0 ||
       hal_pin_u32_newf(HAL_OUT, &data->out, comp_id, "userkins.out") < 0 ||
       hal_param_float_newf(HAL_RW, &data->param_rw, comp_id, "userkins.param-rw") < 0 ||
       hal_param_float_newf(HAL_RO, &data->param_ro, comp_id, "userkins.param-ro") < 0)
        return -1;
    return 0;
}

FUNCTION(fdemo)
{
    static int told;
    if(!told) rtapi_print("fdemo function added to thread\n");
    told = 1;
    fpin++;
}

// BOTH instead of IDENTITY as soon as the formulas are more than a renaming of joints to axes.
KINEMATICS_TYPE kinematicsType(void) { return KINEMATICS_IDENTITY; }
KINS_NOT_SWITCHABLE

// [servo] Joints to pose. Returns 0, or -1 when there is none.
int kinematicsForward(const double *joint, EmcPose *world, const KINEMATICS_FORWARD_FLAGS *fflags,
                      KINEMATICS_INVERSE_FLAGS *iflags)
{
    static int told;
    (void)fflags, (void)iflags;
    if(*data->in && !data->inverse_seen && !told) {
        rtapi_print("%s the 'in' pin not echoed until Inverse called\n", "userkins.comp");
        told = 1;
    }
    world->tran.x = joint[0];
    world->tran.y = joint[1];
    world->tran.z = joint[2];
    world->a = world->b = world->c = 0;
    world->u = world->v = world->w = 0;
    return 0;
}

// [servo] Pose to joints. Returns 0, or -1 out of reach: then joint must be left as it is.
int kinematicsInverse(const EmcPose *world, double *joint, const KINEMATICS_INVERSE_FLAGS *iflags,
                      KINEMATICS_FORWARD_FLAGS *fflags)
{
    (void)iflags, (void)fflags;
    data->inverse_seen = 1;
    *data->out = *data->in;
    joint[0] = world->tran.x;
    joint[1] = world->tran.y;
    joint[2] = world->tran.z;
    return 0;
}

EXPORT_SYMBOL(kinematicsType);
EXPORT_SYMBOL(kinematicsForward);
EXPORT_SYMBOL(kinematicsInverse);
