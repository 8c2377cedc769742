/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * tp.h - what a trajectory planner module (tpmod) exports to motmod.
 *
 * Context: tpMotFunctions, tpMotData, tpCreate [init]; everything else [servo].
 * Units: machine units, degrees, seconds. Results: tp_err_t.
 * All symbols are exported with EXPORT_SYMBOL by the module.
 */
#ifndef KERF_TP_H
#define KERF_TP_H

#include "motion.h"
#include "tp_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* [init] Callbacks into motmod: outputs, rotary locks, limits of an axis (0..8). */
extern void tpMotFunctions(void (*DioWrite)(int idx, char val), void (*AioWrite)(int idx, double val),
                           void (*SetRotaryUnlock)(int joint, int unlock), int (*GetRotaryIsUnlocked)(int joint),
                           double (*axis_get_vel_limit)(int axis), double (*axis_get_acc_limit)(int axis));
/* The machine behind the axes, for a planner that plans in joint limits. All functions [servo]. */
struct tp_machine {
    int (*joints)(void); /* that the kinematics move */
    int (*inverse)(const EmcPose *pose, double *joint); /* kinematicsInverse: joint is seed and result */
    void (*joint_commands)(double *joint);
    void (*joint_limits)(int joint, double *vel, double *acc, double *jerk); /* jerk 0: none */
    double (*axis_jerk)(int axis);                      /* 0: none */
};
/* [init] Optional for a planner module: without it only the limits of axes and moves count. The
 * machine must outlive the planner. */
extern void tpMotMachine(const struct tp_machine *machine);
/* [init] The status block the planner writes its progress to, and the configuration it reads. */
extern void tpMotData(emcmot_status_t *status, emcmot_config_t *config);

extern int tpCreate(TP_STRUCT *tp, int queueSize, int id);
extern int tpClear(TP_STRUCT *tp);
extern int tpSetCycleTime(TP_STRUCT *tp, double secs);
extern int tpSetVmax(TP_STRUCT *tp, double vmax, double ini_maxvel);
extern int tpSetVlimit(TP_STRUCT *tp, double limit);
extern int tpSetAmax(TP_STRUCT *tp, double amax);
extern int tpSetId(TP_STRUCT *tp, int id);
extern int tpGetExecId(TP_STRUCT *tp);
extern struct state_tag_t tpGetExecTag(TP_STRUCT *tp);
extern int tpSetTermCond(TP_STRUCT *tp, int cond, double tolerance);
extern int tpSetPos(TP_STRUCT *tp, EmcPose const *pos);
extern int tpGetPos(TP_STRUCT const *tp, EmcPose *pos);
/* One servo cycle of period ns; the new position is read with tpGetPos. */
extern int tpRunCycle(TP_STRUCT *tp, long period);
extern int tpPause(TP_STRUCT *tp);
extern int tpResume(TP_STRUCT *tp);
extern int tpAbort(TP_STRUCT *tp);
extern int tpAddLine(TP_STRUCT *tp, EmcPose end, int canon_motion_type, double vel, double ini_maxvel,
                     double acc, double ini_maxjerk, unsigned char enables, char atspeed,
                     int indexer_jnum, struct state_tag_t tag);
extern int tpAddCircle(TP_STRUCT *tp, EmcPose end, PmCartesian center, PmCartesian normal, int turn,
                       int canon_motion_type, double vel, double ini_maxvel, double acc, double ini_maxjerk,
                       unsigned char enables, char atspeed, struct state_tag_t tag);
extern int tpAddRigidTap(TP_STRUCT *tp, EmcPose end, double vel, double ini_maxvel, double acc,
                         double ini_maxjerk, unsigned char enables, double scale, struct state_tag_t tag);
extern int tpIsDone(TP_STRUCT *tp);
extern int tpQueueDepth(TP_STRUCT *tp);
extern int tpActiveDepth(TP_STRUCT *tp);
extern int tpGetMotionType(TP_STRUCT *tp);
extern int tpSetSpindleSync(TP_STRUCT *tp, int spindle, double sync, int velocity_mode);
extern int tpSetAout(TP_STRUCT *tp, unsigned char index, double start, double end);
extern int tpSetDout(TP_STRUCT *tp, int index, unsigned char start, unsigned char end);
extern int tpSetRunDir(TP_STRUCT *tp, tc_direction_t dir);
extern int tcqFull(TC_QUEUE_STRUCT const *queue);

#ifdef __cplusplus
}
#endif
#endif
