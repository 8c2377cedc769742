/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * trtfuncs.c - mills with tilting (A or B) and turning (C) table.
 *
 * In:     pins <prefix>.x-rot-point .. conventional-directions    Out: kinematics.h
 * Thread: servo
 * Method: the work turns about the rotation point, offsets lie between both
 *         rotary axes. With M the rotation of the table (tilt, then turn), d the
 *         offset: joint = rot + M^-1 (p - rot) + d - T^-1 d, T the tilt alone.
 *         Forward is the exact inverse also where the peer's XYZBC is not
 *         (conventional-directions 0 and offsets: docs/compatibility.md).
 */
#include "kins_common.h"
#include "switchkins_util.h"
#include "trtfuncs.h"

static struct {
    hal_real_t x_rot, y_rot, z_rot, x_offset, y_offset, z_offset, tool_offset;
    hal_bool_t conventional;
} *pins;

static int joint_of[EMCMOT_MAX_AXIS];
static int max_joints;
static int tilt_axis; /* 3 = A, 4 = B */

int trtKinematicsSetup(const int comp_id, const char *coordinates, kparms *kp, char tilt)
{
    int r = 0;
    tilt_axis = tilt == 'A' ? 3 : 4;
    max_joints = kp->max_joints;
    if (switchkins_joints_of_axes(coordinates, kp, joint_of) != 0)
        return -1;
    pins = hal_malloc(sizeof(*pins));
    if (!pins)
        return -1;
    r |= hal_pin_new_real(comp_id, HAL_IN, &pins->x_rot, 0, "%s.x-rot-point", kp->halprefix);
    r |= hal_pin_new_real(comp_id, HAL_IN, &pins->y_rot, 0, "%s.y-rot-point", kp->halprefix);
    r |= hal_pin_new_real(comp_id, HAL_IN, &pins->z_rot, 0, "%s.z-rot-point", kp->halprefix);
    r |= hal_pin_new_real(comp_id, HAL_IN, &pins->x_offset, 0, "%s.x-offset", kp->halprefix);
    r |= hal_pin_new_real(comp_id, HAL_IN, &pins->y_offset, 0, "%s.y-offset", kp->halprefix);
    r |= hal_pin_new_real(comp_id, HAL_IN, &pins->z_offset, 0, "%s.z-offset", kp->halprefix);
    r |= hal_pin_new_real(comp_id, HAL_IN, &pins->tool_offset, 0, "%s.tool-offset", kp->halprefix);
    r |= hal_pin_new_bool(comp_id, HAL_IN, &pins->conventional, 0, "%s.conventional-directions", kp->halprefix);
    return r < 0 ? -1 : 0;
}

/* Joint values become the pose: p = rot + C T (q - rot - d) + C d with d along the tilt's frame.
 * The rotation of the tilt (angle t) and the turn (angle c), each with its sign con. */
struct table {
    double st, ct, sc, cc; /* of the signed angles */
    PmCartesian rot, d;
};

static struct table table_at(double tilt, double turn)
{
    struct table t;
    double con = hal_get_bool(pins->conventional) ? 1.0 : -1.0;
    sincos_deg(con * tilt, &t.st, &t.ct);
    sincos_deg(con * turn, &t.sc, &t.cc);
    t.rot.x = hal_get_real(pins->x_rot);
    t.rot.y = hal_get_real(pins->y_rot);
    t.rot.z = hal_get_real(pins->z_rot);
    t.d.x = tilt_axis == 4 ? hal_get_real(pins->x_offset) : 0.0;
    t.d.y = tilt_axis == 3 ? hal_get_real(pins->y_offset) : 0.0;
    t.d.z = hal_get_real(pins->z_offset) + hal_get_real(pins->tool_offset);
    return t;
}

/* The tilt: work coordinates from joint coordinates (inverse: back). */
static PmCartesian tilt(const struct table *t, PmCartesian v, int back)
{
    double s = back ? -t->st : t->st, c = t->ct;
    PmCartesian r = v;
    if (tilt_axis == 3) {
        r.y = c * v.y - s * v.z;
        r.z = s * v.y + c * v.z;
    } else {
        r.x = c * v.x + s * v.z;
        r.z = -s * v.x + c * v.z;
    }
    return r;
}

static PmCartesian turn(const struct table *t, PmCartesian v, int back)
{
    double s = back ? -t->sc : t->sc, c = t->cc;
    PmCartesian r = {c * v.x - s * v.y, s * v.x + c * v.y, v.z};
    return r;
}

int trtKinematicsForward(const double *joint, EmcPose *world, const KINEMATICS_FORWARD_FLAGS *fflags,
                         KINEMATICS_INVERSE_FLAGS *iflags)
{
    struct table t = table_at(joint[joint_of[tilt_axis]], joint[joint_of[5]]);
    PmCartesian q = {joint[joint_of[0]], joint[joint_of[1]], joint[joint_of[2]]}, v;
    EmcPose p;
    (void)fflags;
    (void)iflags;
    pmCartSubEq(&q, &t.rot);
    pmCartSubEq(&q, &t.d);
    v = tilt(&t, q, 0);
    pmCartAddEq(&v, &t.d);
    v = turn(&t, v, 0);
    pmCartAddEq(&v, &t.rot);
    ZERO_EMC_POSE(p);
    mapped_joints_to_position(max_joints, joint, &p);
    p.tran = v;
    *world = p;
    return 0;
}

int trtKinematicsInverse(const EmcPose *world, double *joint, const KINEMATICS_INVERSE_FLAGS *iflags,
                         KINEMATICS_FORWARD_FLAGS *fflags)
{
    struct table t = table_at(emcPoseGetAxis(world, tilt_axis), world->c);
    EmcPose q = *world;
    PmCartesian v = world->tran;
    (void)iflags;
    (void)fflags;
    pmCartSubEq(&v, &t.rot);
    v = turn(&t, v, 1);
    pmCartSubEq(&v, &t.d);
    v = tilt(&t, v, 1);
    pmCartAddEq(&v, &t.d);
    pmCartAddEq(&v, &t.rot);
    q.tran = v;
    return position_to_mapped_joints(max_joints, &q, joint);
}
