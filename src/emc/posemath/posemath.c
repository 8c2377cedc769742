/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * posemath.c - vectors, rotations and poses.
 *
 * In, out: posemath.h   Thread: any
 * Method:  textbook linear algebra; rotation matrices are stored by columns,
 *          quaternions after Shepperd 1978 (largest component first).
 */
#include <math.h>
#include "posemath.h"

static PmCartesian cart(double x, double y, double z)
{
    PmCartesian v = {x, y, z};
    return v;
}

static double dot(PmCartesian const *a, PmCartesian const *b)
{
    return a->x * b->x + a->y * b->y + a->z * b->z;
}

double pmSqrt(double x) { return x > 0.0 ? sqrt(x) : 0.0; }

int pmCartCartAdd(PmCartesian const *a, PmCartesian const *b, PmCartesian *out)
{
    *out = cart(a->x + b->x, a->y + b->y, a->z + b->z);
    return PM_OK;
}

int pmCartCartSub(PmCartesian const *a, PmCartesian const *b, PmCartesian *out)
{
    *out = cart(a->x - b->x, a->y - b->y, a->z - b->z);
    return PM_OK;
}

int pmCartCartDot(PmCartesian const *a, PmCartesian const *b, double *out)
{
    *out = dot(a, b);
    return PM_OK;
}

int pmCartCartCross(PmCartesian const *a, PmCartesian const *b, PmCartesian *out)
{
    *out = cart(a->y * b->z - a->z * b->y, a->z * b->x - a->x * b->z, a->x * b->y - a->y * b->x);
    return PM_OK;
}

int pmCartCartMult(PmCartesian const *a, PmCartesian const *b, PmCartesian *out)
{
    *out = cart(a->x * b->x, a->y * b->y, a->z * b->z);
    return PM_OK;
}

int pmCartCartDisp(PmCartesian const *a, PmCartesian const *b, double *out)
{
    PmCartesian d = cart(b->x - a->x, b->y - a->y, b->z - a->z);
    return pmCartMag(&d, out);
}

int pmCartCartCompare(PmCartesian const *a, PmCartesian const *b)
{
    return fabs(a->x - b->x) < CART_FUZZ && fabs(a->y - b->y) < CART_FUZZ && fabs(a->z - b->z) < CART_FUZZ;
}

int pmCartCartProj(PmCartesian const *a, PmCartesian const *onto, PmCartesian *out)
{
    double n2 = dot(onto, onto);
    if (n2 <= 0.0) {
        *out = cart(0, 0, 0);
        return PM_NORM_ERR;
    }
    return pmCartScalMult(onto, dot(a, onto) / n2, out);
}

int pmCartPlaneProj(PmCartesian const *a, PmCartesian const *normal, PmCartesian *out)
{
    PmCartesian along;
    int r = pmCartCartProj(a, normal, &along);
    pmCartCartSub(a, &along, out);
    return r;
}

int pmCartScalMult(PmCartesian const *a, double s, PmCartesian *out)
{
    *out = cart(a->x * s, a->y * s, a->z * s);
    return PM_OK;
}

int pmCartScalDiv(PmCartesian const *a, double s, PmCartesian *out)
{
    if (s == 0.0) {
        *out = cart(0, 0, 0);
        return PM_DIV_ERR;
    }
    *out = cart(a->x / s, a->y / s, a->z / s);
    return PM_OK;
}

int pmCartMag(PmCartesian const *a, double *out)
{
    *out = sqrt(dot(a, a));
    return PM_OK;
}

int pmCartMagSq(PmCartesian const *a, double *out)
{
    *out = dot(a, a);
    return PM_OK;
}

int pmCartNeg(PmCartesian const *a, PmCartesian *out) { return pmCartScalMult(a, -1.0, out); }

int pmCartInv(PmCartesian const *a, PmCartesian *out)
{
    double n2 = dot(a, a);
    return pmCartScalDiv(a, n2, out) == PM_OK ? PM_OK : PM_NORM_ERR;
}

int pmCartUnit(PmCartesian const *a, PmCartesian *out)
{
    double n = sqrt(dot(a, a));
    return pmCartScalDiv(a, n, out) == PM_OK ? PM_OK : PM_NORM_ERR;
}

int pmCartUnitEq(PmCartesian *a) { return pmCartUnit(a, a); }
int pmCartAddEq(PmCartesian *a, PmCartesian const *b) { return pmCartCartAdd(a, b, a); }
int pmCartSubEq(PmCartesian *a, PmCartesian const *b) { return pmCartCartSub(a, b, a); }
int pmCartScalMultEq(PmCartesian *a, double s) { return pmCartScalMult(a, s, a); }
int pmCartScalDivEq(PmCartesian *a, double s) { return pmCartScalDiv(a, s, a); }
int pmCartNegEq(PmCartesian *a) { return pmCartNeg(a, a); }
int pmCartIsNorm(PmCartesian const *a) { return fabs(sqrt(dot(a, a)) - 1.0) < UNIT_VEC_FUZZ; }

int pmCartAbs(PmCartesian const *a, PmCartesian *out)
{
    *out = cart(fabs(a->x), fabs(a->y), fabs(a->z));
    return PM_OK;
}

int pmCartMin(PmCartesian const *a, double *out)
{
    *out = fmin(a->x, fmin(a->y, a->z));
    return PM_OK;
}

int pmCartMax(PmCartesian const *a, double *out)
{
    *out = fmax(a->x, fmax(a->y, a->z));
    return PM_OK;
}

int pmRpyMatConvert(PmRpy const *rpy, PmRotationMatrix *m)
{
    double sr = sin(rpy->r), cr = cos(rpy->r), sp = sin(rpy->p), cp = cos(rpy->p);
    double sy = sin(rpy->y), cy = cos(rpy->y);
    m->x = cart(cp * cy, cp * sy, -sp);
    m->y = cart(sr * sp * cy - cr * sy, sr * sp * sy + cr * cy, sr * cp);
    m->z = cart(cr * sp * cy + sr * sy, cr * sp * sy - sr * cy, cr * cp);
    return PM_OK;
}

int pmMatRpyConvert(PmRotationMatrix const *m, PmRpy *rpy)
{
    double cp = sqrt(m->x.x * m->x.x + m->x.y * m->x.y);
    rpy->p = atan2(-m->x.z, cp);
    if (cp > 1e-9) { /* 1e-9 rad: where roll and yaw can still be told apart */
        rpy->r = atan2(m->y.z, m->z.z);
        rpy->y = atan2(m->x.y, m->x.x);
    } else {
        rpy->r = m->x.z < 0 ? atan2(m->y.x, m->y.y) : -atan2(m->y.x, m->y.y);
        rpy->y = 0.0;
    }
    return PM_OK;
}

int pmRpyQuatConvert(PmRpy const *rpy, PmQuaternion *q)
{
    PmRotationMatrix m;
    pmRpyMatConvert(rpy, &m);
    return pmMatQuatConvert(&m, q);
}

int pmQuatRpyConvert(PmQuaternion const *q, PmRpy *rpy)
{
    PmRotationMatrix m;
    int r = pmQuatMatConvert(q, &m);
    pmMatRpyConvert(&m, rpy);
    return r;
}

int pmQuatMatConvert(PmQuaternion const *q, PmRotationMatrix *m)
{
    double s = q->s, x = q->x, y = q->y, z = q->z;
    m->x = cart(1 - 2 * (y * y + z * z), 2 * (x * y + s * z), 2 * (x * z - s * y));
    m->y = cart(2 * (x * y - s * z), 1 - 2 * (x * x + z * z), 2 * (y * z + s * x));
    m->z = cart(2 * (x * z + s * y), 2 * (y * z - s * x), 1 - 2 * (x * x + y * y));
    return pmQuatIsNorm(q) ? PM_OK : PM_NORM_ERR;
}

int pmMatQuatConvert(PmRotationMatrix const *m, PmQuaternion *q)
{
    double xx = m->x.x, yy = m->y.y, zz = m->z.z, t = xx + yy + zz;
    PmQuaternion r;
    if (t >= xx && t >= yy && t >= zz) {
        double s = 0.5 * sqrt(fmax(0.0, 1 + t));
        r.s = s;
        r.x = (m->y.z - m->z.y) / (4 * s);
        r.y = (m->z.x - m->x.z) / (4 * s);
        r.z = (m->x.y - m->y.x) / (4 * s);
    } else if (xx >= yy && xx >= zz) {
        double x = 0.5 * sqrt(fmax(0.0, 1 + xx - yy - zz));
        r.x = x;
        r.s = (m->y.z - m->z.y) / (4 * x);
        r.y = (m->x.y + m->y.x) / (4 * x);
        r.z = (m->x.z + m->z.x) / (4 * x);
    } else if (yy >= zz) {
        double y = 0.5 * sqrt(fmax(0.0, 1 + yy - xx - zz));
        r.y = y;
        r.s = (m->z.x - m->x.z) / (4 * y);
        r.x = (m->x.y + m->y.x) / (4 * y);
        r.z = (m->y.z + m->z.y) / (4 * y);
    } else {
        double z = 0.5 * sqrt(fmax(0.0, 1 + zz - xx - yy));
        r.z = z;
        r.s = (m->x.y - m->y.x) / (4 * z);
        r.x = (m->x.z + m->z.x) / (4 * z);
        r.y = (m->y.z + m->z.y) / (4 * z);
    }
    return pmQuatNorm(&r, q);
}

int pmQuatRotConvert(PmQuaternion const *q, PmRotationVector *r)
{
    double n = sqrt(q->x * q->x + q->y * q->y + q->z * q->z);
    if (n < 1e-150) { /* below it the direction underflows */
        r->s = 0.0;
        r->x = 1.0;
        r->y = r->z = 0.0;
        return PM_OK;
    }
    r->s = 2.0 * atan2(n, q->s);
    r->x = q->x / n;
    r->y = q->y / n;
    r->z = q->z / n;
    return PM_OK;
}

int pmRotQuatConvert(PmRotationVector const *r, PmQuaternion *q)
{
    double n = sqrt(r->x * r->x + r->y * r->y + r->z * r->z), h = 0.5 * r->s;
    if (n <= 0.0) {
        q->s = 1.0;
        q->x = q->y = q->z = 0.0;
        return fabs(r->s) < Q_FUZZ ? PM_OK : PM_NORM_ERR;
    }
    q->s = cos(h);
    q->x = sin(h) * r->x / n;
    q->y = sin(h) * r->y / n;
    q->z = sin(h) * r->z / n;
    return pmQuatNorm(q, q);
}

int pmRotMatConvert(PmRotationVector const *r, PmRotationMatrix *m)
{
    PmQuaternion q;
    int e = pmRotQuatConvert(r, &q);
    pmQuatMatConvert(&q, m);
    return e;
}

int pmMatRotConvert(PmRotationMatrix const *m, PmRotationVector *r)
{
    PmQuaternion q;
    pmMatQuatConvert(m, &q);
    return pmQuatRotConvert(&q, r);
}

static PmRotationMatrix turn_y(double a)
{
    PmRotationMatrix m = {{cos(a), 0, -sin(a)}, {0, 1, 0}, {sin(a), 0, cos(a)}};
    return m;
}

static PmRotationMatrix turn_z(double a)
{
    PmRotationMatrix m = {{cos(a), sin(a), 0}, {-sin(a), cos(a), 0}, {0, 0, 1}};
    return m;
}

int pmZyzMatConvert(PmEulerZyz const *e, PmRotationMatrix *m)
{
    PmRotationMatrix a = turn_z(e->z), b = turn_y(e->y), c = turn_z(e->zp);
    pmMatMatMult(&a, &b, m);
    return pmMatMatMult(m, &c, m);
}

int pmMatZyzConvert(PmRotationMatrix const *m, PmEulerZyz *e)
{
    double s = sqrt(m->z.x * m->z.x + m->z.y * m->z.y);
    e->y = atan2(s, m->z.z);
    if (s > 1e-9) {
        e->z = atan2(m->z.y, m->z.x);
        e->zp = atan2(m->y.z, -m->x.z);
    } else {
        e->z = 0.0;
        e->zp = m->z.z > 0 ? atan2(m->x.y, m->x.x) : atan2(m->x.y, -m->x.x);
    }
    return PM_OK;
}

int pmZyxMatConvert(PmEulerZyx const *e, PmRotationMatrix *m)
{
    PmRpy rpy = {e->x, e->y, e->z};
    return pmRpyMatConvert(&rpy, m);
}

int pmMatZyxConvert(PmRotationMatrix const *m, PmEulerZyx *e)
{
    PmRpy rpy;
    int r = pmMatRpyConvert(m, &rpy);
    e->z = rpy.y;
    e->y = rpy.p;
    e->x = rpy.r;
    return r;
}

int pmMatCartMult(PmRotationMatrix const *m, PmCartesian const *v, PmCartesian *out)
{
    *out = cart(m->x.x * v->x + m->y.x * v->y + m->z.x * v->z,
                m->x.y * v->x + m->y.y * v->y + m->z.y * v->z,
                m->x.z * v->x + m->y.z * v->y + m->z.z * v->z);
    return PM_OK;
}

int pmMatMatMult(PmRotationMatrix const *a, PmRotationMatrix const *b, PmRotationMatrix *out)
{
    PmRotationMatrix r;
    pmMatCartMult(a, &b->x, &r.x);
    pmMatCartMult(a, &b->y, &r.y);
    pmMatCartMult(a, &b->z, &r.z);
    *out = r;
    return PM_OK;
}

int pmMatInv(PmRotationMatrix const *m, PmRotationMatrix *out)
{
    PmRotationMatrix t = {{m->x.x, m->y.x, m->z.x}, {m->x.y, m->y.y, m->z.y}, {m->x.z, m->y.z, m->z.z}};
    *out = t;
    return PM_OK;
}

int pmMatNorm(PmRotationMatrix const *m, PmRotationMatrix *out)
{
    PmRotationMatrix r;
    double d;
    if (pmCartUnit(&m->x, &r.x) != PM_OK)
        return PM_NORM_ERR;
    d = dot(&m->y, &r.x);
    r.y = cart(m->y.x - d * r.x.x, m->y.y - d * r.x.y, m->y.z - d * r.x.z);
    if (pmCartUnitEq(&r.y) != PM_OK)
        return PM_NORM_ERR;
    pmCartCartCross(&r.x, &r.y, &r.z);
    *out = r;
    return PM_OK;
}

int pmMatIsNorm(PmRotationMatrix const *m)
{
    PmCartesian z;
    pmCartCartCross(&m->x, &m->y, &z);
    return pmCartIsNorm(&m->x) && pmCartIsNorm(&m->y) && fabs(z.x - m->z.x) < UNIT_VEC_FUZZ &&
           fabs(z.y - m->z.y) < UNIT_VEC_FUZZ && fabs(z.z - m->z.z) < UNIT_VEC_FUZZ &&
           fabs(dot(&m->x, &m->y)) < UNIT_VEC_FUZZ;
}

int pmQuatQuatMult(PmQuaternion const *a, PmQuaternion const *b, PmQuaternion *out)
{
    PmQuaternion r = {a->s * b->s - a->x * b->x - a->y * b->y - a->z * b->z,
                      a->s * b->x + b->s * a->x + a->y * b->z - a->z * b->y,
                      a->s * b->y + b->s * a->y + a->z * b->x - a->x * b->z,
                      a->s * b->z + b->s * a->z + a->x * b->y - a->y * b->x};
    return pmQuatNorm(&r, out);
}

int pmQuatCartMult(PmQuaternion const *q, PmCartesian const *v, PmCartesian *out)
{
    PmRotationMatrix m;
    int r = pmQuatMatConvert(q, &m);
    pmMatCartMult(&m, v, out);
    return r;
}

int pmQuatInv(PmQuaternion const *q, PmQuaternion *out)
{
    PmQuaternion r = {q->s, -q->x, -q->y, -q->z};
    *out = r;
    return pmQuatIsNorm(q) ? PM_OK : PM_NORM_ERR;
}

int pmQuatNorm(PmQuaternion const *q, PmQuaternion *out)
{
    double n = sqrt(q->s * q->s + q->x * q->x + q->y * q->y + q->z * q->z);
    if (n <= 0.0) {
        PmQuaternion one = {1, 0, 0, 0};
        *out = one;
        return PM_NORM_ERR;
    }
    if (q->s < 0)
        n = -n;
    PmQuaternion r = {q->s / n, q->x / n, q->y / n, q->z / n};
    *out = r;
    return PM_OK;
}

int pmQuatIsNorm(PmQuaternion const *q)
{
    return fabs(sqrt(q->s * q->s + q->x * q->x + q->y * q->y + q->z * q->z) - 1.0) < UNIT_VEC_FUZZ;
}

int pmPosePoseMult(PmPose const *a, PmPose const *b, PmPose *out)
{
    PmPose r;
    pmPoseCartMult(a, &b->tran, &r.tran);
    int e = pmQuatQuatMult(&a->rot, &b->rot, &r.rot);
    *out = r;
    return e;
}

int pmPoseCartMult(PmPose const *p, PmCartesian const *v, PmCartesian *out)
{
    PmCartesian r;
    int e = pmQuatCartMult(&p->rot, v, &r);
    pmCartCartAdd(&p->tran, &r, out);
    return e;
}

int pmPoseInv(PmPose const *p, PmPose *out)
{
    PmPose r;
    int e = pmQuatInv(&p->rot, &r.rot);
    pmQuatCartMult(&r.rot, &p->tran, &r.tran);
    pmCartNegEq(&r.tran);
    *out = r;
    return e;
}

int pmHomPoseConvert(PmHomogeneous const *h, PmPose *p)
{
    p->tran = h->tran;
    return pmMatQuatConvert(&h->rot, &p->rot);
}

int pmPoseHomConvert(PmPose const *p, PmHomogeneous *h)
{
    h->tran = p->tran;
    return pmQuatMatConvert(&p->rot, &h->rot);
}

int pmHomInv(PmHomogeneous const *h, PmHomogeneous *out)
{
    PmHomogeneous r;
    pmMatInv(&h->rot, &r.rot);
    pmMatCartMult(&r.rot, &h->tran, &r.tran);
    pmCartNegEq(&r.tran);
    *out = r;
    return pmMatIsNorm(&h->rot) ? PM_OK : PM_NORM_ERR;
}

int pmHomHomMult(PmHomogeneous const *a, PmHomogeneous const *b, PmHomogeneous *out)
{
    PmHomogeneous r;
    pmMatCartMult(&a->rot, &b->tran, &r.tran);
    pmCartAddEq(&r.tran, &a->tran);
    pmMatMatMult(&a->rot, &b->rot, &r.rot);
    *out = r;
    return PM_OK;
}

int pmSphCartConvert(PmSpherical const *s, PmCartesian *v)
{
    double p = s->r * sin(s->phi);
    *v = cart(p * cos(s->theta), p * sin(s->theta), s->r * cos(s->phi));
    return PM_OK;
}

int pmCartSphConvert(PmCartesian const *v, PmSpherical *s)
{
    double p = sqrt(v->x * v->x + v->y * v->y);
    PmSpherical r = {atan2(v->y, v->x), atan2(p, v->z), sqrt(p * p + v->z * v->z)};
    *s = r;
    return PM_OK;
}

int pmCylCartConvert(PmCylindrical const *c, PmCartesian *v)
{
    *v = cart(c->r * cos(c->theta), c->r * sin(c->theta), c->z);
    return PM_OK;
}

int pmCartCylConvert(PmCartesian const *v, PmCylindrical *c)
{
    PmCylindrical r = {atan2(v->y, v->x), sqrt(v->x * v->x + v->y * v->y), v->z};
    *c = r;
    return PM_OK;
}
