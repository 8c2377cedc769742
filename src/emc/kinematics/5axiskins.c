/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * 5axiskins.c - bridge mill with a head that turns (C) and tilts (B).
 *
 * In, out: kinematics.h; pin 5axiskins.pivot-length
 * Thread:  servo
 * Method:  the tool hangs pivot-length + W below the pivot, in spherical coordinates.
 */
#include "kins_common.h"
#include "switchkins.h"
#include "switchkins_util.h"

static struct {
    hal_real_t pivot_length;
} *pins;
static int joint_of[EMCMOT_MAX_AXIS];
static int max_joints;

static int setup(const int comp_id, const char *coordinates, kparms *kp)
{
    max_joints = kp->max_joints;
    if (switchkins_joints_of_axes(coordinates, kp, joint_of) != 0)
        return -1;
    pins = hal_malloc(sizeof(*pins));
    return pins ? hal_pin_new_real(comp_id, HAL_IN, &pins->pivot_length, 250.0, "%s.pivot-length", kp->halprefix) : -1;
}

/* From the pivot to the tool's tip, less the vertical pivot length. */
static PmCartesian tool(double b, double c, double w)
{
    double st, ct, sp, cp, pivot = hal_get_real(pins->pivot_length), r = pivot + w;
    sincos_deg(c, &st, &ct);
    sincos_deg(180.0 - b, &sp, &cp);
    PmCartesian v = {r * sp * ct, r * sp * st, r * cp + pivot};
    return v;
}

static int forward(const double *joint, EmcPose *world, const KINEMATICS_FORWARD_FLAGS *fflags,
                   KINEMATICS_INVERSE_FLAGS *iflags)
{
    EmcPose p;
    (void)fflags;
    (void)iflags;
    ZERO_EMC_POSE(p);
    mapped_joints_to_position(max_joints, joint, &p);
    PmCartesian t = tool(p.b, p.c, p.w);
    pmCartAddEq(&p.tran, &t);
    *world = p;
    return 0;
}

static int inverse(const EmcPose *world, double *joint, const KINEMATICS_INVERSE_FLAGS *iflags,
                   KINEMATICS_FORWARD_FLAGS *fflags)
{
    EmcPose q = *world;
    PmCartesian t = tool(q.b, q.c, q.w);
    (void)iflags;
    (void)fflags;
    pmCartSubEq(&q.tran, &t);
    return position_to_mapped_joints(max_joints, &q, joint);
}

int switchkinsSetup(kparms *kp, KS *ks0, KS *ks1, KS *ks2, KF *kf0, KF *kf1, KF *kf2, KI *ki0, KI *ki1, KI *ki2)
{
    kp->kinsname = kp->halprefix = "5axiskins";
    kp->required_coordinates = "XYZBCW";
    kp->max_joints = 9;
    kp->allow_duplicates = 1;
    switchkins_usual_types(kp, setup, forward, inverse, ks0, ks1, ks2, kf0, kf1, kf2, ki0, ki1, ki2);
    return 0;
}
