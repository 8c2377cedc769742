/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * path.h - geometry of one programmed move and of the rounding at its ends.
 *
 * A path lives in nine axes (x y z a b c u v w; machine units and degrees). A
 * move is parameterised by s in [0, len], len being the nine-dimensional length
 * (one degree counts as one unit), so a move never degenerates whatever axes it
 * moves; feed is measured separately in the move's metric (path_metric).
 * Thread context: [any], no state. Derivation: docs/planner.md.
 */
#ifndef KERF_TP_PATH_H
#define KERF_TP_PATH_H

#define PATH_AXES 9

enum path_axis { PATH_X, PATH_Y, PATH_Z, PATH_A, PATH_B, PATH_C, PATH_U, PATH_V, PATH_W };

/* In which group of axes the feed of a move is measured. */
enum path_metric { PATH_XYZ, PATH_UVW, PATH_ABC };

enum path_kind { PATH_LINE, PATH_ARC };

/* Position and its first three derivatives by s. */
struct path_jet {
    double p[PATH_AXES], d1[PATH_AXES], d2[PATH_AXES], d3[PATH_AXES];
};

/* One programmed move. */
struct path_prim {
    enum path_kind kind;
    enum path_metric metric;
    double len;       /* nine-dimensional length, > 0 */
    double feed_len;  /* length in the metric group, >= 0 */
    double start[PATH_AXES], end[PATH_AXES];
    double u[PATH_AXES]; /* dp/ds of the axes that move linearly (all, for a line) */
    /* arcs: p = center + (radius + spiral t) er(angle t) + helix t, t = s / len */
    double center[3], ex[3], ey[3], helix[3];
    double radius, spiral, angle;
    double min_radius; /* smallest effective radius of curvature, arcs */
};

enum path_result { PATH_OK = 0, PATH_ZERO_LENGTH, PATH_BAD_NORMAL, PATH_BAD_RADIUS };

#define PATH_TINY 1e-8     /* units, deg: a group that moves less does not set the metric */
#define PATH_MIN_RADIUS 1e-6 /* units: smaller arcs are refused */

/* Straight move. PATH_ZERO_LENGTH when no group moves by PATH_TINY. */
enum path_result path_line(struct path_prim *prim, const double start[PATH_AXES], const double end[PATH_AXES]);

/* Arc, helix or spiral of xyz about center, counter-clockwise around normal; turn adds whole
 * turns; turn < 0 runs clockwise with -1 - turn whole turns. Other axes move linearly. */
enum path_result path_arc(struct path_prim *prim, const double start[PATH_AXES], const double end[PATH_AXES],
                          const double center[3], const double normal[3], int turn);

/* Position and derivatives at s (clamped to the move). */
void path_jet_at(const struct path_prim *prim, double s, struct path_jet *jet);

/* Position only. At s = 0 and s = len exactly the programmed ends. */
void path_at(const struct path_prim *prim, double s, double p[PATH_AXES]);

/* The rounding kernel of a junction and its derivatives; x = (s - junction) / half width, |x| <= 1.
 * path_round cancels a unit jump of slope, path_bend a unit jump of second derivative:
 * value and derivatives by x in k[0..3]; at x = 0 the one-sided values of side (-1 or +1). */
void path_round(double x, int side, double k[4]);
void path_bend(double x, int side, double k[4]);

#define PATH_ROUND_PEAK (3.0 / 16.0) /* value at 0 */
#define PATH_ROUND_CURVE 0.75        /* largest second derivative */
#define PATH_ROUND_SLOPE 1.5         /* largest third derivative */
#define PATH_BEND_PEAK 0.01363       /* largest absolute value */
#define PATH_BEND_SLOPE (37.0 / 42)  /* largest third derivative */

/* Euclidean length of one group (three axes) of v. */
double path_group_norm(const double v[PATH_AXES], enum path_metric group);
/* The longest of the three groups. */
double path_max_norm(const double v[PATH_AXES]);

#endif
