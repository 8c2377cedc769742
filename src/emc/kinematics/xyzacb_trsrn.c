/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * xyzacb_trsrn.c - six-axis mill: rotary table A, spindle turning (C) and nutating (B).
 *
 * In, out: kinematics.h; pins xyzacb_trsrn_kins.*; types 0 identity, 1 tool centre point, 2 tool frame
 * Thread:  servo
 * Method:  see trsrn.h; the inverse takes rotary angles from the pose (the peer
 *          takes those of the cycle before: docs/compatibility.md).
 */
#include "trsrn.h"

MODULE_AUTHOR("Kerf");
MODULE_DESCRIPTION("Kinematics of a mill with rotary table A and a nutating spindle");
MODULE_LICENSE("GPL");

static PmCartesian tcp_forward(const struct trsrn *f, const double *P)
{
    double Px = P[0], Py = P[1], Pz = P[2];
    PmCartesian q;
    q.x = -(f->cp * f->M - f->sp * f->t) * f->E - f->cp * f->Dx + (f->cp * f->K + f->sp * f->r) * f->L + f->Dy *
          f->sp + f->Dx + Px;
    q.y = -f->cp * f->cw * f->Dy - f->cw * f->Dx * f->sp - f->cw * (f->R - Py) - (f->cw * f->sp * f->M + f->cp *
          f->cw * f->t - f->sw * f->s) * f->E + (f->K * f->cw * f->sp - f->cp * f->cw * f->r + f->sw * f->t) *
          f->L + (f->Rz - Pz) * f->sw + f->R + f->Dy + f->L;
    q.z = -f->cp * f->Dy * f->sw - f->Dx * f->sp * f->sw - f->cw * (f->Rz - Pz) - (f->sp * f->M * f->sw + f->cp
          * f->sw * f->t + f->cw * f->s) * f->E + (f->K * f->sp * f->sw - f->cp * f->sw * f->r - f->cw * f->t) *
          f->L - (f->R - Py) * f->sw + f->Rz + f->Dt + f->Lz;
    return q;
}

static void tcp_inverse(const struct trsrn *f, const PmCartesian *Q, double *J)
{
    J[0] = (f->cp * f->M - f->sp * f->t) * f->E + f->cp * f->Dx - (f->cp * f->K + f->sp * f->r) * f->L - f->Dy *
          f->sp - f->Dx + Q->x;
    J[1] = f->cp * f->Dy + f->Dx * f->sp - f->cw * (f->R + f->Dy + f->L - Q->y) + (f->sp * f->M + f->cp * f->t)
          * f->E - (f->K * f->sp - f->cp * f->r) * f->L - (f->Rz + f->E - Q->z) * f->sw + f->R;
    J[2] = f->E * f->s + f->L * f->t - f->cw * (f->Rz + f->E - Q->z) + (f->R + f->Dy + f->L - Q->y) * f->sw +
          f->Rz;
}

static PmCartesian tool_forward(const struct trsrn *f, const double *P)
{
    double Px = P[0], Py = P[1], Pz = P[2];
    double g1 = f->cs * f->ctc - f->K * f->stc, g2 = f->ctc * f->K + f->stc * f->r;
    double g3 = f->ctc * f->K + f->cs * f->stc, g4 = f->K * f->stc - f->ctc * f->r;
    PmCartesian q;
    q.x = (g1 * f->cp - g2 * f->sp) * (f->Dx + Px) - g1 * f->Dx + (g2 * f->cp + g1 * f->sp) * (f->Dy + f->L +
          Py) - g2 * f->Dy - (f->ctc * f->M - f->stc * f->t) * (f->Lz + Pz) - f->L * f->stc;
    q.y = -(g3 * f->cp - g4 * f->sp) * (f->Dx + Px) + g3 * f->Dx - (g4 * f->cp + g3 * f->sp) * (f->Dy + f->L +
          Py) + g4 * f->Dy - f->ctc * f->L + (f->stc * f->M + f->ctc * f->t) * (f->Lz + Pz);
    q.z = (f->cp * f->M - f->sp * f->t) * (f->Dx + Px) + (f->sp * f->M + f->cp * f->t) * (f->Dy + f->L + Py) -
          f->Dx * f->M + (f->Lz + Pz) * f->s - f->Dy * f->t - f->Lz;
    return q;
}

static void tool_inverse(const struct trsrn *f, const PmCartesian *Q, double *J)
{
    double h1 = f->cp * f->K + f->sp * f->r, h2 = f->cp * f->cs - f->K * f->sp;
    double h3 = f->K * f->sp - f->cp * f->r, h4 = f->cp * f->K + f->cs * f->sp;
    J[0] = f->cp * f->Dx - h1 * f->L + (f->cp * f->M - f->sp * f->t) * (f->Lz + Q->z) + (h2 * f->ctc - h1 *
          f->stc) * Q->x - (h1 * f->ctc + h2 * f->stc) * Q->y - f->Dy * f->sp - f->Dx;
    J[1] = f->cp * f->Dy - h3 * f->L + (f->sp * f->M + f->cp * f->t) * (f->Lz + Q->z) + (h4 * f->ctc - h3 *
          f->stc) * Q->x - (h3 * f->ctc + h4 * f->stc) * Q->y + f->Dx * f->sp - f->Dy - f->L;
    J[2] = -(f->ctc * f->M - f->stc * f->t) * Q->x + (f->stc * f->M + f->ctc * f->t) * Q->y + (f->Lz + Q->z) *
          f->s + f->L * f->t - f->Lz;
}

const char kins_name[] = "xyzacb_trsrn";

const struct trsrn_mill trsrn_mill = {
    .prefix = "xyzacb_trsrn_kins", .dummy = "xyzacb-trsrn.0.dummy", .side = 'y', .table = 3, .nutating = 4,
    .tcp_forward = tcp_forward, .tcp_inverse = tcp_inverse,
    .tool_forward = tool_forward, .tool_inverse = tool_inverse,
};
