/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * posemath_types.h - plain structs of three-dimensional geometry.
 *
 * Lengths are machine units; angles inside rotation structs are radians.
 */
#ifndef KERF_POSEMATH_TYPES_H
#define KERF_POSEMATH_TYPES_H

typedef struct PmCartesian { double x, y, z; } PmCartesian;
typedef struct PmSpherical { double theta, phi, r; } PmSpherical;      /* phi from +z */
typedef struct PmCylindrical { double theta, r, z; } PmCylindrical;
typedef struct PmRotationVector { double s, x, y, z; } PmRotationVector; /* angle s about unit (x,y,z) */
typedef struct PmRotationMatrix { PmCartesian x, y, z; } PmRotationMatrix; /* columns */
typedef struct PmQuaternion { double s, x, y, z; } PmQuaternion;       /* unit, s >= 0 */
typedef struct PmEulerZyz { double z, y, zp; } PmEulerZyz;
typedef struct PmEulerZyx { double z, y, x; } PmEulerZyx;
typedef struct PmRpy { double r, p, y; } PmRpy;                        /* R = Rz(y) Ry(p) Rx(r) */
typedef struct PmPose { PmCartesian tran; PmQuaternion rot; } PmPose;
typedef struct PmHomogeneous { PmCartesian tran; PmRotationMatrix rot; } PmHomogeneous;

#endif
