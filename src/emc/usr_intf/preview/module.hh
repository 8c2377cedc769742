// SPDX-License-Identifier: GPL-2.0-or-later
// The parts of the Python module kerf_raster.
#ifndef KERF_PREVIEW_MODULE_HH
#define KERF_PREVIEW_MODULE_HH

#include <pybind11/pybind11.h>

void bind_drawing(pybind11::module_ &m);

#endif
