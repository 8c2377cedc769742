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
    /// True when module.name is callable ("oword", "remap"; "" is __main__).
    virtual bool callable(const char *module, const std::string &name) = 0;
    /// Calls module.name(self, ...) for the block being executed; may return INTERP_EXECUTE_FINISH.
    virtual int call_handler(Setup &s, const char *module, const std::string &name) = 0;
    /// Runs statements (file false) or a file in __main__.
    virtual int run(Setup &s, const char *text, bool file) = 0;
    virtual int reload(Setup &s) = 0;
    /// Value of a namedparams function.
    virtual int named_value(Setup &s, const std::string &name, double *value) = 0;
    /// __init__ and export of named parameters; first init only.
    virtual int first_init(Setup &s) = 0;
    virtual void at_exit(Setup &s) = 0;
};

/// Entry of the plugin library: nullptr when its configuration failed (messages are out).
typedef PythonLink *(*make_python_link_t)(Setup &s, Interp *self);

/// Loads the plugin when the INI asks for it (remap.cc).
[[nodiscard]] int load_python(Setup &s, Interp *self);

} // namespace ngc

#endif
