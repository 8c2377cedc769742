// SPDX-License-Identifier: GPL-2.0-or-later
//
// rotarydeltakins.cc - Python module rotarydeltakins: geometry of a rotary delta. [any]
#include <pybind11/pybind11.h>
#include "../rotarydelta.h"

namespace py = pybind11;

static rotarydelta geometry = {ROTARYDELTA_PFR, ROTARYDELTA_TL, ROTARYDELTA_SL, ROTARYDELTA_FR};

PYBIND11_MODULE(rotarydeltakins, m)
{
    m.doc() = "Kinematics of a rotary delta robot; lengths in machine units, joints in degrees.";
    m.def("set_geometry", [](double pfr, double tl, double sl, double fr) { geometry = {pfr, tl, sl, fr}; },
          py::arg("pfr"), py::arg("tl"), py::arg("sl"), py::arg("fr"));
    m.def("get_geometry", [] { return py::make_tuple(geometry.pfr, geometry.tl, geometry.sl, geometry.fr); });
    m.def("forward", [](double j0, double j1, double j2) -> py::object {
        double q[3] = {j0, j1, j2}, p[3];
        if (rotarydelta_forward(&geometry, q, p) != 0) return py::none();
        return py::make_tuple(p[0], p[1], p[2]);
    }, "(x, y, z) of three thighs, None out of reach");
    m.def("inverse", [](double x, double y, double z) -> py::object {
        double p[3] = {x, y, z}, q[3];
        if (rotarydelta_inverse(&geometry, p, q) != 0) return py::none();
        return py::make_tuple(q[0], q[1], q[2]);
    }, "three thighs of (x, y, z), None out of reach");
}
