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
#include "rtapi_app.h"

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

int kinematicsForward(const double *j, EmcPose *world, const KINEMATICS_FORWARD_FLAGS *fflags,
                      KINEMATICS_INVERSE_FLAGS *iflags)
{
    EmcPose p = {{j[0], j[1], j[2]}, j[3], j[4], j[5], 0, 0, 0};
    (void)fflags;
    (void)iflags;
    if (type_now == TCP) {
        struct trsrn f = trsrn_terms(j[5], j[4], j[3], 1);
        p.tran = tcp_forward(&f, j);
    } else if (type_now == TOOL) {
        struct trsrn f = trsrn_terms(hal_get_real(pins->primary), hal_get_real(pins->secondary), 0.0, 1);
        p.tran = tool_forward(&f, j);
    }
    *world = p;
    return 0;
}

int kinematicsInverse(const EmcPose *world, double *j, const KINEMATICS_INVERSE_FLAGS *iflags,
                      KINEMATICS_FORWARD_FLAGS *fflags)
{
    (void)iflags;
    (void)fflags;
    j[3] = world->a;
    j[4] = world->b;
    j[5] = world->c;
    if (type_now == TCP) {
        struct trsrn f = trsrn_terms(j[5], j[4], j[3], 1);
        tcp_inverse(&f, &world->tran, j);
    } else if (type_now == TOOL) {
        struct trsrn f = trsrn_terms(hal_get_real(pins->primary), hal_get_real(pins->secondary), 0.0, 1);
        tool_inverse(&f, &world->tran, j);
    } else {
        j[0] = world->tran.x;
        j[1] = world->tran.y;
        j[2] = world->tran.z;
    }
    return 0;
}

KINEMATICS_TYPE kinematicsType(void) { return KINEMATICS_BOTH; }
int kinematicsSwitchable(void) { return 1; }
int kinematicsSwitch(int type) { return ownswitch_switch(type, 0); }

EXPORT_SYMBOL(kinematicsType);
EXPORT_SYMBOL(kinematicsSwitchable);
EXPORT_SYMBOL(kinematicsSwitch);
EXPORT_SYMBOL(kinematicsForward);
EXPORT_SYMBOL(kinematicsInverse);

static int comp_id;

int rtapi_app_main(void)
{
    comp_id = hal_init("xyzacb_trsrn");
    if (comp_id < 0)
        return comp_id;
    if (trsrn_pins(comp_id, "xyzacb_trsrn_kins", "xyzacb-trsrn.0.dummy", 'y') != 0) {
        hal_exit(comp_id);
        return -1;
    }
    return hal_ready(comp_id);
}

void rtapi_app_exit(void) { hal_exit(comp_id); }
