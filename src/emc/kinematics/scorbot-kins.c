/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * scorbot-kins.c - five-joint arm Scorbot ER III.
 *
 * In, out: kinematics.h
 * Thread:  servo
 * Method:  two links of 221 mm in a vertical plane turned by joint 0.
 */
#include "kins_main.h"

MODULE_AUTHOR("Kerf");
MODULE_DESCRIPTION("Kinematics of the Scorbot ER III");
MODULE_LICENSE("GPL");

#define BASE_OUT 16.0  /* shoulder axis, from the turning axis */
#define BASE_UP 140.0  /* shoulder axis, above the origin */
#define LINK 221.0     /* both links */

int kinematicsForward(const double *joint, EmcPose *world, const KINEMATICS_FORWARD_FLAGS *fflags,
                      KINEMATICS_INVERSE_FLAGS *iflags)
{
    double s0, c0, s1, c1, s2, c2, r;
    (void)fflags;
    (void)iflags;
    sincos_deg(joint[0], &s0, &c0);
    sincos_deg(joint[1], &s1, &c1);
    sincos_deg(joint[2], &s2, &c2);
    r = BASE_OUT + LINK * c1 + LINK * c2;
    world->tran.x = r * c0;
    world->tran.y = r * s0;
    world->tran.z = BASE_UP + LINK * s1 + LINK * s2;
    world->a = joint[3];
    world->b = joint[4];
    return 0;
}

int kinematicsInverse(const EmcPose *world, double *joint, const KINEMATICS_INVERSE_FLAGS *iflags,
                      KINEMATICS_FORWARD_FLAGS *fflags)
{
    double x = world->tran.x, y = world->tran.y, r = hypot(x, y), z = world->tran.z - BASE_UP;
    double turn = joint[0], reach, half, up;
    (void)iflags;
    (void)fflags;
    if (x != 0.0 || y != 0.0) { /* on the turning axis any direction fits: keep it */
        turn = nearest_turn(atan2(y, x) * TO_DEG, joint[0]);
        if (fabs(turn - joint[0]) > 90.0) { /* the arm reaches over its back */
            turn = nearest_turn(turn + 180.0, joint[0]);
            r = -r;
        }
    }
    r -= BASE_OUT;
    reach = hypot(r, z);
    half = reach / (2.0 * LINK);
    if (!(half <= 1.0) || half <= 0.0)
        return -1; /* farther than both links, or at the shoulder */
    up = atan2(z, r);
    joint[0] = turn;
    joint[1] = (up + acos(half)) * TO_DEG;
    joint[2] = (up - acos(half)) * TO_DEG;
    joint[3] = world->a;
    joint[4] = world->b;
    return 0;
}

KINS_NOT_SWITCHABLE

const char kins_name[] = "scorbot-kins";

int kins_setup(int comp_id)
{
    (void)comp_id;
    return 0;
}
