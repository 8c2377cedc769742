/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * three21kins.c - arm of the 3-2-1 kind, with offsets at base and shoulder; the kinematics are in arm6.c.
 *
 * In, out: kinematics.h; pins three21kins.A1 to .A3, .D1 to .D4, .D6   Thread: servo
 */
#include "arm6.h"
#include "kins_common.h"
#include "switchkins.h"
#include "trtfuncs.h"

static const struct {
    const char *name;
    double initial;
} lengths[] = {{"A1", 64.2}, {"A2", 305.0}, {"A3", 0.0}, {"D1", 169.77},
             {"D2", 0.0}, {"D3", -6.25}, {"D4", 223.63}, {"D6", 36.5}};
#define LENGTHS (sizeof(lengths) / sizeof(lengths[0]))

static struct {
    hal_real_t length[LENGTHS];
} *pins;

static int setup(const int comp_id, const char *coordinates, kparms *kp)
{
    int joint_of[EMCMOT_MAX_AXIS], r = 0;
    if (switchkins_joints_of_axes(coordinates, kp, joint_of) != 0)
        return -1;
    pins = hal_malloc(sizeof(*pins));
    for (size_t i = 0; pins && i < LENGTHS; i++)
        r |= hal_pin_new_real(comp_id, HAL_IN, &pins->length[i], lengths[i].initial, "%s.%s", kp->halprefix,
                              lengths[i].name);
    return pins && r >= 0 ? 0 : -1;
}

static struct arm6 geometry(void)
{
    double v[LENGTHS];
    for (size_t i = 0; i < LENGTHS; i++)
        v[i] = hal_get_real(pins->length[i]);
    struct arm6 g = {v[0], v[1], v[2], v[3], v[4] + v[5], v[6], v[7]};
    return g;
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
    kp->kinsname = kp->halprefix = "three21kins";
    kp->required_coordinates = "xyzabc";
    kp->max_joints = 6;
    kp->allow_duplicates = 0;
    switchkins_usual_types(kp, setup, forward, inverse, ks0, ks1, ks2, kf0, kf1, kf2, ki0, ki1, ki2);
    return 0;
}
