/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * pentakins.c - pentapod: five struts to rings on the effector, X Y Z A B.
 *
 * In, out: kinematics.h; parameters pentakins.base.n.x, .effector.n.r ...; pins
 * Thread:  servo; forward makes at most limit-iterations steps, never more than MAX_ITERATIONS
 * Method:  inverse: distance of a base point to a ring about the effector's axis;
 *          forward: Newton's method with a Jacobian of central differences.
 */
#include "kins_main.h"

MODULE_AUTHOR("Kerf");
MODULE_DESCRIPTION("Kinematics of a pentapod");
MODULE_LICENSE("GPL");

#define STRUTS 5
#define STEP 1e-4            /* units, rad: of the difference quotients */
#define MAX_ITERATIONS 1000

static struct {
    hal_real_t base[STRUTS][3], effector_r[STRUTS], effector_z[STRUTS];
    hal_uint_t last_iterations, max_iterations, limit_iterations;
    hal_real_t max_error, convergence, tool_offset;
} *pins;

/* x y z a b (units, rad) to strut lengths. */
static void lengths(const double *pose, double *q)
{
    double sa = sin(pose[3]), ca = cos(pose[3]), sb = sin(pose[4]), cb = cos(pose[4]);
    double lift = hal_get_real(pins->tool_offset);
    for (int i = 0; i < STRUTS; i++) {
        double x = hal_get_real(pins->base[i][0]) - pose[0], y = hal_get_real(pins->base[i][1]) - pose[1];
        double z = hal_get_real(pins->base[i][2]) + lift - pose[2];
        /* (Ry(b) Rx(a))^-1 */
        double x1 = cb * x - sb * z, z1 = sb * x + cb * z;
        double y2 = ca * y + sa * z1, z2 = -sa * y + ca * z1;
        double dz = z2 - (hal_get_real(pins->effector_z[i]) + lift);
        double dr = hypot(x1, y2) - hal_get_real(pins->effector_r[i]);
        q[i] = hypot(dz, dr);
    }
}

int kinematicsInverse(const EmcPose *world, double *joint, const KINEMATICS_INVERSE_FLAGS *iflags,
                      KINEMATICS_FORWARD_FLAGS *fflags)
{
    double pose[5] = {world->tran.x, world->tran.y, world->tran.z, world->a * TO_RAD, world->b * TO_RAD};
    (void)iflags;
    (void)fflags;
    lengths(pose, joint);
    return 0;
}

static void jacobian(const double *pose, double *J)
{
    double p[5], plus[STRUTS], minus[STRUTS];
    for (int k = 0; k < 5; k++)
        p[k] = pose[k];
    for (int k = 0; k < 5; k++) {
        p[k] = pose[k] + STEP;
        lengths(p, plus);
        p[k] = pose[k] - STEP;
        lengths(p, minus);
        p[k] = pose[k];
        for (int i = 0; i < STRUTS; i++)
            J[5 * i + k] = (plus[i] - minus[i]) / (2.0 * STEP);
    }
}

int kinematicsForward(const double *joint, EmcPose *world, const KINEMATICS_FORWARD_FLAGS *fflags,
                      KINEMATICS_INVERSE_FLAGS *iflags)
{
    double pose[5] = {world->tran.x, world->tran.y, world->tran.z, world->a * TO_RAD, world->b * TO_RAD};
    double q[STRUTS], diff[STRUTS], delta[5], J[STRUTS * 5];
    unsigned limit = hal_get_ui32(pins->limit_iterations);
    (void)fflags;
    (void)iflags;
    if (limit > MAX_ITERATIONS)
        limit = MAX_ITERATIONS;
    for (int i = 0; i < STRUTS; i++)
        if (!(joint[i] > 0.0))
            return -1;
    for (unsigned n = 0;; n++) {
        double error = 0.0, worst = 0.0;
        lengths(pose, q);
        for (int i = 0; i < STRUTS; i++) {
            diff[i] = q[i] - joint[i];
            error += fabs(diff[i]);
            worst = fmax(worst, fabs(diff[i]));
        }
        if (!isfinite(error) || error > hal_get_real(pins->max_error))
            return -2;
        if (worst <= hal_get_real(pins->convergence)) {
            hal_set_ui32(pins->last_iterations, n);
            if (n > hal_get_ui32(pins->max_iterations))
                hal_set_ui32(pins->max_iterations, n);
            break;
        }
        if (n >= limit)
            return -5;
        jacobian(pose, J);
        if (kins_solve(STRUTS, J, diff, delta) != 0)
            return -1;
        for (int k = 0; k < 5; k++)
            pose[k] -= delta[k];
    }
    world->tran.x = pose[0];
    world->tran.y = pose[1];
    world->tran.z = pose[2];
    world->a = pose[3] * TO_DEG;
    world->b = pose[4] * TO_DEG;
    return 0;
}

KINS_NOT_SWITCHABLE

const char kins_name[] = "pentakins";

int kins_setup(int comp_id)
{
    static const double x[] = {-418.03, 417.96, -418.03, 417.96, -0.06};
    static const double y[] = {324.56, 324.56, -325.44, -325.44, -492.96};
    static const double z[] = {-185.5, -159.5, -67.5, -41.5, -14.0};
    int r = 0, id = comp_id;
    pins = hal_malloc(sizeof(*pins));
    if (!pins)
        return -1;
    for (int i = 0; i < STRUTS; i++) {
        r |= hal_param_new_real(id, HAL_RW, &pins->base[i][0], x[i], "pentakins.base.%d.x", i);
        r |= hal_param_new_real(id, HAL_RW, &pins->base[i][1], y[i], "pentakins.base.%d.y", i);
        r |= hal_param_new_real(id, HAL_RW, &pins->base[i][2], 895.56, "pentakins.base.%d.z", i);
        r |= hal_param_new_real(id, HAL_RW, &pins->effector_r[i], 80.32, "pentakins.effector.%d.r", i);
        r |= hal_param_new_real(id, HAL_RW, &pins->effector_z[i], z[i], "pentakins.effector.%d.z", i);
    }
    r |= hal_pin_new_ui32(id, HAL_OUT, &pins->last_iterations, 0, "pentakins.last-iterations");
    r |= hal_pin_new_ui32(id, HAL_OUT, &pins->max_iterations, 0, "pentakins.max-iterations");
    r |= hal_pin_new_real(id, HAL_IO, &pins->max_error, 100.0, "pentakins.max-error");
    r |= hal_pin_new_real(id, HAL_IO, &pins->convergence, 1e-9, "pentakins.convergence-criterion");
    r |= hal_pin_new_ui32(id, HAL_IO, &pins->limit_iterations, 120, "pentakins.limit-iterations");
    r |= hal_pin_new_real(id, HAL_IN, &pins->tool_offset, 0, "pentakins.tool-offset");
    return r < 0 ? -1 : 0;
}
