/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * kins_util.c - coordinate letters to joints; identity kinematics.
 *
 * In, out: kinematics.h   Thread: mapping [init], the rest [servo]
 */
#include <ctype.h>
#include <string.h>
#include "emcmotcfg.h"
#include "emcpose.h"
#include "kinematics.h"
#include "rtapi.h"
#include "switchkins.h"

#define MAX_LETTERS 32
#define DEFAULT_ORDER "XYZABCUVW"

static const char letters[] = "XYZABCUVW";

/* The mapping in use; all kinematics types of a module share it. */
static struct {
    int set;
    int joints;
    char text[MAX_LETTERS + 1];
    int axis_of[EMCMOT_MAX_JOINTS];      /* -1 none */
    int principal[EMCMOT_MAX_AXIS];      /* first joint of an axis, -1 none */
} map;

static int map_error(const char *fmt, const char *text, int number)
{
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
#pragma GCC diagnostic ignored "-Wformat-security"
    char what[160];
    if (text)
        rtapi_snprintf(what, sizeof(what), fmt, text, number);
    else
        rtapi_snprintf(what, sizeof(what), fmt, number);
#pragma GCC diagnostic pop
    rtapi_print_msg(RTAPI_MSG_ERR, "map_coordinates_to_jnumbers: ERROR:\n   %s\n", what);
    return -1;
}

int map_coordinates_to_jnumbers(const char *coordinates, const int max_joints, const int allow_duplicates,
                                int axis_idx_for_jno[])
{
    int axis_of[EMCMOT_MAX_JOINTS], principal[EMCMOT_MAX_AXIS], n = 0;
    char text[MAX_LETTERS + 1], what[160];
    if (max_joints <= 0 || max_joints > EMCMOT_MAX_JOINTS)
        return map_error("bogus max_joints=%d", NULL, max_joints);
    if (!coordinates)
        coordinates = DEFAULT_ORDER;
    if (strlen(coordinates) > MAX_LETTERS)
        return map_error("too many chars in coordinates '%s'", coordinates, 0);
    for (int j = 0; j < EMCMOT_MAX_JOINTS; j++)
        axis_of[j] = -1;
    for (int a = 0; a < EMCMOT_MAX_AXIS; a++)
        principal[a] = -1;
    for (const char *p = coordinates; *p; p++) {
        if (*p == ' ' || *p == '\t')
            continue;
        const char *at = strchr(letters, toupper((unsigned char)*p));
        if (!at) {
            rtapi_snprintf(what, sizeof(what), "Invalid character '%c' in coordinates '%s'", *p, coordinates);
            return map_error("%s", what, 0);
        }
        int axis = (int)(at - letters);
        if (n >= max_joints)
            return map_error("too many coordinates <%s> for max_joints=%d", coordinates, max_joints);
        if (principal[axis] >= 0 && !allow_duplicates) {
            rtapi_snprintf(what, sizeof(what), "duplicates not allowed in coordinates=%s, letter=%c", coordinates,
                           letters[axis]);
            return map_error("%s", what, 0);
        }
        if (principal[axis] < 0)
            principal[axis] = n;
        text[n] = letters[axis];
        axis_of[n++] = axis;
    }
    text[n] = 0;
    if (n == 0)
        return map_error("missing coordinates '%s'", coordinates, 0);
    if (map.set && strcmp(map.text, text) != 0) {
        rtapi_snprintf(what, sizeof(what), "coordinates altered:%s %s", map.text, text);
        return map_error("%s", what, 0);
    }
    map.set = 1;
    map.joints = n;
    memcpy(map.text, text, sizeof(text));
    memcpy(map.axis_of, axis_of, sizeof(axis_of));
    memcpy(map.principal, principal, sizeof(principal));
    if (axis_idx_for_jno)
        for (int j = 0; j < max_joints; j++)
            axis_idx_for_jno[j] = axis_of[j];
    return 0;
}

int mapped_joints_to_position(const int max_joints, const double *joints, EmcPose *pos)
{
    if (!map.set)
        return -1;
    for (int a = 0; a < EMCMOT_MAX_AXIS; a++)
        if (map.principal[a] >= 0 && map.principal[a] < max_joints)
            *emcPoseAxis(pos, a) = joints[map.principal[a]];
    return 0;
}

int position_to_mapped_joints(const int max_joints, const EmcPose *pos, double *joints)
{
    if (!map.set)
        return -1;
    for (int j = 0; j < max_joints && j < map.joints; j++)
        joints[j] = emcPoseGetAxis(pos, map.axis_of[j]);
    return 0;
}

/* ---- identity kinematics ---- */

static int identity_max_joints;

int identityKinematicsSetup(const int comp_id, const char *coordinates, kparms *kp)
{
    int axis_of[EMCMOT_MAX_JOINTS];
    (void)comp_id;
    identity_max_joints = kp->max_joints;
    if (map_coordinates_to_jnumbers(coordinates, kp->max_joints, kp->allow_duplicates, axis_of) != 0)
        return -1;
    /* the usual order needs no words */
    if (strncmp(map.text, DEFAULT_ORDER, (size_t)map.joints) == 0 || strcmp(map.text, "XZ") == 0)
        return 0;
    rtapi_print("identityKinematicsSetup: coordinates:%s\n", coordinates);
    for (int j = 0; j < map.joints; j++)
        rtapi_print("   Joint %d ==> Axis %c\n", j, letters[map.axis_of[j]]);
    if (kinematicsType() != KINEMATICS_BOTH)
        rtapi_print("identityKinematicsSetup: Recommend: kinstype=both\n");
    return 0;
}

int identityKinematicsForward(const double *joint, EmcPose *world, const KINEMATICS_FORWARD_FLAGS *fflags,
                              KINEMATICS_INVERSE_FLAGS *iflags)
{
    (void)fflags;
    (void)iflags;
    return mapped_joints_to_position(identity_max_joints, joint, world);
}

int identityKinematicsInverse(const EmcPose *world, double *joint, const KINEMATICS_INVERSE_FLAGS *iflags,
                              KINEMATICS_FORWARD_FLAGS *fflags)
{
    (void)iflags;
    (void)fflags;
    return position_to_mapped_joints(identity_max_joints, world, joint);
}
