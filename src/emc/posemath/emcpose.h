/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * emcpose.h - arithmetic on nine-axis positions.
 *
 * Context: [any]. Axis numbers: 0..8 = X Y Z A B C U V W.
 * Results: 0, or EMCPOSE_ERR_* for a null pointer. Output may be an input.
 */
#ifndef KERF_EMCPOSE_H
#define KERF_EMCPOSE_H

#include "emcpos.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
    EMCPOSE_ERR_OK = 0,
    EMCPOSE_ERR_FAIL = -1,
    EMCPOSE_ERR_INPUT_MISSING = -2,
    EMCPOSE_ERR_OUTPUT_MISSING = -3
} EmcPoseErr;

void emcPoseZero(EmcPose *pos);
int emcPoseAdd(EmcPose const *a, EmcPose const *b, EmcPose *out);
int emcPoseSub(EmcPose const *a, EmcPose const *b, EmcPose *out); /* a - b */
int emcPoseSelfAdd(EmcPose *self, EmcPose const *b);
int emcPoseSelfSub(EmcPose *self, EmcPose const *b);
int emcPoseMultScalar(EmcPose *self, double s);
int emcPoseMagnitude(EmcPose const *pos, double *out); /* Euclidean norm of all nine */
int emcPoseGetXYZ(EmcPose const *pos, PmCartesian *out);
int emcPoseGetABC(EmcPose const *pos, PmCartesian *out);
int emcPoseGetUVW(EmcPose const *pos, PmCartesian *out);
int emcPoseSetXYZ(PmCartesian const *xyz, EmcPose *pos);
int emcPoseSetABC(PmCartesian const *abc, EmcPose *pos);
int emcPoseSetUVW(PmCartesian const *uvw, EmcPose *pos);
int emcPoseToPmCartesian(EmcPose const *pos, PmCartesian *xyz, PmCartesian *abc, PmCartesian *uvw);
int pmCartesianToEmcPose(PmCartesian const *xyz, PmCartesian const *abc, PmCartesian const *uvw, EmcPose *pos);
int emcPoseValid(EmcPose const *pos); /* 1: all nine finite */

/* The axis' value in place; axis 0..8, otherwise a null pointer. */
double *emcPoseAxis(EmcPose *pos, int axis);
double emcPoseGetAxis(EmcPose const *pos, int axis); /* 0 for a bad axis */

#ifdef __cplusplus
}
#endif
#endif
