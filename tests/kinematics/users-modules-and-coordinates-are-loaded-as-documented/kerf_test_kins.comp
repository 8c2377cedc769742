component kerf_test_kins "A user's kinematics: a tilted XY table, switchable by its own code";
pin out bit is_tilted = 0 "type 1";
param rw float slope = 0.5;
function fdemo;
pin out s32 counted;
license "GPL";
;;
#include "rtapi_math.h"
#include "kinematics.h"
#include "emcmotcfg.h"

FUNCTION(fdemo) { counted++; }

static struct haldata { hal_float_t *scale; } *haldata;
static int type;

static int ready_to_make_pins(void)
{
    static int done;
    int id = comp_id, res;
    if (done) return 0;
    done = 1;
    res = hal_set_unready(id);
    haldata = hal_malloc(sizeof(*haldata));
    if (!haldata) return -1;
    res |= hal_pin_float_newf(HAL_IN, &haldata->scale, id, "kerf_test_kins.scale");
    *haldata->scale = 1.0;
    return res | hal_ready(id);
}

KINEMATICS_TYPE kinematicsType(void) { ready_to_make_pins(); return KINEMATICS_BOTH; }
int kinematicsSwitchable(void) { return 1; }
int kinematicsSwitch(int t)
{
    if (t != 0 && t != 1) return -1;
    type = t;
    return 0;
}

int kinematicsForward(const double *j, EmcPose *pos, const KINEMATICS_FORWARD_FLAGS *f, KINEMATICS_INVERSE_FLAGS *i)
{
    (void)f, (void)i;
    pos->tran.x = j[0] / *haldata->scale + (type ? 0.5 * j[1] : 0);
    pos->tran.y = j[1];
    pos->tran.z = j[2];
    return 0;
}

int kinematicsInverse(const EmcPose *pos, double *j, const KINEMATICS_INVERSE_FLAGS *i, KINEMATICS_FORWARD_FLAGS *f)
{
    (void)f, (void)i;
    j[0] = (pos->tran.x - (type ? 0.5 * pos->tran.y : 0)) * *haldata->scale;
    j[1] = pos->tran.y;
    j[2] = pos->tran.z;
    return 0;
}

EXPORT_SYMBOL(kinematicsType);
EXPORT_SYMBOL(kinematicsSwitchable);
EXPORT_SYMBOL(kinematicsSwitch);
EXPORT_SYMBOL(kinematicsForward);
EXPORT_SYMBOL(kinematicsInverse);
