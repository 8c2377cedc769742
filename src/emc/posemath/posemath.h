/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * posemath.h - vectors, rotations and poses, in C.
 *
 * Context: [any]; no allocation, no state, bounded.
 * Results: 0, or a negative PM_* code; on a code other than 0 the result is
 * defined as each function says. Output may be the same object as an input.
 */
#ifndef KERF_POSEMATH_H
#define KERF_POSEMATH_H

#include "posemath_types.h"

#ifdef __cplusplus
extern "C" {
#endif

#define PM_PI 3.14159265358979323846
#define PM_PI_2 1.57079632679489661923
#define PM_PI_4 0.78539816339744830962
#define PM_2_PI 6.28318530717958647692
#define TO_DEG (180.0 / PM_PI)
#define TO_RAD (PM_PI / 180.0)
#define PM_DEG(rad) ((rad) * TO_DEG)
#define PM_RAD(deg) ((deg) * TO_RAD)

/* Comparison bounds: 1e-6 units or radians, below what any machine resolves. */
#define V_FUZZ 1.0e-6
#define Q_FUZZ 1.0e-6
#define CART_FUZZ 1.0e-8
#define UNIT_VEC_FUZZ 1.0e-6

#define PM_OK 0
#define PM_ERR (-1)       /* argument without meaning */
#define PM_IMPL_ERR (-2)
#define PM_NORM_ERR (-3)  /* not of unit length / zero length */
#define PM_DIV_ERR (-4)   /* division by zero */

#define PM_MIN(a, b) ((a) < (b) ? (a) : (b))
#define PM_MAX(a, b) ((a) > (b) ? (a) : (b))
#define pmSq(v) ((v) * (v))

/* Vectors */
int pmCartCartAdd(PmCartesian const *a, PmCartesian const *b, PmCartesian *out);
int pmCartCartSub(PmCartesian const *a, PmCartesian const *b, PmCartesian *out);
int pmCartCartDot(PmCartesian const *a, PmCartesian const *b, double *out);
int pmCartCartCross(PmCartesian const *a, PmCartesian const *b, PmCartesian *out);
int pmCartCartMult(PmCartesian const *a, PmCartesian const *b, PmCartesian *out); /* by component */
int pmCartCartDisp(PmCartesian const *a, PmCartesian const *b, double *out);      /* |b - a| */
int pmCartCartCompare(PmCartesian const *a, PmCartesian const *b); /* 1: equal within CART_FUZZ */
int pmCartCartProj(PmCartesian const *a, PmCartesian const *onto, PmCartesian *out);
int pmCartPlaneProj(PmCartesian const *a, PmCartesian const *normal, PmCartesian *out);
int pmCartScalMult(PmCartesian const *a, double s, PmCartesian *out);
int pmCartScalDiv(PmCartesian const *a, double s, PmCartesian *out); /* s = 0: zero vector, PM_DIV_ERR */
int pmCartMag(PmCartesian const *a, double *out);
int pmCartMagSq(PmCartesian const *a, double *out);
int pmCartNeg(PmCartesian const *a, PmCartesian *out);
int pmCartInv(PmCartesian const *a, PmCartesian *out);  /* a / |a|^2 */
int pmCartUnit(PmCartesian const *a, PmCartesian *out); /* zero length: zero vector, PM_NORM_ERR */
int pmCartUnitEq(PmCartesian *a);
int pmCartAddEq(PmCartesian *a, PmCartesian const *b);
int pmCartSubEq(PmCartesian *a, PmCartesian const *b);
int pmCartScalMultEq(PmCartesian *a, double s);
int pmCartScalDivEq(PmCartesian *a, double s);
int pmCartNegEq(PmCartesian *a);
int pmCartIsNorm(PmCartesian const *a);
int pmCartAbs(PmCartesian const *a, PmCartesian *out);
int pmCartMin(PmCartesian const *a, double *out); /* smallest component */
int pmCartMax(PmCartesian const *a, double *out); /* largest component */

/* Rotations. Angles in radians. */
int pmRpyMatConvert(PmRpy const *rpy, PmRotationMatrix *m);
int pmMatRpyConvert(PmRotationMatrix const *m, PmRpy *rpy); /* pitch in [-pi/2, pi/2]; yaw 0 where singular */
int pmRpyQuatConvert(PmRpy const *rpy, PmQuaternion *q);
int pmQuatRpyConvert(PmQuaternion const *q, PmRpy *rpy);
int pmQuatMatConvert(PmQuaternion const *q, PmRotationMatrix *m);
int pmMatQuatConvert(PmRotationMatrix const *m, PmQuaternion *q);
int pmQuatRotConvert(PmQuaternion const *q, PmRotationVector *r);
int pmRotQuatConvert(PmRotationVector const *r, PmQuaternion *q);
int pmRotMatConvert(PmRotationVector const *r, PmRotationMatrix *m);
int pmMatRotConvert(PmRotationMatrix const *m, PmRotationVector *r);
int pmZyzMatConvert(PmEulerZyz const *e, PmRotationMatrix *m);
int pmMatZyzConvert(PmRotationMatrix const *m, PmEulerZyz *e);
int pmZyxMatConvert(PmEulerZyx const *e, PmRotationMatrix *m);
int pmMatZyxConvert(PmRotationMatrix const *m, PmEulerZyx *e);
int pmMatCartMult(PmRotationMatrix const *m, PmCartesian const *v, PmCartesian *out);
int pmMatMatMult(PmRotationMatrix const *a, PmRotationMatrix const *b, PmRotationMatrix *out);
int pmMatInv(PmRotationMatrix const *m, PmRotationMatrix *out); /* transpose */
int pmMatNorm(PmRotationMatrix const *m, PmRotationMatrix *out); /* nearest right-handed frame (Gram-Schmidt) */
int pmMatIsNorm(PmRotationMatrix const *m);
int pmQuatQuatMult(PmQuaternion const *a, PmQuaternion const *b, PmQuaternion *out);
int pmQuatCartMult(PmQuaternion const *q, PmCartesian const *v, PmCartesian *out);
int pmQuatInv(PmQuaternion const *q, PmQuaternion *out);
int pmQuatNorm(PmQuaternion const *q, PmQuaternion *out);
int pmQuatIsNorm(PmQuaternion const *q);

/* Poses: a point p of the body is at tran + rot p. */
int pmPosePoseMult(PmPose const *a, PmPose const *b, PmPose *out);
int pmPoseCartMult(PmPose const *p, PmCartesian const *v, PmCartesian *out);
int pmPoseInv(PmPose const *p, PmPose *out);
int pmHomPoseConvert(PmHomogeneous const *h, PmPose *p);
int pmPoseHomConvert(PmPose const *p, PmHomogeneous *h);
int pmHomInv(PmHomogeneous const *h, PmHomogeneous *out);
int pmHomHomMult(PmHomogeneous const *a, PmHomogeneous const *b, PmHomogeneous *out);

/* Coordinates */
int pmSphCartConvert(PmSpherical const *s, PmCartesian *v);
int pmCartSphConvert(PmCartesian const *v, PmSpherical *s);
int pmCylCartConvert(PmCylindrical const *c, PmCartesian *v);
int pmCartCylConvert(PmCartesian const *v, PmCylindrical *c);

/* sqrt that returns 0 for a (rounding) negative argument. */
double pmSqrt(double x);

#ifdef __cplusplus
}
#endif
#endif
