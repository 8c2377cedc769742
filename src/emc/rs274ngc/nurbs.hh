/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * nurbs.hh - control points collected by G5.2 and G6.2.
 */
#ifndef KERF_NURBS_HH
#define KERF_NURBS_HH

#include <vector>

#include "setup.hh"

namespace ngc
{

struct Nurbs {
    // G5.2 ... G5.3
    std::vector<NURBS_CONTROL_POINT> points;
    unsigned order = 3;
    // G6.2
    std::vector<NURBS_G6_CONTROL_POINT> g6_points;
    unsigned g6_order = 0;
    int g6_option = 0;
    double weight = 0, knot = -1; // last R and K words
    bool have_weight = false;
};

} // namespace ngc

#endif
