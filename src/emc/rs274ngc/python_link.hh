/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * python_link.hh - what the interpreter asks of the Python plugin.
 *
 * The plugin is a library of its own, loaded only when an INI has [PYTHON]TOPLEVEL;
 * without it the interpreter needs no Python.
 * Source: remap sheet
 */
#ifndef KERF_PYTHON_LINK_HH
#define KERF_PYTHON_LINK_HH

#include <memory>
#include <string>

#include "setup.hh"

namespace ngc
{

struct PythonLink {
    virtual ~PythonLink() = default;
    /// True when module.name is callable ("oword", "remap").
    virtual bool callable(const char *module, const std::string &name) = 0;
    /// Calls remap.name(self, **words). INTERP_EXECUTE_FINISH: it waits, see resume().
    virtual int call_remap(Setup &s, const std::string &name, const RemapFrame &frame) = 0;
    /// Calls oword.name(self, *params) and takes its value.
    virtual int call_oword(Setup &s, const std::string &name, const double *params, int count) = 0;
    /// Call level of the handler that waits, -1 when none does.
    virtual int waiting_level() const = 0;
    /// Goes on with the handler that waits. *oword: it was an O-word sub.
    virtual int resume(Setup &s, bool *oword) = 0;
    virtual void forget_waiting() = 0;
    /// Runs statements (file false) or a file in __main__.
    virtual int run(Setup &s, const char *text, bool file) = 0;
    virtual int reload(Setup &s) = 0;
    /// Value of a namedparams function.
    virtual int named_value(Setup &s, const std::string &name, double *value) = 0;
    /// __init__ and export of named parameters; first init only.
    virtual int first_init(Setup &s) = 0;
    /// Paths and TOPLEVEL, at every init. A documented status: < 0 unusable.
    virtual int configure(Setup &s) = 0;
    virtual void at_exit(Setup &s) = 0;
};

/// Entry of the plugin library, "kerf_make_python_link".
typedef PythonLink *(*make_python_link_t)(Setup &s, Interp *self);

/// Loads the plugin when the INI asks for it (remap.cc).
[[nodiscard]] int load_python(Setup &s, Interp *self);

} // namespace ngc

#endif
