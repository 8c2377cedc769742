/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * trsrn.h - six-axis mills: a rotary table and a spindle that turns (C) and nutates.
 *
 * trsrn.c holds what the two mills share; xyzacb_trsrn.c (table A, nutation B) and
 * xyzbca_trsrn.c (table B, nutation A) their formulas. Lengths in machine units,
 * angles in degrees but pre-rot, which is in radians. Context: [servo].
 */
#ifndef KERF_TRSRN_H
#define KERF_TRSRN_H

#include "kins_main.h"

/* Terms of the formulas: lengths in machine units, s and c for the sine and cosine of an angle. */
struct trsrn {
    double Dx, Dy, Dt, Lz, L, E, R, Rz;  /* L, R: pivot and rotary axis on the table's side */
    double sp, cp, ss, cs, sw, cw;       /* primary (C), secondary (nutation), table */
    double stc, ctc;
    double K, M, r, s, t;
};

/* One of the mills. The formulas take and give joints X Y Z and the point of the tool. */
struct trsrn_mill {
    const char *prefix, *dummy; /* names of its pins */
    char side;                  /* 'x' or 'y': where the table's axis and the pivot lie aside */
    int table, nutating;        /* joints */
    PmCartesian (*tcp_forward)(const struct trsrn *f, const double *joint);
    void (*tcp_inverse)(const struct trsrn *f, const PmCartesian *tool, double *joint);
    PmCartesian (*tool_forward)(const struct trsrn *f, const double *joint);
    void (*tool_inverse)(const struct trsrn *f, const PmCartesian *tool, double *joint);
};
extern const struct trsrn_mill trsrn_mill;

#endif
