/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * limits.h - limits of axes and joints, and the joints' part of the path.
 *
 * Joints follow the pose through the machine's kinematics. Where that is a linear map (identity,
 * gantries, corexy, matrices) a joint is a row of the map, and a joint that is one axis only
 * tightens that axis's limits. Other kinematics are sampled: the joints' derivatives along the
 * path come from the inverse at points of a local cubic of the path.
 * Context: [servo], no allocation; a sample calls the inverse LIMITS_POINTS times, up to four times
 * that near the edge of what can be reached.
 */
#ifndef KERF_TP_LIMITS_H
#define KERF_TP_LIMITS_H

#include "path.h"

#define LIMITS_JOINTS 16
#define LIMITS_POINTS 5 /* calls of the inverse for one sample */

/* How joints depend on the pose. */
enum limits_kins { LIMITS_NONE, LIMITS_LINEAR, LIMITS_SAMPLED };

/* The machine, as motmod knows it. All functions [servo]. */
struct limits_source {
    int (*joints)(void); /* joints that the kinematics move */
    /* Joints of a pose; q: seed and result. Other than 0: unreachable. */
    int (*inverse)(const double p[PATH_AXES], double q[LIMITS_JOINTS]);
    void (*seed)(double q[LIMITS_JOINTS]); /* the present joint commands */
    /* Velocity, acceleration, jerk; 0 = none. */
    void (*joint_limits)(int joint, double limit[3]);
    void (*axis_limits)(int axis, double limit[3]);
};

/* Speed, acceleration and jerk; 0 = no limit known. */
struct limits_row {
    double m[PATH_AXES]; /* LIMITS_LINEAR: the joint's row of the map */
    double v, a, j;
};

struct limits {
    double v[PATH_AXES], a[PATH_AXES], j[PATH_AXES]; /* of axes, tightened by joints that are one axis */
    int jerk_on;        /* the limits of jerk hold */
    enum limits_kins kins;
    int joints;
    int rows;           /* LIMITS_LINEAR: rows used; LIMITS_SAMPLED: joints */
    struct limits_row row[LIMITS_JOINTS];
    double seed[LIMITS_JOINTS]; /* LIMITS_SAMPLED: joints of the last sample */
    const struct limits_source *source;
};

/* First three derivatives of the joints by s. */
struct limits_jet {
    double d1[LIMITS_JOINTS], d2[LIMITS_JOINTS], d3[LIMITS_JOINTS];
};

/* Reads the limits; at rest also finds out how joints depend on the pose, around p.
 * jerk: largest allowed in any axis, 0 none. */
void limits_read(struct limits *lim, int jerk_on, double jerk);
void limits_probe(struct limits *lim, const double p[PATH_AXES]);

/* Joints' derivatives where the path has the derivatives of jet. -1: unreachable. */
int limits_sample(struct limits *lim, const struct path_jet *jet, struct limits_jet *out);

#endif
