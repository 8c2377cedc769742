/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * switchkins_util.c - what switchable modules share at load.   In, out: switchkins_util.h   Thread: init
 */
#include <ctype.h>
#include <string.h>
#include "emcmotcfg.h"
#include "rtapi.h"
#include "switchkins_util.h"

void switchkins_usual_types(const kparms *kp, KS own_setup, KF own_forward, KI own_inverse, KS *ks0, KS *ks1,
                            KS *ks2, KF *kf0, KF *kf1, KF *kf2, KI *ki0, KI *ki1, KI *ki2)
{
    int swap = kp->sparm && strstr(kp->sparm, "identityfirst");
    *(swap ? ks1 : ks0) = own_setup;
    *(swap ? kf1 : kf0) = own_forward;
    *(swap ? ki1 : ki0) = own_inverse;
    *(swap ? ks0 : ks1) = identityKinematicsSetup;
    *(swap ? kf0 : kf1) = identityKinematicsForward;
    *(swap ? ki0 : ki1) = identityKinematicsInverse;
    *ks2 = userkKinematicsSetup;
    *kf2 = userkKinematicsForward;
    *ki2 = userkKinematicsInverse;
}

int switchkins_joints_of_axes(const char *coordinates, const kparms *kp, int joint_of_axis[])
{
    static const char letters[] = "XYZABCUVW";
    int axis_of[EMCMOT_MAX_JOINTS];
    if (map_coordinates_to_jnumbers(coordinates, kp->max_joints, kp->allow_duplicates, axis_of) != 0)
        return -1;
    for (int a = 0; a < EMCMOT_MAX_AXIS; a++) {
        joint_of_axis[a] = -1;
        for (int j = kp->max_joints - 1; j >= 0; j--)
            if (axis_of[j] == a)
                joint_of_axis[a] = j;
    }
    for (const char *p = kp->required_coordinates; *p; p++) {
        const char *at = strchr(letters, toupper((unsigned char)*p));
        if (at && joint_of_axis[at - letters] < 0) {
            rtapi_print_msg(RTAPI_MSG_ERR, "ERROR %s:\nrequired  coordinates:%s\nspecified coordinates:%s\n",
                            kp->kinsname, kp->required_coordinates, coordinates);
            return -1;
        }
    }
    return 0;
}
