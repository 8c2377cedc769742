/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * plugin.cc - interpreters of other languages, from libraries ([TASK]INTERPRETER, rs274 -p).
 *
 * Thread: [task]
 */
#include <dlfcn.h>

#include "interp.hh"
#include "kerf_paths.h"

std::string interpreter_path(const std::string &library)
{
    return library[0] == '/' ? library : std::string(kerf_path(KERF_PATH_LIB)) + "/linuxcnc/" + library;
}

std::unique_ptr<Interp> make_interpreter(const std::string &library, Canon &canon, std::string *why)
{
    if (library.empty()) return std::make_unique<Interp>(canon);
    const std::string path = interpreter_path(library);
    void *handle = dlopen(path.c_str(), RTLD_NOW); // stays: what it has made may live on
    if (!handle) {
        *why = "could not open interpreter '" + path + "': " + dlerror();
        return nullptr;
    }
    auto make = reinterpret_cast<makeInterp_t>(dlsym(handle, "makeInterp"));
    std::unique_ptr<Interp> made(make ? make(canon) : nullptr);
    if (!made) *why = "could not get makeInterp from interpreter '" + path + "'";
    return made;
}
