// SPDX-License-Identifier: GPL-2.0-or-later
//
// module.hh - what the parts of the Python module share.
#ifndef KERF_LINUXCNC_MODULE_HH
#define KERF_LINUXCNC_MODULE_HH

#include <pybind11/pybind11.h>

#include <memory>
#include <string>

#include "messages.hh"

struct __attribute__((visibility("hidden"))) Stat {
    explicit Stat(const std::string &nmlfile);
    std::unique_ptr<NML> channel;
    EMC_STAT data;
    bool polled = false;
};

extern PyObject *linuxcnc_error;                    // exception linuxcnc.error
[[noreturn]] void raise_error(const std::string &text);
std::string path_of(const pybind11::handle &name);  // str, bytes or os.PathLike; else TypeError
std::string nml_file();                             // linuxcnc.nmlfile; "" when it is None

void define_ini(pybind11::module_ &m);
void define_positionlogger(pybind11::module_ &m);

#endif
