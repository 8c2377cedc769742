// SPDX-License-Identifier: GPL-2.0-or-later
//
// values.h - HAL values to Python objects and back, with the documented rules.
//
// Thread: the interpreter's. from_python may run Python code: never call it with
// the HAL lock held.
#pragma once

#include <pybind11/pybind11.h>
#include <string>
#include "hal.h"

namespace halpy {
namespace py = pybind11;

// A name or text of HAL, which need not be valid UTF-8.
py::object text(const char *s);

// `bit float s32 ...` in capitals, `IN OUT ...`, for representations.
const char *type_word(hal_type_t type);
const char *dir_word(hal_pdir_t dir);

py::object to_python(hal_query_value_u value, hal_type_t type);
// Throws the documented exception; `what` (pin 'x') goes into a note on it.
hal_query_value_u from_python(py::handle value, hal_type_t type, const std::string &what);

// One atomic access of a cell of 8 bytes.
hal_query_value_u cell_get(const void *cell, hal_type_t type);
void cell_set(void *cell, hal_type_t type, hal_query_value_u value);
}
