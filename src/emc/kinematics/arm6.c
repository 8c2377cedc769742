/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * arm6.c - six-joint arms with a spherical wrist.
 *
 * In, out: arm6.h   Thread: servo
 * Method:  closed form, Paul and Zhang 1986: wrist centre, then orientation. At the
 *          wrist's singularity joint 3 keeps its value.
 */
#include "arm6.h"
#include "kins_common.h"
#include "switchkins_util.h"

#define SINGULAR 1e-6

static void position_columns(const struct arm6 *g, const double *q, PmHomogeneous *h)
{
    double s1, c1, s2, c2, s3, c3, s4, c4, s5, c5, s6, c6, t1, t3, t4;
    sincos_deg(q[0], &s1, &c1);
    sincos_deg(q[1], &s2, &c2);
    sincos_deg(q[2], &s3, &c3);
    sincos_deg(q[3], &s4, &c4);
    sincos_deg(q[4], &s5, &c5);
    sincos_deg(q[5], &s6, &c6);
    double s23 = c2 * s3 + s2 * c3, c23 = c2 * c3 - s2 * s3;

    t1 = c4 * c5 * c6 - s4 * s6;
    t3 = s4 * c5 * c6 + c4 * s6;
    t4 = c23 * t1 - s23 * s5 * c6;
    h->rot.x.x = c1 * t4 + s1 * t3;
    h->rot.x.y = s1 * t4 - c1 * t3;
    h->rot.x.z = -s23 * t1 - c23 * s5 * c6;

    t1 = -c4 * c5 * s6 - s4 * c6;
    t3 = c4 * c6 - s4 * c5 * s6;
    t4 = c23 * t1 + s23 * s5 * s6;
    h->rot.y.x = c1 * t4 + s1 * t3;
    h->rot.y.y = s1 * t4 - c1 * t3;
    h->rot.y.z = -s23 * t1 + c23 * s5 * s6;

    t1 = c23 * c4 * s5 + s23 * c5;
    h->rot.z.x = -c1 * t1 - s1 * s4 * s5;
    h->rot.z.y = -s1 * t1 + c1 * s4 * s5;
    h->rot.z.z = s23 * c4 * s5 - c23 * c5;

    t1 = g->A1 + g->A2 * c2 + g->A3 * c23 - g->D4 * s23;
    h->tran.x = c1 * t1 - g->D * s1;
    h->tran.y = s1 * t1 + g->D * c1;
    h->tran.z = g->D1 - g->A3 * s23 - g->A2 * s2 - g->D4 * c23;
}

static double wrap(double rad) { return remainder(rad, PM_2_PI); }
static int is_zero_turn(double rad) { return fabs(wrap(rad)) < SINGULAR; }

static double elbow_k(const struct arm6 *g, double px, double py, double pz, double s1, double c1)
{
    double sum = px * px + py * py - g->D * g->D;
    return (sum + pz * pz + g->A1 * g->A1 - 2.0 * g->A1 * (c1 * px + s1 * py) - g->A2 * g->A2 - g->A3 * g->A3 -
            g->D4 * g->D4) /
           (2.0 * g->A2);
}

/* Which of the solutions the joints are. */
static KINEMATICS_INVERSE_FLAGS configuration(const struct arm6 *g, const double *q, const PmHomogeneous *h)
{
    KINEMATICS_INVERSE_FLAGS flags = 0;
    double s1, c1, s23, c23, x = h->tran.x, y = h->tran.y;
    double sum = x * x + y * y - g->D * g->D;
    sincos_deg(q[0], &s1, &c1);
    sincos_deg(q[1] + q[2], &s23, &c23);
    double k = elbow_k(g, x, y, h->tran.z - g->D1, s1, c1), r2 = g->A3 * g->A3 + g->D4 * g->D4 - k * k;
    if (is_zero_turn(q[0] * TO_RAD - atan2(y, x) + atan2(g->D, -pmSqrt(sum))))
        flags |= ARM6_SHOULDER_RIGHT;
    if (is_zero_turn(q[2] * TO_RAD - atan2(g->A3, g->D4) + atan2(k, -pmSqrt(r2))))
        flags |= ARM6_ELBOW_DOWN;
    double t1 = -h->rot.z.x * s1 + h->rot.z.y * c1;
    double t2 = -h->rot.z.x * c1 * c23 - h->rot.z.y * s1 * c23 + h->rot.z.z * s23;
    if (fabs(t1) < SINGULAR && fabs(t2) < SINGULAR)
        flags |= ARM6_SINGULAR;
    else if (!is_zero_turn(q[3] * TO_RAD - atan2(t1, t2)))
        flags |= ARM6_WRIST_FLIP;
    return flags;
}

static int arm6_forward(const struct arm6 *g, const double *joint, EmcPose *world, KINEMATICS_INVERSE_FLAGS *iflags)
{
    PmHomogeneous h;
    PmRpy rpy;
    position_columns(g, joint, &h);
    *iflags = configuration(g, joint, &h) | (*iflags & ~15ul);
    h.tran.x += g->D6 * h.rot.z.x;
    h.tran.y += g->D6 * h.rot.z.y;
    h.tran.z += g->D6 * h.rot.z.z;
    pmMatRpyConvert(&h.rot, &rpy);
    world->tran = h.tran;
    world->a = nearest_turn(rpy.r * TO_DEG, world->a);
    world->b = rpy.p * TO_DEG;
    world->c = nearest_turn(rpy.y * TO_DEG, world->c);
    return 0;
}

/* Returns 0; -1 out of reach, joint unchanged. Joints are those nearest to the present ones (whole turns). */
static int arm6_inverse(const struct arm6 *g, const EmcPose *world, double *joint, KINEMATICS_INVERSE_FLAGS iflags,
                 KINEMATICS_FORWARD_FLAGS *fflags)
{
    PmRotationMatrix R;
    double th[6], s1, c1, s3, c3, s4, c4, s5, c5, s6, c6;
    rotation_abc(world->a, world->b, world->c, &R);
    double px = world->tran.x - g->D6 * R.z.x, py = world->tran.y - g->D6 * R.z.y;
    double pz = world->tran.z - g->D6 * R.z.z - g->D1;

    double sum = px * px + py * py - g->D * g->D;
    if (!(sum >= 0.0))
        return -1;
    th[0] = atan2(py, px) - atan2(g->D, iflags & ARM6_SHOULDER_RIGHT ? -sqrt(sum) : sqrt(sum));
    s1 = sin(th[0]);
    c1 = cos(th[0]);

    double k = elbow_k(g, px, py, pz, s1, c1), r2 = g->A3 * g->A3 + g->D4 * g->D4 - k * k;
    if (!(r2 >= 0.0))
        return -1;
    th[2] = atan2(g->A3, g->D4) - atan2(k, iflags & ARM6_ELBOW_DOWN ? -sqrt(r2) : sqrt(r2));
    s3 = sin(th[2]);
    c3 = cos(th[2]);

    double m = c1 * px + s1 * py - g->A1;
    double t1 = (-g->A3 - g->A2 * c3) * pz + m * (g->A2 * s3 - g->D4);
    double t2 = (g->A2 * s3 - g->D4) * pz + (g->A3 + g->A2 * c3) * m, t3 = pz * pz + m * m;
    if (!(t3 > 0.0))
        return -1; /* the wrist at the shoulder: any direction fits */
    double th23 = atan2(t1, t2), s23 = t1 / t3, c23 = t2 / t3;
    th[1] = th23 - th[2];

    t1 = -R.z.x * s1 + R.z.y * c1;
    t2 = -R.z.x * c1 * c23 - R.z.y * s1 * c23 + R.z.z * s23;
    if (fabs(t1) < SINGULAR && fabs(t2) < SINGULAR) {
        *fflags |= ARM6_REACH;
        th[3] = joint[3] * TO_RAD;
        if (iflags & ARM6_WRIST_FLIP)
            th[3] -= PM_PI;
    } else {
        *fflags &= ~(KINEMATICS_FORWARD_FLAGS)ARM6_REACH;
        th[3] = atan2(t1, t2);
    }
    s4 = sin(th[3]);
    c4 = cos(th[3]);

    s5 = R.z.z * s23 * c4 - R.z.x * (c1 * c23 * c4 + s1 * s4) - R.z.y * (s1 * c23 * c4 - c1 * s4);
    c5 = -R.z.x * c1 * s23 - R.z.y * s1 * s23 - R.z.z * c23;
    th[4] = atan2(s5, c5);
    s5 = sin(th[4]);
    c5 = cos(th[4]);

    s6 = R.x.z * s23 * s4 - R.x.x * (c1 * c23 * s4 - s1 * c4) - R.x.y * (s1 * c23 * s4 + c1 * c4);
    c6 = R.x.x * ((c1 * c23 * c4 + s1 * s4) * c5 - c1 * s23 * s5) +
         R.x.y * ((s1 * c23 * c4 - c1 * s4) * c5 - s1 * s23 * s5) - R.x.z * (s23 * c4 * c5 + c23 * s5);
    th[5] = atan2(s6, c6);

    if (iflags & ARM6_WRIST_FLIP) {
        th[3] += PM_PI;
        th[4] = -th[4];
        th[5] += PM_PI;
    }
    for (int i = 0; i < 6; i++)
        if (!isfinite(th[i]))
            return -1;
    for (int i = 0; i < 6; i++)
        joint[i] = nearest_turn(th[i] * TO_DEG, joint[i]);
    return 0;
}

/* ---- the module ---- */

static struct {
    hal_real_t length[ARM6_LENGTHS];
} *pins;

static int setup(const int comp_id, const char *coordinates, kparms *kp)
{
    int joint_of[EMCMOT_MAX_AXIS], r = 0;
    if (switchkins_joints_of_axes(coordinates, kp, joint_of) != 0)
        return -1;
    pins = hal_malloc(sizeof(*pins));
    for (int i = 0; pins && i < ARM6_LENGTHS && arm6_module.lengths[i].name; i++)
        r |= hal_pin_new_real(comp_id, HAL_IN, &pins->length[i], arm6_module.lengths[i].initial, "%s.%s", kp->halprefix,
                              arm6_module.lengths[i].name);
    return pins && r >= 0 ? 0 : -1;
}

static struct arm6 geometry(void)
{
    double v[ARM6_LENGTHS];
    for (int i = 0; i < ARM6_LENGTHS && arm6_module.lengths[i].name; i++)
        v[i] = hal_get_real(pins->length[i]);
    return arm6_module.geometry(v);
}

static int forward(const double *joint, EmcPose *world, const KINEMATICS_FORWARD_FLAGS *fflags,
                   KINEMATICS_INVERSE_FLAGS *iflags)
{
    struct arm6 g = geometry();
    (void)fflags;
    return arm6_forward(&g, joint, world, iflags);
}

static int inverse(const EmcPose *world, double *joint, const KINEMATICS_INVERSE_FLAGS *iflags,
                   KINEMATICS_FORWARD_FLAGS *fflags)
{
    struct arm6 g = geometry();
    return arm6_inverse(&g, world, joint, *iflags, fflags);
}

int switchkinsSetup(kparms *kp, KS *ks0, KS *ks1, KS *ks2, KF *kf0, KF *kf1, KF *kf2, KI *ki0, KI *ki1, KI *ki2)
{
    kp->sparm = NULL;
    kp->kinsname = kp->halprefix = arm6_module.name;
    kp->required_coordinates = "xyzabc";
    kp->max_joints = 6;
    kp->allow_duplicates = 0;
    switchkins_usual_types(kp, setup, forward, inverse, ks0, ks1, ks2, kf0, kf1, kf2, ki0, ki1, ki2);
    return 0;
}
