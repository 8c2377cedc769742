/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * emcpose.c - arithmetic on nine-axis positions.   In, out: emcpose.h   Thread: any
 */
#include <math.h>
#include <stddef.h>
#include "emcpose.h"

void emcPoseZero(EmcPose *pos) { ZERO_EMC_POSE(*pos); }

double *emcPoseAxis(EmcPose *pos, int axis)
{
    switch (axis) {
    case 0: return &pos->tran.x;
    case 1: return &pos->tran.y;
    case 2: return &pos->tran.z;
    case 3: return &pos->a;
    case 4: return &pos->b;
    case 5: return &pos->c;
    case 6: return &pos->u;
    case 7: return &pos->v;
    case 8: return &pos->w;
    default: return NULL;
    }
}

double emcPoseGetAxis(EmcPose const *pos, int axis)
{
    double *v = emcPoseAxis((EmcPose *)pos, axis);
    return v ? *v : 0.0;
}

/* out = a + k b */
static int add_scaled(EmcPose const *a, EmcPose const *b, double k, EmcPose *out)
{
    if (!a || !b)
        return EMCPOSE_ERR_INPUT_MISSING;
    if (!out)
        return EMCPOSE_ERR_OUTPUT_MISSING;
    out->tran.x = a->tran.x + k * b->tran.x;
    out->tran.y = a->tran.y + k * b->tran.y;
    out->tran.z = a->tran.z + k * b->tran.z;
    out->a = a->a + k * b->a;
    out->b = a->b + k * b->b;
    out->c = a->c + k * b->c;
    out->u = a->u + k * b->u;
    out->v = a->v + k * b->v;
    out->w = a->w + k * b->w;
    return EMCPOSE_ERR_OK;
}

int emcPoseAdd(EmcPose const *a, EmcPose const *b, EmcPose *out) { return add_scaled(a, b, 1.0, out); }
int emcPoseSub(EmcPose const *a, EmcPose const *b, EmcPose *out) { return add_scaled(a, b, -1.0, out); }
int emcPoseSelfAdd(EmcPose *self, EmcPose const *b) { return add_scaled(self, b, 1.0, self); }
int emcPoseSelfSub(EmcPose *self, EmcPose const *b) { return add_scaled(self, b, -1.0, self); }

int emcPoseMultScalar(EmcPose *self, double s)
{
    if (!self)
        return EMCPOSE_ERR_INPUT_MISSING;
    for (int i = 0; i < 9; i++)
        *emcPoseAxis(self, i) *= s;
    return EMCPOSE_ERR_OK;
}

int emcPoseMagnitude(EmcPose const *pos, double *out)
{
    double sum = 0;
    if (!pos)
        return EMCPOSE_ERR_INPUT_MISSING;
    if (!out)
        return EMCPOSE_ERR_OUTPUT_MISSING;
    for (int i = 0; i < 9; i++)
        sum += pmSq(emcPoseGetAxis(pos, i));
    *out = sqrt(sum);
    return EMCPOSE_ERR_OK;
}

static int get3(EmcPose const *pos, int first, PmCartesian *out)
{
    if (!pos)
        return EMCPOSE_ERR_INPUT_MISSING;
    if (!out)
        return EMCPOSE_ERR_OUTPUT_MISSING;
    out->x = emcPoseGetAxis(pos, first);
    out->y = emcPoseGetAxis(pos, first + 1);
    out->z = emcPoseGetAxis(pos, first + 2);
    return EMCPOSE_ERR_OK;
}

static int set3(PmCartesian const *v, int first, EmcPose *pos)
{
    if (!v)
        return EMCPOSE_ERR_INPUT_MISSING;
    if (!pos)
        return EMCPOSE_ERR_OUTPUT_MISSING;
    *emcPoseAxis(pos, first) = v->x;
    *emcPoseAxis(pos, first + 1) = v->y;
    *emcPoseAxis(pos, first + 2) = v->z;
    return EMCPOSE_ERR_OK;
}

int emcPoseGetXYZ(EmcPose const *pos, PmCartesian *out) { return get3(pos, 0, out); }
int emcPoseGetABC(EmcPose const *pos, PmCartesian *out) { return get3(pos, 3, out); }
int emcPoseGetUVW(EmcPose const *pos, PmCartesian *out) { return get3(pos, 6, out); }
int emcPoseSetXYZ(PmCartesian const *xyz, EmcPose *pos) { return set3(xyz, 0, pos); }
int emcPoseSetABC(PmCartesian const *abc, EmcPose *pos) { return set3(abc, 3, pos); }
int emcPoseSetUVW(PmCartesian const *uvw, EmcPose *pos) { return set3(uvw, 6, pos); }

int emcPoseToPmCartesian(EmcPose const *pos, PmCartesian *xyz, PmCartesian *abc, PmCartesian *uvw)
{
    int r = get3(pos, 0, xyz);
    if (!r)
        r = get3(pos, 3, abc);
    return r ? r : get3(pos, 6, uvw);
}

int pmCartesianToEmcPose(PmCartesian const *xyz, PmCartesian const *abc, PmCartesian const *uvw, EmcPose *pos)
{
    int r = set3(xyz, 0, pos);
    if (!r)
        r = set3(abc, 3, pos);
    return r ? r : set3(uvw, 6, pos);
}

int emcPoseValid(EmcPose const *pos)
{
    if (!pos)
        return 0;
    for (int i = 0; i < 9; i++)
        if (!isfinite(emcPoseGetAxis(pos, i)))
            return 0;
    return 1;
}
