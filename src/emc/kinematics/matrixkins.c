/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * matrixkins.c - corrects misaligned axes: joints = C (x, y, z).
 *
 * In, out: kinematics.h; parameters matrixkins.C_xx to .C_zz
 * Thread:  servo
 * Method:  inverse of the matrix by cofactors; a singular matrix fails.
 */
#include "kins_main.h"

MODULE_AUTHOR("Kerf");
MODULE_DESCRIPTION("Calibrated kinematics of three axes");
MODULE_LICENSE("GPL");

static struct {
    hal_real_t C[3][3];
    hal_bool_t dummy;
} *pins;

static void matrix(double m[3][3])
{
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            m[i][k] = hal_get_real(pins->C[i][k]);
}

int kinematicsForward(const double *joint, EmcPose *world, const KINEMATICS_FORWARD_FLAGS *fflags,
                      KINEMATICS_INVERSE_FLAGS *iflags)
{
    double m[3][3], cof[3][3], det = 0.0, *out[3] = {&world->tran.x, &world->tran.y, &world->tran.z};
    (void)fflags;
    (void)iflags;
    matrix(m);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            int a = (i + 1) % 3, b = (i + 2) % 3, c = (k + 1) % 3, d = (k + 2) % 3;
            cof[i][k] = m[a][c] * m[b][d] - m[a][d] * m[b][c];
        }
    for (int k = 0; k < 3; k++)
        det += m[0][k] * cof[0][k];
    if (!(fabs(det) > 1e-12))
        return -1;
    for (int i = 0; i < 3; i++)
        *out[i] = (cof[0][i] * joint[0] + cof[1][i] * joint[1] + cof[2][i] * joint[2]) / det;
    rest_forward(joint, world);
    return 0;
}

int kinematicsInverse(const EmcPose *world, double *joint, const KINEMATICS_INVERSE_FLAGS *iflags,
                      KINEMATICS_FORWARD_FLAGS *fflags)
{
    double m[3][3];
    (void)iflags;
    (void)fflags;
    matrix(m);
    for (int i = 0; i < 3; i++)
        joint[i] = m[i][0] * world->tran.x + m[i][1] * world->tran.y + m[i][2] * world->tran.z;
    rest_inverse(world, joint);
    return 0;
}

KINS_NOT_SWITCHABLE

const char kins_name[] = "matrixkins";

int kins_setup(int comp_id)
{
    static const char xyz[] = "xyz";
    int r = 0;
    pins = hal_malloc(sizeof(*pins));
    for (int i = 0; pins && i < 3; i++)
        for (int k = 0; k < 3; k++)
            r |= hal_param_new_real(comp_id, HAL_RW, &pins->C[i][k], i == k, "matrixkins.C_%c%c", xyz[i], xyz[k]);
    if (!pins || r < 0 || hal_pin_new_bool(comp_id, HAL_OUT, &pins->dummy, 1, "matrixkins.0.dummy") < 0)
        return -1;
    return 0;
}
