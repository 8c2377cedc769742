/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * g7x.cc - lathe contour cycles.
 */
#include "stages.hh"
namespace ngc
{
int convert_g7x(Setup &s, int g)
{
    (void)g;
    FAIL("Bug unknown motion code");
}
} // namespace ngc
