/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * genhexkins.c - hexapod: six struts between base and platform.
 *
 * In, out: kinematics.h; pins genhexkins.base.n.x ... (see make_pins)
 * Thread:  servo; forward makes at most limit-iterations steps, never more than MAX_ITERATIONS
 * Method:  inverse: strut lengths; forward: Newton's method from the pose before.
 *          With screw-lead, the turn of the strut's joints lengthens the screw.
 */
#include "kins_common.h"
#include "switchkins.h"
#include "switchkins_util.h"

#define STRUTS 6
#define MAX_ITERATIONS 1000

static struct {
    hal_real_t base[STRUTS][3], platform[STRUTS][3], base_n[STRUTS][3], platform_n[STRUTS][3];
    hal_real_t correction[STRUTS];
    hal_real_t convergence, max_error, tool_offset, spindle_offset, screw_lead;
    hal_uint_t limit_iterations, last_iterations, max_iterations;
    hal_bool_t fail;
    hal_real_t pose[6];
} *pins;

static const double base_initial[STRUTS][3] = {{-22.95, 13.25, 0}, {22.95, 13.25, 0}, {22.95, 13.25, 0},
                                               {0, -26.5, 0},      {0, -26.5, 0},     {-22.95, 13.25, 0}};
static const double platform_initial[STRUTS][3] = {{-1, 11.5, 0},        {1, 11.5, 0},
                                                   {10.459, -4.884, 0},  {9.459, -6.616, 0},
                                                   {-9.459, -6.616, 0},  {-10.459, -4.884, 0}};
static const double base_n_initial[STRUTS][3] = {{0.707107, 0, 0.707107},  {0, -0.707107, 0.707107},
                                                 {-0.707107, 0, 0.707107}, {-0.707107, 0, 0.707107},
                                                 {0, 0.707107, 0.707107},  {0.707107, 0, 0.707107}};
static const double platform_n_initial[STRUTS][3] = {{-1, 0, 0},           {0.866025, 0.5, 0},
                                                     {0.866025, 0.5, 0},   {0.866025, -0.5, 0},
                                                     {0.866025, -0.5, 0},  {-1, 0, 0}};

static int make_pins(int id, const char *prefix)
{
    static const char xyz[] = "xyz", abc[] = "xyzabc";
    int r = 0;
    for (int i = 0; i < STRUTS; i++)
        for (int k = 0; k < 3; k++) {
            r |= hal_pin_new_real(id, HAL_IN, &pins->base[i][k], base_initial[i][k],
                                  "%s.base.%d.%c", prefix, i, xyz[k]);
            r |= hal_pin_new_real(id, HAL_IN, &pins->platform[i][k], platform_initial[i][k], "%s.platform.%d.%c",
                                  prefix, i, xyz[k]);
            r |= hal_pin_new_real(id, HAL_IN, &pins->base_n[i][k], base_n_initial[i][k], "%s.base-n.%d.%c", prefix, i,
                                  xyz[k]);
            r |= hal_pin_new_real(id, HAL_IN, &pins->platform_n[i][k], platform_n_initial[i][k], "%s.platform-n.%d.%c",
                                  prefix, i, xyz[k]);
        }
    for (int i = 0; i < STRUTS; i++)
        r |= hal_pin_new_real(id, HAL_OUT, &pins->correction[i], 0, "%s.correction.%d", prefix, i);
    r |= hal_pin_new_ui32(id, HAL_OUT, &pins->last_iterations, 0, "%s.last-iterations", prefix);
    r |= hal_pin_new_ui32(id, HAL_OUT, &pins->max_iterations, 0, "%s.max-iterations", prefix);
    r |= hal_pin_new_real(id, HAL_IN, &pins->max_error, 500.0, "%s.max-error", prefix);
    r |= hal_pin_new_real(id, HAL_IN, &pins->convergence, 1e-9, "%s.convergence-criterion", prefix);
    r |= hal_pin_new_ui32(id, HAL_IN, &pins->limit_iterations, 120, "%s.limit-iterations", prefix);
    r |= hal_pin_new_real(id, HAL_IN, &pins->tool_offset, 0, "%s.tool-offset", prefix);
    r |= hal_pin_new_real(id, HAL_IN, &pins->spindle_offset, 0, "%s.spindle-offset", prefix);
    r |= hal_pin_new_real(id, HAL_IN, &pins->screw_lead, 0, "%s.screw-lead", prefix);
    r |= hal_pin_new_bool(id, HAL_OUT, &pins->fail, 0, "%s.fwd-kins-fail", prefix);
    for (int i = 0; i < 6; i++)
        r |= hal_pin_new_real(id, HAL_IN, &pins->pose[i], 0, "%s.%c", prefix, abc[i]);
    return r < 0 ? -1 : 0;
}

static int setup(const int comp_id, const char *coordinates, kparms *kp)
{
    int joint_of[EMCMOT_MAX_AXIS];
    if (switchkins_joints_of_axes(coordinates, kp, joint_of) != 0)
        return -1;
    pins = hal_malloc(sizeof(*pins));
    return pins ? make_pins(comp_id, kp->halprefix) : -1;
}

static PmCartesian vector_of(const hal_real_t *v, double lift)
{
    PmCartesian c = {hal_get_real(v[0]), hal_get_real(v[1]), hal_get_real(v[2]) + lift};
    return c;
}

struct strut {
    PmCartesian arm;  /* platform point, turned, from the platform's centre */
    PmCartesian unit; /* from base point to platform point */
    double length;    /* screw correction included */
};

/* Strut i at a pose; 0, or -1 when it has no length. */
static int strut_at(int i, const PmCartesian *tran, const PmRotationMatrix *R, struct strut *s, double *correction)
{
    double lift = hal_get_real(pins->spindle_offset) + hal_get_real(pins->tool_offset);
    double lead = hal_get_real(pins->screw_lead);
    PmCartesian b = vector_of(pins->base[i], lift), a = vector_of(pins->platform[i], lift), v;
    pmMatCartMult(R, &a, &s->arm);
    pmCartCartAdd(tran, &s->arm, &v);
    pmCartSubEq(&v, &b);
    pmCartMag(&v, &s->length);
    if (pmCartUnit(&v, &s->unit) != PM_OK)
        return -1;
    *correction = 0.0;
    if (lead != 0.0) {
        PmCartesian nb = vector_of(pins->base_n[i], 0.0), na = vector_of(pins->platform_n[i], 0.0), nb3, na2, t;
        pmCartCartCross(&nb, &s->unit, &t);
        pmCartCartCross(&s->unit, &t, &nb3);
        pmMatCartMult(R, &na, &t);
        pmCartCartCross(&t, &s->unit, &na2);
        if (pmCartUnitEq(&nb3) == PM_OK && pmCartUnitEq(&na2) == PM_OK) {
            double cosine;
            pmCartCartDot(&nb3, &na2, &cosine);
            *correction = lead * asin(fmax(-1.0, fmin(1.0, cosine))) / PM_2_PI;
        }
        s->length += *correction;
    }
    return 0;
}

static int inverse(const EmcPose *world, double *joint, const KINEMATICS_INVERSE_FLAGS *iflags,
                   KINEMATICS_FORWARD_FLAGS *fflags)
{
    PmRotationMatrix R;
    struct strut s;
    double q[STRUTS], correction;
    (void)iflags;
    (void)fflags;
    rotation_abc(world->a, world->b, world->c, &R);
    for (int i = 0; i < STRUTS; i++) {
        if (strut_at(i, &world->tran, &R, &s, &correction) != 0)
            return -1;
        q[i] = s.length;
        hal_set_real(pins->correction[i], correction);
    }
    for (int i = 0; i < STRUTS; i++)
        joint[i] = q[i];
    return 0;
}

static int fail(int code)
{
    hal_set_bool(pins->fail, 1);
    return code;
}

/* Jacobian of the roll, pitch, yaw rates to the angular velocity: w = E (r', p', y'). */
static void rate_axes(const PmRpy *rpy, PmCartesian e[3])
{
    double sp = sin(rpy->p), cp = cos(rpy->p), sy = sin(rpy->y), cy = cos(rpy->y);
    PmCartesian roll = {cy * cp, sy * cp, -sp}, pitch = {-sy, cy, 0}, yaw = {0, 0, 1};
    e[0] = roll;
    e[1] = pitch;
    e[2] = yaw;
}

static int forward(const double *joint, EmcPose *world, const KINEMATICS_FORWARD_FLAGS *fflags,
                   KINEMATICS_INVERSE_FLAGS *iflags)
{
    PmCartesian tran = world->tran, e[3], moment;
    PmRpy rpy = {world->a * TO_RAD, world->b * TO_RAD, world->c * TO_RAD};
    PmRotationMatrix R;
    struct strut s;
    double J[STRUTS * 6], diff[STRUTS], delta[6], correction, criterion = hal_get_real(pins->convergence);
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
        pmRpyMatConvert(&rpy, &R);
        rate_axes(&rpy, e);
        for (int i = 0; i < STRUTS; i++) {
            if (strut_at(i, &tran, &R, &s, &correction) != 0)
                return fail(-1);
            diff[i] = s.length - joint[i];
            error += fabs(diff[i]);
            worst = fmax(worst, fabs(diff[i]));
            pmCartCartCross(&s.arm, &s.unit, &moment);
            J[6 * i + 0] = s.unit.x;
            J[6 * i + 1] = s.unit.y;
            J[6 * i + 2] = s.unit.z;
            for (int k = 0; k < 3; k++)
                pmCartCartDot(&moment, &e[k], &J[6 * i + 3 + k]);
        }
        if (!isfinite(error) || error > hal_get_real(pins->max_error))
            return fail(-2);
        if (worst <= criterion) {
            hal_set_ui32(pins->last_iterations, n);
            if (n > hal_get_ui32(pins->max_iterations))
                hal_set_ui32(pins->max_iterations, n);
            break;
        }
        if (n >= limit)
            return fail(-5);
        if (kins_solve(6, J, diff, delta) != 0)
            return fail(-1);
        tran.x -= delta[0];
        tran.y -= delta[1];
        tran.z -= delta[2];
        rpy.r -= delta[3];
        rpy.p -= delta[4];
        rpy.y -= delta[5];
    }
    hal_set_bool(pins->fail, 0);
    world->tran = tran;
    world->a = rpy.r * TO_DEG;
    world->b = rpy.p * TO_DEG;
    world->c = rpy.y * TO_DEG;
    for (int i = 0; i < 6; i++)
        hal_set_real(pins->pose[i], emcPoseGetAxis(world, i));
    return 0;
}

int switchkinsSetup(kparms *kp, KS *ks0, KS *ks1, KS *ks2, KF *kf0, KF *kf1, KF *kf2, KI *ki0, KI *ki1, KI *ki2)
{
    kp->sparm = NULL;
    kp->kinsname = kp->halprefix = "genhexkins";
    kp->required_coordinates = "xyzabc";
    kp->max_joints = 6;
    kp->allow_duplicates = 0;
    kp->fwd_iterates_mask = 1;
    kp->gui_kinstype = 0;
    switchkins_usual_types(kp, setup, forward, inverse, ks0, ks1, ks2, kf0, kf1, kf2, ki0, ki1, ki2);
    return 0;
}
