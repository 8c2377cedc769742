/* SPDX-License-Identifier: GPL-2.0-or-later
 * A switchable module of a user's own: the identity twice, then type 2 of another file. */
#include "rtapi.h"
#include "switchkins.h"

int switchkinsSetup(kparms *kp, KS *ks0, KS *ks1, KS *ks2, KF *kf0, KF *kf1, KF *kf2, KI *ki0, KI *ki1, KI *ki2)
{
    kp->kinsname = kp->halprefix = "own";
    kp->required_coordinates = "xyz";
    kp->max_joints = 3;
    *ks0 = *ks1 = identityKinematicsSetup;
    *kf0 = *kf1 = identityKinematicsForward;
    *ki0 = *ki1 = identityKinematicsInverse;
    *ks2 = userkKinematicsSetup;
    *kf2 = userkKinematicsForward;
    *ki2 = userkKinematicsInverse;
    return 0;
}
