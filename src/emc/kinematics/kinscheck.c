/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * kinscheck.c - checks that forward and inverse of the loaded kinematics agree.
 *
 * In:     loadrt kinscheck ranges=LO:HI,LO:HI,... after a kinematics module
 *           by=joints|pose   what the ranges are of and what is drawn (default joints)
 *           points=N seed=N  random points (default 10000, 1)
 *           type=N           of switchable kinematics (default 0)
 *           perturb=P        seeds differ from the point by up to P parts of the range, in 1e-6 (default 1000)
 *           tolerance=P      allowed difference in 1e-9 units (default 1000)
 *           joint_tolerance=P  the same for joints, default: tolerance (close to singular
 *                            points two solutions may lie closer than the seed)
 *           show=N           also print the first N points: joints and the pose that forward gives,
 *                            or pose and the joints that inverse gives (default 0)
 * Out:    one line of text: points, refused points, worst differences, first bad point;
 *         the load fails when there is a bad one
 * Thread: init
 * Method: joints: q, pose = forward(q), q' = inverse(pose) from a seed near q, forward(q') = pose.
 *         pose: q = inverse(p), forward(q) from a seed near p = p. Of pose axes, only
 *         those that forward sets are compared. A refusal of the second direction is bad.
 */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include "emcmotcfg.h"
#include "emcpose.h"
#include "hal.h"
#include "kinematics.h"
#include "rtapi.h"
#include "rtapi_app.h"

MODULE_AUTHOR("Kerf");
MODULE_DESCRIPTION("Checks that forward and inverse kinematics agree over random points");
MODULE_LICENSE("GPL");

static char *ranges = "";
RTAPI_MP_STRING(ranges, "LO:HI of each joint or axis, separated by commas or blanks");
static char *by = "joints";
RTAPI_MP_STRING(by, "joints or pose");
static int points = 10000;
RTAPI_MP_INT(points, "number of random points");
static int seed = 1;
RTAPI_MP_INT(seed, "of the random numbers");
static int type = 0;
RTAPI_MP_INT(type, "type of switchable kinematics");
static int perturb = 1000;
RTAPI_MP_INT(perturb, "difference of seeds, millionths of a range");
static int tolerance = 1000;
RTAPI_MP_INT(tolerance, "allowed difference, 1e-9 units");
static int joint_tolerance = 0;
RTAPI_MP_INT(joint_tolerance, "allowed difference of joints, 1e-9 units");
static int show = 0;
RTAPI_MP_INT(show, "points to print");

#define MAX_VALUES EMCMOT_MAX_JOINTS

struct range {
    double lo, hi;
};

static int comp_id;
static uint64_t random_state;
static KINEMATICS_FORWARD_FLAGS fflags;
static KINEMATICS_INVERSE_FLAGS iflags;

static struct {
    int count;
    struct range r[MAX_VALUES];
    int done, refused, bad;
    double worst_pose, worst_joint;
    double first_bad[MAX_VALUES];
} check;

static double uniform(double lo, double hi)
{
    random_state ^= random_state << 13;
    random_state ^= random_state >> 7;
    random_state ^= random_state << 17;
    return lo + (hi - lo) * ((double)(random_state >> 11) / 9007199254740992.0);
}

static int read_ranges(void)
{
    const char *p = ranges;
    while (*p && check.count < MAX_VALUES) {
        char *end;
        struct range *r = &check.r[check.count];
        r->lo = strtod(p, &end);
        if (end == p || *end != ':')
            return -1;
        p = end + 1;
        r->hi = strtod(p, &end);
        if (end == p)
            return -1;
        check.count++;
        p = end + strspn(end, ", ");
    }
    return check.count ? 0 : -1;
}

static double near_value(int i, double v)
{
    double d = (check.r[i].hi - check.r[i].lo) * perturb * 1e-6;
    return uniform(v - d, v + d);
}

static double pose_difference(const EmcPose *a, const EmcPose *b)
{
    double worst = 0.0;
    for (int i = 0; i < EMCMOT_MAX_AXIS; i++) {
        double d = emcPoseGetAxis(a, i) - emcPoseGetAxis(b, i);
        if (i >= 3 && i <= 5)
            d = remainder(d, 360.0);
        worst = fmax(worst, isnan(d) ? INFINITY : fabs(d));
    }
    return worst;
}

static void note(const double *v, double pose, double joint, int refused)
{
    double bound = tolerance * 1e-9, joint_bound = joint_tolerance ? joint_tolerance * 1e-9 : bound;
    check.done++;
    check.worst_pose = fmax(check.worst_pose, pose);
    check.worst_joint = fmax(check.worst_joint, joint);
    if (!refused && pose <= bound && joint <= joint_bound)
        return;
    if (check.bad++ == 0)
        for (int i = 0; i < check.count; i++)
            check.first_bad[i] = v[i];
}

static void print_values(const char *what, const double *v, int n)
{
    rtapi_print("%s", what);
    for (int i = 0; i < n; i++)
        rtapi_print(" %.15g", v[i]);
}

static void show_point(const double *joint, const EmcPose *pose)
{
    double p[EMCMOT_MAX_AXIS];
    if (check.done >= show)
        return;
    for (int i = 0; i < EMCMOT_MAX_AXIS; i++)
        p[i] = emcPoseGetAxis(pose, i);
    print_values("joints", joint, EMCMOT_MAX_AXIS);
    print_values(" pose", p, EMCMOT_MAX_AXIS);
    rtapi_print("\n");
}

static void check_joints(void)
{
    double q[EMCMOT_MAX_JOINTS] = {0}, back[EMCMOT_MAX_JOINTS] = {0}, joint = 0.0;
    EmcPose pose, again;
    for (int i = 0; i < check.count; i++)
        q[i] = uniform(check.r[i].lo, check.r[i].hi);
    emcPoseZero(&pose);
    if (kinematicsForward(q, &pose, &fflags, &iflags) < 0) {
        check.refused++;
        return;
    }
    show_point(q, &pose);
    for (int i = 0; i < check.count; i++)
        back[i] = near_value(i, q[i]);
    int r = kinematicsInverse(&pose, back, &iflags, &fflags);
    for (int i = 0; i < check.count; i++)
        joint = fmax(joint, isnan(back[i]) ? INFINITY : fabs(back[i] - q[i]));
    again = pose;
    r |= kinematicsForward(back, &again, &fflags, &iflags) < 0;
    note(q, pose_difference(&pose, &again), joint, r != 0);
}

static void check_pose(void)
{
    double q[EMCMOT_MAX_JOINTS] = {0}, v[MAX_VALUES];
    EmcPose pose, back;
    emcPoseZero(&pose);
    for (int i = 0; i < check.count && i < EMCMOT_MAX_AXIS; i++)
        *emcPoseAxis(&pose, i) = v[i] = uniform(check.r[i].lo, check.r[i].hi);
    if (kinematicsInverse(&pose, q, &iflags, &fflags) != 0) {
        check.refused++;
        return;
    }
    show_point(q, &pose);
    back = pose;
    for (int i = 0; i < check.count && i < EMCMOT_MAX_AXIS; i++)
        *emcPoseAxis(&back, i) = near_value(i, v[i]);
    int r = kinematicsForward(q, &back, &fflags, &iflags) < 0;
    note(v, pose_difference(&pose, &back), 0.0, r);
}

int rtapi_app_main(void)
{
    if (read_ranges() != 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "kinscheck: ranges=%s is not LO:HI,LO:HI,...\n", ranges);
        return -EINVAL;
    }
    random_state = 0x9e3779b97f4a7c15u ^ ((uint64_t)seed * 0xbf58476d1ce4e5b9u);
    for (int i = 0; i < 8; i++)
        uniform(0, 1);
    if (kinematicsSwitchable() && kinematicsSwitch(type) != 0)
        return -EINVAL;
    for (int n = 0; n < points; n++) {
        if (by[0] == 'p')
            check_pose();
        else
            check_joints();
    }
    rtapi_print("kinscheck: %d points agree, %d refused, %d bad; worst pose %.3g, joint %.3g\n",
                check.done - check.bad, check.refused, check.bad, check.worst_pose, check.worst_joint);
    if (check.bad) {
        rtapi_print("kinscheck: first bad point");
        for (int i = 0; i < check.count; i++)
            rtapi_print(" %.9g", check.first_bad[i]);
        rtapi_print("\n");
        return -EDOM;
    }
    comp_id = hal_init("kinscheck");
    return comp_id < 0 ? comp_id : hal_ready(comp_id);
}

void rtapi_app_exit(void) { hal_exit(comp_id); }
