/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * callbacks.hh - gcode.parse(): a canon written in Python.
 *
 * Source: preview sheet, sections 1 to 3
 */
#ifndef KERF_CALLBACKS_HH
#define KERF_CALLBACKS_HH

#include <pybind11/pybind11.h>
#include <pybind11/stl/filesystem.h>

#include <string>
#include <vector>

/// The state given to next_line(): active codes before the line.
struct LineCode {
    int g[17];
    int m[10];
    double settings[5];
};

/// Returns (result, last line). Raises what the documentation says.
pybind11::tuple parse_with_callbacks(const std::string &file, pybind11::object canon,
                                     const std::vector<std::string> &init_codes, const std::string &interpreter);
/// Text of the last parse's error.
std::string last_error(int code);

#endif
