/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * py_interp.hh - the interpreter as Python sees it: `self` of every handler.
 *
 * Source: remap sheet, section 8
 */
#ifndef KERF_PY_INTERP_HH
#define KERF_PY_INTERP_HH

#include <pybind11/embed.h>

#include "remap.hh"
#include "setup.hh"

namespace ngc
{

/// Outlives the interpreter if Python keeps it; then every use raises RuntimeError.
struct PyInterp {
    Setup *setup = nullptr;
    Interp *interp = nullptr;
    Setup &get() const
    {
        if (!setup) throw std::runtime_error("this interpreter no longer exists");
        return *setup;
    }
};

/// Makes the modules `interpreter` and `emccanon` importable; once in a process.
void install_modules();
void bind_interpreter(pybind11::module_ &m);
void bind_canon(pybind11::module_ &m);
/// The interpreter whose handler runs: emccanon's functions go to its canon.
Setup *&current_setup();

} // namespace ngc

#endif
