/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * scarakins.c - SCARA arm: two links in the plane, a lift, a turning wrist.
 *
 * In, out: kinematics.h; pins scarakins.D1 to .D6
 * Thread:  servo
 * Method:  law of cosines; iflags 1 = elbow on the other side. Out of reach fails
 *          (the peer clamps: docs/compatibility.md).
 */
#include "kins_common.h"
#include "switchkins.h"
#include "switchkins_util.h"

static struct {
    hal_real_t D[6];
} *pins;

#define REACH_EPSILON 1e-9 /* of the cosine: rounding at full stretch */

static int setup(const int comp_id, const char *coordinates, kparms *kp)
{
    static const double initial[] = {490, 340, 50, 250, 50, 50};
    int joint_of[EMCMOT_MAX_AXIS], r = 0;
    if (switchkins_joints_of_axes(coordinates, kp, joint_of) != 0)
        return -1;
    pins = hal_malloc(sizeof(*pins));
    for (int i = 0; pins && i < 6; i++)
        r |= hal_pin_new_real(comp_id, HAL_IN, &pins->D[i], initial[i], "%s.D%d", kp->halprefix, i + 1);
    return pins && r >= 0 ? 0 : -1;
}

static double D(int i) { return hal_get_real(pins->D[i - 1]); }

static int forward(const double *joint, EmcPose *world, const KINEMATICS_FORWARD_FLAGS *fflags,
                   KINEMATICS_INVERSE_FLAGS *iflags)
{
    double s0, c0, s1, c1, s3, c3;
    (void)fflags;
    sincos_deg(joint[0], &s0, &c0);
    sincos_deg(joint[0] + joint[1], &s1, &c1);
    sincos_deg(joint[0] + joint[1] + joint[3], &s3, &c3);
    *iflags = joint[1] < 0.0; /* the side of the elbow */
    world->tran.x = D(2) * c0 + D(4) * c1 + D(6) * c3;
    world->tran.y = D(2) * s0 + D(4) * s1 + D(6) * s3;
    world->tran.z = D(1) + D(3) - joint[2] - D(5);
    world->c = joint[0] + joint[1] + joint[3];
    world->a = joint[4];
    world->b = joint[5];
    return 0;
}

static int inverse(const EmcPose *world, double *joint, const KINEMATICS_INVERSE_FLAGS *iflags,
                   KINEMATICS_FORWARD_FLAGS *fflags)
{
    double s, c, xt, yt, cc, q0, q1, d2 = D(2), d4 = D(4);
    int other = iflags ? (int)*iflags : 0;
    sincos_deg(world->c, &s, &c);
    xt = world->tran.x - D(6) * c;
    yt = world->tran.y - D(6) * s;
    cc = (xt * xt + yt * yt - d2 * d2 - d4 * d4) / (2.0 * d2 * d4);
    if (!(fabs(cc) <= 1.0 + REACH_EPSILON))
        return -1;
    q1 = acos(fmax(-1.0, fmin(1.0, cc)));
    if (other)
        q1 = -q1;
    q0 = atan2(yt, xt) - atan2(d4 * sin(q1), d2 + d4 * cos(q1));
    q0 = nearest_turn(q0 * TO_DEG, joint[0]);
    q1 = nearest_turn(q1 * TO_DEG, joint[1]);
    joint[0] = q0;
    joint[1] = q1;
    joint[2] = D(1) + D(3) - D(5) - world->tran.z;
    joint[3] = world->c - (q0 + q1);
    joint[4] = world->a;
    joint[5] = world->b;
    *fflags = 0;
    return 0;
}

int switchkinsSetup(kparms *kp, KS *ks0, KS *ks1, KS *ks2, KF *kf0, KF *kf1, KF *kf2, KI *ki0, KI *ki1, KI *ki2)
{
    kp->sparm = NULL;
    kp->kinsname = kp->halprefix = "scarakins";
    kp->required_coordinates = "xyzabc";
    kp->max_joints = 6;
    kp->allow_duplicates = 0;
    switchkins_usual_types(kp, setup, forward, inverse, ks0, ks1, ks2, kf0, kf1, kf2, ki0, ki1, ki2);
    return 0;
}
