// SPDX-License-Identifier: GPL-2.0-or-later
//
// posemath.hh - operators on the structs of posemath.h for C++.
#ifndef KERF_POSEMATH_HH
#define KERF_POSEMATH_HH

#include "posemath.h"

inline PmCartesian operator+(PmCartesian a, PmCartesian b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline PmCartesian operator-(PmCartesian a, PmCartesian b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline PmCartesian operator-(PmCartesian a) { return {-a.x, -a.y, -a.z}; }
inline PmCartesian operator*(PmCartesian a, double s) { return {a.x * s, a.y * s, a.z * s}; }
inline PmCartesian operator*(double s, PmCartesian a) { return a * s; }
inline PmCartesian operator/(PmCartesian a, double s) { return {a.x / s, a.y / s, a.z / s}; }
inline bool operator==(PmCartesian a, PmCartesian b) { return pmCartCartCompare(&a, &b) != 0; }
inline bool operator!=(PmCartesian a, PmCartesian b) { return !(a == b); }
inline double dot(PmCartesian a, PmCartesian b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline PmCartesian cross(PmCartesian a, PmCartesian b) { PmCartesian r; pmCartCartCross(&a, &b, &r); return r; }
inline double mag(PmCartesian a) { double m; pmCartMag(&a, &m); return m; }

#endif
