// SPDX-License-Identifier: GPL-2.0-or-later
//
// lineardeltakins.cc - Python module lineardeltakins: geometry of a linear delta. [any]
#include <pybind11/pybind11.h>
#include "../lineardelta.h"

namespace py = pybind11;

static lineardelta geometry = {LINEARDELTA_R, LINEARDELTA_L};

PYBIND11_MODULE(lineardeltakins, m)
{
    m.doc() = "Kinematics of a linear delta robot; lengths in machine units.";
    m.def("set_geometry", [](double r, double l) { geometry = {r, l}; }, py::arg("r"), py::arg("l"));
    m.def("get_geometry", [] { return py::make_tuple(geometry.R, geometry.L); });
    m.def("forward", [](double j0, double j1, double j2) -> py::object {
        double q[3] = {j0, j1, j2}, p[3];
        if (lineardelta_forward(&geometry, q, p) != 0) return py::none();
        return py::make_tuple(p[0], p[1], p[2]);
    }, "(x, y, z) of three carriages, None out of reach");
    m.def("inverse", [](double x, double y, double z) -> py::object {
        double p[3] = {x, y, z}, q[3];
        if (lineardelta_inverse(&geometry, p, q) != 0) return py::none();
        return py::make_tuple(q[0], q[1], q[2]);
    }, "three carriages of (x, y, z), None out of reach");
}
