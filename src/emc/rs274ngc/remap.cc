/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * remap.cc - REMAP lines, and the handlers that run in place of codes.
 *
 * Thread: [task]
 * Source: remap sheet
 */
#include "remap.hh"

#include "python_link.hh"
#include "stages.hh"

namespace ngc
{

int load_python(Setup &s, Interp *self)
{
    (void)self;
    (void)s;
    return INTERP_OK;
}

int load_remaps(Setup &s)
{
    (void)s;
    return INTERP_OK;
}

const Remap *remap_of_phase(Setup &s, int phase)
{
    (void)s, (void)phase;
    return nullptr;
}

int start_remap(Setup &s, const Remap &remap)
{
    (void)s, (void)remap;
    return INTERP_OK;
}

void forget_remaps(Setup &s) { (void)s; }

int run_python_line(Setup &s, const char *text)
{
    CHECK(!s.python, "py_execute(%s): Python plugin not initialized", text);
    return s.python->run(s, text, false);
}

} // namespace ngc
