/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * module.c - the realtime module tpmod: parameters; exports the planner's functions to motmod.
 */
#include "hal.h"
#include "rtapi.h"
#include "rtapi_app.h"
#include "tp_priv.h"

MODULE_LICENSE("GPL");
MODULE_AUTHOR("Kerf");
MODULE_DESCRIPTION("trajectory planner");

static char *tp_parms;
RTAPI_MP_STRING(tp_parms, "accepted, not used");

static int comp_id;

static int make_params(void)
{
    int r = 0;
    tp_work_only = hal_malloc(PATH_AXES * sizeof *tp_work_only);
    if (!tp_work_only) return -1;
    for (int n = 0; n < PATH_AXES && r >= 0; n++)
        r = hal_param_new_bool(comp_id, HAL_RW, &tp_work_only[n], 0, "axis.%c.eoffset-work-only", "xyzabcuvw"[n]);
    return r;
}

int rtapi_app_main(void)
{
    comp_id = hal_init("tpmod");
    if (comp_id < 0) return comp_id;
    if (make_params() < 0) {
        hal_exit(comp_id);
        return -1;
    }
    return hal_ready(comp_id);
}

void rtapi_app_exit(void)
{
    hal_exit(comp_id);
}

EXPORT_SYMBOL(tpMotFunctions);
EXPORT_SYMBOL(tpMotMachine);
EXPORT_SYMBOL(tpMotData);
EXPORT_SYMBOL(tpCreate);
EXPORT_SYMBOL(tpClear);
EXPORT_SYMBOL(tpSetCycleTime);
EXPORT_SYMBOL(tpSetVmax);
EXPORT_SYMBOL(tpSetVlimit);
EXPORT_SYMBOL(tpSetAmax);
EXPORT_SYMBOL(tpSetId);
EXPORT_SYMBOL(tpGetExecId);
EXPORT_SYMBOL(tpGetExecTag);
EXPORT_SYMBOL(tpSetTermCond);
EXPORT_SYMBOL(tpSetPos);
EXPORT_SYMBOL(tpGetPos);
EXPORT_SYMBOL(tpRunCycle);
EXPORT_SYMBOL(tpPause);
EXPORT_SYMBOL(tpResume);
EXPORT_SYMBOL(tpAbort);
EXPORT_SYMBOL(tpAddLine);
EXPORT_SYMBOL(tpAddCircle);
EXPORT_SYMBOL(tpAddRigidTap);
EXPORT_SYMBOL(tpIsDone);
EXPORT_SYMBOL(tpQueueDepth);
EXPORT_SYMBOL(tpActiveDepth);
EXPORT_SYMBOL(tpGetMotionType);
EXPORT_SYMBOL(tpSetSpindleSync);
EXPORT_SYMBOL(tpSetAout);
EXPORT_SYMBOL(tpSetDout);
EXPORT_SYMBOL(tpSetRunDir);
EXPORT_SYMBOL(tcqFull);
