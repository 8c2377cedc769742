/* SPDX-License-Identifier: GPL-2.0-or-later
 * A kinematics in plain C, as users write them: joint 0 is the distance of the tool from a tower's top. */
#include "rtapi.h"
#include "rtapi_app.h"
#include "rtapi_math.h"
#include "hal.h"
#include "posemath.h"
#include "kinematics.h"
#include "motion.h"

MODULE_LICENSE("GPL");

static struct { hal_float_t *height; hal_float_t shown; } *data;
static int comp_id;

int kinematicsInverse(const EmcPose *world, double *joint, const KINEMATICS_INVERSE_FLAGS *iflags, KINEMATICS_FORWARD_FLAGS *fflags)
{
    PmCartesian top = {0, 0, *data->height}, way;
    (void)iflags;
    pmCartCartSub(&world->tran, &top, &way);
    pmCartMag(&way, &joint[0]);
    joint[1] = world->tran.x;
    joint[2] = world->tran.y;
    *fflags = world->tran.z > top.z;
    return 0;
}

int kinematicsForward(const double *joint, EmcPose *world, const KINEMATICS_FORWARD_FLAGS *fflags, KINEMATICS_INVERSE_FLAGS *iflags)
{
    double h = pmSq(joint[0]) - pmSq(joint[1]) - pmSq(joint[2]);
    (void)iflags;
    if(h < 0) return -1;
    world->tran.x = joint[1];
    world->tran.y = joint[2];
    world->tran.z = *data->height + (*fflags ? 1 : -1) * sqrt(h);
    return 0;
}

KINEMATICS_TYPE kinematicsType(void) { return KINEMATICS_BOTH; }
KINS_NOT_SWITCHABLE
EXPORT_SYMBOL(kinematicsType);
EXPORT_SYMBOL(kinematicsForward);
EXPORT_SYMBOL(kinematicsInverse);

int rtapi_app_main(void)
{
    comp_id = hal_init("kerf_test_tower");
    if(comp_id < 0) return comp_id;
    data = hal_malloc(sizeof(*data));
    if(!data || hal_pin_float_new("kerf_test_tower.height", HAL_IO, &data->height, comp_id) < 0
       || hal_param_float_newf(HAL_RW, &data->shown, comp_id, "kerf_test_tower.%s", "shown") < 0) {
        hal_exit(comp_id);
        return -1;
    }
    *data->height = 100;
    return hal_ready(comp_id);
}

void rtapi_app_exit(void) { hal_exit(comp_id); }
