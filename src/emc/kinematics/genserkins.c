/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * genserkins.c - serial arm of six revolute joints given by Denavit-Hartenberg parameters.
 *
 * In, out: kinematics.h; pins genserkins.A-n, .ALPHA-n, .D-n, .unrotate-n,
 *          .max-iterations, .last-iterations
 * Thread:  servo; at most max-iterations steps, never more than MAX_ITERATIONS
 * Method:  modified parameters (Craig 1986); inverse by Newton's method from the
 *          present joints with the geometric Jacobian. A step that would turn a
 *          joint too far, and a singular Jacobian, fail: no jump.
 */
#include "kins_common.h"
#include "switchkins.h"
#include "switchkins_util.h"

#define LINKS 6
#define MAX_ITERATIONS 1000
#define CONVERGED 1e-7        /* rad: last correction, quadratic convergence leaves less */
#define MAX_STEP 0.5          /* rad in one iteration */
#define UNMOVED 1e-11         /* rad: below any encoder; joints at rest stay exactly where they are */

static struct {
    hal_real_t A[LINKS], ALPHA[LINKS], D[LINKS];
    hal_sint_t unrotate[LINKS];
    hal_uint_t max_iterations, last_iterations;
} *pins;

static int setup(const int comp_id, const char *coordinates, kparms *kp)
{
    static const double a[] = {0, 0, 300, 50, 0, 0};
    static const double alpha[] = {0, -PM_PI_2, 0, -PM_PI_2, PM_PI_2, -PM_PI_2};
    static const double d[] = {0, 0, 70, 400, 0, 0};
    int joint_of[EMCMOT_MAX_AXIS], r = 0;
    if (switchkins_joints_of_axes(coordinates, kp, joint_of) != 0)
        return -1;
    pins = hal_malloc(sizeof(*pins));
    if (!pins)
        return -1;
    for (int i = 0; i < LINKS; i++) {
        r |= hal_pin_new_real(comp_id, HAL_IN, &pins->A[i], a[i], "%s.A-%d", kp->halprefix, i);
        r |= hal_pin_new_real(comp_id, HAL_IN, &pins->ALPHA[i], alpha[i], "%s.ALPHA-%d", kp->halprefix, i);
        r |= hal_pin_new_real(comp_id, HAL_IN, &pins->D[i], d[i], "%s.D-%d", kp->halprefix, i);
        r |= hal_pin_new_si32(comp_id, HAL_IN, &pins->unrotate[i], 0, "%s.unrotate-%d", kp->halprefix, i);
    }
    r |= hal_pin_new_ui32(comp_id, HAL_IN, &pins->max_iterations, 100, "%s.max-iterations", kp->halprefix);
    r |= hal_pin_new_ui32(comp_id, HAL_OUT, &pins->last_iterations, 0, "%s.last-iterations", kp->halprefix);
    return r < 0 ? -1 : 0;
}

/* Frame of the tool and, where wanted, axis and origin of each joint, all in the base frame. */
static void chain(const double *theta, PmHomogeneous *tool, PmCartesian *axis, PmCartesian *origin)
{
    PmHomogeneous pose = {{0, 0, 0}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (int i = 0; i < LINKS; i++) {
        double st = sin(theta[i]), ct = cos(theta[i]);
        double alpha = hal_get_real(pins->ALPHA[i]), d = hal_get_real(pins->D[i]);
        double sa = sin(alpha), ca = cos(alpha);
        PmHomogeneous link = {{hal_get_real(pins->A[i]), -sa * d, ca * d},
                              {{ct, st * ca, st * sa}, {-st, ct * ca, ct * sa}, {0, -sa, ca}}};
        pmHomHomMult(&pose, &link, &pose);
        if (axis)
            axis[i] = pose.rot.z;
        if (origin)
            origin[i] = pose.tran;
    }
    *tool = pose;
}

static int forward(const double *joint, EmcPose *world, const KINEMATICS_FORWARD_FLAGS *fflags,
                   KINEMATICS_INVERSE_FLAGS *iflags)
{
    double q[LINKS], theta[LINKS];
    PmHomogeneous tool;
    PmRpy rpy;
    (void)fflags;
    (void)iflags;
    for (int i = 0; i < LINKS; i++) {
        q[i] = joint[i];
        if (i > 0)
            q[i] -= hal_get_si32(pins->unrotate[i]) * q[i - 1];
        theta[i] = q[i] * TO_RAD;
    }
    chain(theta, &tool, NULL, NULL);
    pmMatRpyConvert(&tool.rot, &rpy);
    world->tran = tool.tran;
    world->a = nearest_turn(rpy.r * TO_DEG, world->a);
    world->b = rpy.p * TO_DEG;
    world->c = nearest_turn(rpy.y * TO_DEG, world->c);
    world->u = joint[6];
    world->v = joint[7];
    world->w = joint[8];
    return 0;
}

/* Velocity twist (base frame) that would carry the estimated frame to the wanted one. */
static void twist_to(const PmHomogeneous *estimate, const PmHomogeneous *wanted, double *d)
{
    PmRotationMatrix back, delta;
    PmRotationVector turn;
    PmCartesian w;
    pmMatInv(&estimate->rot, &back);
    pmMatMatMult(&wanted->rot, &back, &delta); /* in the base frame */
    pmMatRotConvert(&delta, &turn);
    w.x = turn.s * turn.x;
    w.y = turn.s * turn.y;
    w.z = turn.s * turn.z;
    d[0] = wanted->tran.x - estimate->tran.x;
    d[1] = wanted->tran.y - estimate->tran.y;
    d[2] = wanted->tran.z - estimate->tran.z;
    d[3] = w.x;
    d[4] = w.y;
    d[5] = w.z;
}

static int solve_step(const double *theta, const PmHomogeneous *wanted, double *dj)
{
    PmHomogeneous tool;
    PmCartesian axis[LINKS], origin[LINKS], arm, lin;
    double J[6 * LINKS], d[6];
    chain(theta, &tool, axis, origin);
    twist_to(&tool, wanted, d);
    for (int i = 0; i < LINKS; i++) {
        pmCartCartSub(&tool.tran, &origin[i], &arm);
        pmCartCartCross(&axis[i], &arm, &lin);
        J[0 * LINKS + i] = lin.x;
        J[1 * LINKS + i] = lin.y;
        J[2 * LINKS + i] = lin.z;
        J[3 * LINKS + i] = axis[i].x;
        J[4 * LINKS + i] = axis[i].y;
        J[5 * LINKS + i] = axis[i].z;
    }
    return kins_solve(LINKS, J, d, dj);
}

static int inverse(const EmcPose *world, double *joint, const KINEMATICS_INVERSE_FLAGS *iflags,
                   KINEMATICS_FORWARD_FLAGS *fflags)
{
    double theta[LINKS], dj[LINKS];
    PmHomogeneous wanted;
    unsigned limit = hal_get_ui32(pins->max_iterations);
    (void)iflags;
    (void)fflags;
    if (limit > MAX_ITERATIONS)
        limit = MAX_ITERATIONS;
    wanted.tran = world->tran;
    rotation_abc(world->a, world->b, world->c, &wanted.rot);
    for (int i = 0; i < LINKS; i++) {
        theta[i] = joint[i];
        if (i > 0) /* the seed without what unrotate adds */
            theta[i] -= hal_get_si32(pins->unrotate[i]) * theta[i - 1];
    }
    for (int i = 0; i < LINKS; i++)
        theta[i] *= TO_RAD;
    for (unsigned n = 1; n <= limit; n++) {
        double largest = 0.0;
        hal_set_ui32(pins->last_iterations, n);
        if (solve_step(theta, &wanted, dj) != 0) {
            rtapi_print_msg(RTAPI_MSG_INFO, "ERR kI - compute_jinv (joints: %f %f %f %f %f %f), (iterations=%u)\n",
                            joint[0], joint[1], joint[2], joint[3], joint[4], joint[5], n);
            return -1;
        }
        for (int i = 0; i < LINKS; i++)
            largest = fmax(largest, fabs(dj[i]));
        if (!isfinite(largest))
            return -1;
        if (n == 1 && largest < UNMOVED) {
            joint[6] = world->u;
            joint[7] = world->v;
            joint[8] = world->w;
            return 0;
        }
        double part = largest > MAX_STEP ? MAX_STEP / largest : 1.0;
        for (int i = 0; i < LINKS; i++)
            theta[i] += part * dj[i];
        if (largest >= CONVERGED)
            continue;
        for (int i = 0; i < LINKS; i++) {
            joint[i] = theta[i] * TO_DEG;
            if (i > 0) /* the turn of the link before, not its motor's: what forward takes away */
                joint[i] += hal_get_si32(pins->unrotate[i]) * theta[i - 1] * TO_DEG;
        }
        joint[6] = world->u;
        joint[7] = world->v;
        joint[8] = world->w;
        return 0;
    }
    rtapi_print_msg(RTAPI_MSG_INFO, "ERRkineInverse(joints: %f %f %f %f %f %f), (iterations=%u)\n", joint[0], joint[1],
                    joint[2], joint[3], joint[4], joint[5], limit);
    return -1;
}

int switchkinsSetup(kparms *kp, KS *ks0, KS *ks1, KS *ks2, KF *kf0, KF *kf1, KF *kf2, KI *ki0, KI *ki1, KI *ki2)
{
    kp->sparm = NULL;
    kp->kinsname = kp->halprefix = "genserkins";
    kp->required_coordinates = "xyzabcuvw";
    kp->max_joints = 9;
    kp->allow_duplicates = 0;
    switchkins_usual_types(kp, setup, forward, inverse, ks0, ks1, ks2, kf0, kf1, kf2, ki0, ki1, ki2);
    return 0;
}
