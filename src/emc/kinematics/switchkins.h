/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * switchkins.h - kinematics modules whose kinematics can be switched.
 *
 * A module supplies switchkinsSetup(); switchkins.c supplies loading, pins and
 * the functions of kinematics.h.
 */
#ifndef KERF_SWITCHKINS_H
#define KERF_SWITCHKINS_H

#include "kinematics.h"

#ifdef __cplusplus
extern "C" {
#endif

#define SWITCHKINS_MAX_TYPES 9

typedef struct kinematics_parms {
    char *sparm;                /* loadrt sparm=, or null */
    char *kinsname;
    char *halprefix;            /* of pins */
    char *required_coordinates;
    int max_joints;
    int allow_duplicates;
    int fwd_iterates_mask;      /* bit n: forward of type n is iterative */
    int gui_kinstype;           /* type shown on skgui pins, -1 none */
} kparms;

/* Setup [init]: returns 0. */
typedef int (*KS)(const int comp_id, const char *coordinates, kparms *kp);
typedef int (*KF)(const double *joint, EmcPose *world, const KINEMATICS_FORWARD_FLAGS *fflags,
                  KINEMATICS_INVERSE_FLAGS *iflags);
typedef int (*KI)(const EmcPose *world, double *joint, const KINEMATICS_INVERSE_FLAGS *iflags,
                  KINEMATICS_FORWARD_FLAGS *fflags);

/* [init] Supplied by the module: fills kp and types 0 to 2. Returns 0. */
extern int switchkinsSetup(kparms *kp, KS *ks0, KS *ks1, KS *ks2, KF *kf0, KF *kf1, KF *kf2, KI *ki0, KI *ki1,
                           KI *ki2);
/* [init] Called inside switchkinsSetup() for further types, 3 to 8. Returns 0, -1. */
extern int switchkinsRegister(int ktype, KS setup, KF fwd, KI inv);

#ifdef __cplusplus
}
#endif
#endif
