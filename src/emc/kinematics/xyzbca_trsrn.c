/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * xyzbca_trsrn.c - six-axis mill: rotary table B, spindle turning (C) and nutating (A).
 *
 * In, out: kinematics.h; pins xyzbca_trsrn_kins.*; types 0 identity, 1 tool centre point, 2 tool frame
 * Thread:  servo
 * Method:  see trsrn.h; the inverse takes rotary angles from the pose (the peer
 *          takes those of the cycle before: docs/compatibility.md).
 */
#include "trsrn.h"

MODULE_AUTHOR("Kerf");
MODULE_DESCRIPTION("Kinematics of a mill with rotary table B and a nutating spindle");
MODULE_LICENSE("GPL");

static PmCartesian tcp_forward(const struct trsrn *f, const double *P)
{
    double Px = P[0], Py = P[1], Pz = P[2];
    PmCartesian q;
    q.x = -f->cp * f->cw * f->Dx + f->cw * f->Dy * f->sp - f->cw * (f->R - Px) - (f->cw * f->sp * f->M + f->cp *
          f->cw * f->t + f->sw * f->s) * f->E + (f->K * f->cw * f->sp - f->cp * f->cw * f->r - f->sw * f->t) *
          f->L - (f->Rz - Pz) * f->sw + f->R + f->Dx + f->L;
    q.y = (f->cp * f->M - f->sp * f->t) * f->E - f->cp * f->Dy - (f->cp * f->K + f->sp * f->r) * f->L - f->Dx *
          f->sp + f->Dy + Py;
    q.z = f->cp * f->Dx * f->sw - f->Dy * f->sp * f->sw - f->cw * (f->Rz - Pz) + (f->sp * f->M * f->sw + f->cp *
          f->sw * f->t - f->cw * f->s) * f->E - (f->K * f->sp * f->sw - f->cp * f->sw * f->r + f->cw * f->t) *
          f->L + (f->R - Px) * f->sw + f->Rz + f->Dt + f->Lz;
    return q;
}

static void tcp_inverse(const struct trsrn *f, const PmCartesian *Q, double *J)
{
    J[0] = f->cp * f->Dx - f->Dy * f->sp - f->cw * (f->R + f->Dx + f->L - Q->x) + (f->sp * f->M + f->cp * f->t)
          * f->E - (f->K * f->sp - f->cp * f->r) * f->L + (f->Rz + f->E - Q->z) * f->sw + f->R;
    J[1] = -(f->cp * f->M - f->sp * f->t) * f->E + f->cp * f->Dy + (f->cp * f->K + f->sp * f->r) * f->L + f->Dx
          * f->sp - f->Dy + Q->y;
    J[2] = f->E * f->s + f->L * f->t - f->cw * (f->Rz + f->E - Q->z) - (f->R + f->Dx + f->L - Q->x) * f->sw +
          f->Rz;
}

static PmCartesian tool_forward(const struct trsrn *f, const double *P)
{
    double Px = P[0], Py = P[1], Pz = P[2];
    double g1 = f->cs * f->ctc - f->K * f->stc, g2 = f->ctc * f->K + f->stc * f->r;
    double g3 = f->ctc * f->K + f->cs * f->stc, g4 = f->K * f->stc - f->ctc * f->r;
    PmCartesian q;
    q.x = -(g4 * f->cp + g3 * f->sp) * (f->Dx + f->L + Px) + g4 * f->Dx + (g3 * f->cp - g4 * f->sp) * (f->Dy +
          Py) - g3 * f->Dy - f->ctc * f->L + (f->stc * f->M + f->ctc * f->t) * (f->Lz + Pz);
    q.y = -(g2 * f->cp + g1 * f->sp) * (f->Dx + f->L + Px) + g2 * f->Dx + (g1 * f->cp - g2 * f->sp) * (f->Dy +
          Py) - g1 * f->Dy + (f->ctc * f->M - f->stc * f->t) * (f->Lz + Pz) + f->L * f->stc;
    q.z = (f->sp * f->M + f->cp * f->t) * (f->Dx + f->L + Px) - (f->cp * f->M - f->sp * f->t) * (f->Dy + Py) +
          f->Dy * f->M + (f->Lz + Pz) * f->s - f->Dx * f->t - f->Lz;
    return q;
}

static void tool_inverse(const struct trsrn *f, const PmCartesian *Q, double *J)
{
    double h1 = f->cp * f->K + f->sp * f->r, h2 = f->cp * f->cs - f->K * f->sp;
    double h3 = f->K * f->sp - f->cp * f->r, h4 = f->cp * f->K + f->cs * f->sp;
    J[0] = f->cp * f->Dx - h3 * f->L + (f->sp * f->M + f->cp * f->t) * (f->Lz + Q->z) - (h3 * f->ctc + h4 *
          f->stc) * Q->x - (h4 * f->ctc - h3 * f->stc) * Q->y - f->Dy * f->sp - f->Dx - f->L;
    J[1] = f->cp * f->Dy + h1 * f->L - (f->cp * f->M - f->sp * f->t) * (f->Lz + Q->z) + (h1 * f->ctc + h2 *
          f->stc) * Q->x + (h2 * f->ctc - h1 * f->stc) * Q->y + f->Dx * f->sp - f->Dy;
    J[2] = (f->stc * f->M + f->ctc * f->t) * Q->x + (f->ctc * f->M - f->stc * f->t) * Q->y + (f->Lz + Q->z) *
          f->s + f->L * f->t - f->Lz;
}

const char kins_name[] = "xyzbca_trsrn";

const struct trsrn_mill trsrn_mill = {
    .prefix = "xyzbca_trsrn_kins", .dummy = "xyzbca-trsrn.0.dummy", .side = 'x', .table = 4, .nutating = 3,
    .tcp_forward = tcp_forward, .tcp_inverse = tcp_inverse,
    .tool_forward = tool_forward, .tool_inverse = tool_inverse,
};
