/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * kinematics.h - what a kinematics module exports to the motion controller.
 *
 * A module exports (EXPORT_SYMBOL) kinematicsType, kinematicsForward,
 * kinematicsInverse, kinematicsSwitchable and kinematicsSwitch.
 * Units: lengths in machine units, angles in degrees.
 * Context: kinematicsType [init]; the others [servo] (bounded, no allocation).
 * Joint arrays hold EMCMOT_MAX_JOINTS values; a module touches only its own.
 */
#ifndef KERF_KINEMATICS_H
#define KERF_KINEMATICS_H

#include "emcpos.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
    KINEMATICS_IDENTITY = 1,   /* joint = axis: both directions, also before homing */
    KINEMATICS_FORWARD_ONLY,
    KINEMATICS_INVERSE_ONLY,
    KINEMATICS_BOTH            /* both directions, once all joints are homed */
} KINEMATICS_TYPE;

typedef unsigned long int KINEMATICS_FORWARD_FLAGS; /* choose among forward solutions */
typedef unsigned long int KINEMATICS_INVERSE_FLAGS; /* choose among inverse solutions */

/* Pose of the tool from joint positions. On entry *world is the pose before
 * (seed of iterative solvers). Returns < 0 when there is no pose. */
extern int kinematicsForward(const double *joint, EmcPose *world,
                             const KINEMATICS_FORWARD_FLAGS *fflags, KINEMATICS_INVERSE_FLAGS *iflags);

/* Joint positions of a pose. On entry joint holds the present joint commands
 * (seed). Returns other than 0 when the pose cannot be reached. */
extern int kinematicsInverse(const EmcPose *world, double *joint,
                             const KINEMATICS_INVERSE_FLAGS *iflags, KINEMATICS_FORWARD_FLAGS *fflags);

/* Optional, never called by the motion controller. */
extern int kinematicsHome(EmcPose *world, double *joint,
                          KINEMATICS_FORWARD_FLAGS *fflags, KINEMATICS_INVERSE_FLAGS *iflags);

extern KINEMATICS_TYPE kinematicsType(void);

/* Not 0: motion.switchkins-type exists and chooses the kinematics. */
extern int kinematicsSwitchable(void);
/* Returns 0, or other than 0 when there is no such type. */
extern int kinematicsSwitch(int switchkins_type);

/* For modules with one kinematics only (needs rtapi_app.h's EXPORT_SYMBOL). */
#define KINS_NOT_SWITCHABLE                                          \
    int kinematicsSwitchable(void) { return 0; }                     \
    int kinematicsSwitch(int switchkins_type) { (void)switchkins_type; return 0; } \
    EXPORT_SYMBOL(kinematicsSwitchable);                             \
    EXPORT_SYMBOL(kinematicsSwitch);

/* Coordinate letters to joints (kins_util.c).
 * coordinates: letters of xyzabcuvw in any case, blanks ignored; joint n is the
 * n-th letter. axis_idx_for_jno[n] becomes 0..8 or -1. Returns 0, or -1 with a message. */
extern int map_coordinates_to_jnumbers(const char *coordinates, const int max_joints,
                                       const int allow_duplicates, int axis_idx_for_jno[]);
/* Both use the last mapping made; a letter without joint keeps its value in pos. */
extern int mapped_joints_to_position(const int max_joints, const double *joints, EmcPose *pos);
extern int position_to_mapped_joints(const int max_joints, const EmcPose *pos, double *joints);

struct kinematics_parms;
extern int identityKinematicsSetup(const int comp_id, const char *coordinates, struct kinematics_parms *ksetup_parms);
extern int identityKinematicsForward(const double *joint, EmcPose *world,
                                     const KINEMATICS_FORWARD_FLAGS *fflags, KINEMATICS_INVERSE_FLAGS *iflags);
extern int identityKinematicsInverse(const EmcPose *world, double *joint,
                                     const KINEMATICS_INVERSE_FLAGS *iflags, KINEMATICS_FORWARD_FLAGS *fflags);
extern int userkKinematicsSetup(const int comp_id, const char *coordinates, struct kinematics_parms *ksetup_parms);
extern int userkKinematicsForward(const double *joint, EmcPose *world,
                                  const KINEMATICS_FORWARD_FLAGS *fflags, KINEMATICS_INVERSE_FLAGS *iflags);
extern int userkKinematicsInverse(const EmcPose *world, double *joint,
                                  const KINEMATICS_INVERSE_FLAGS *iflags, KINEMATICS_FORWARD_FLAGS *fflags);

#ifdef __cplusplus
}
#endif
#endif
