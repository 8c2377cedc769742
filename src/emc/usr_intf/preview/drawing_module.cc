// SPDX-License-Identifier: GPL-2.0-or-later
// Class Drawing of the Python module kerf_raster.
#include "drawing.hh"
#include "module.hh"

#include <pybind11/stl.h>

#include <memory>

namespace py = pybind11;
using namespace kerf;

namespace {

/// Checks a buffer's shape (width 9: rows of up to nine; 0: a list); `what` names it in the error.
py::buffer_info rows(const py::buffer &b, const char *what, const char *format, int width)
{
    py::buffer_info info = b.request();
    const bool shape = width ? info.ndim == 2 && info.shape[1] >= 3 && info.shape[1] <= width &&
                                   info.strides[0] == info.shape[1] * info.itemsize
                             : info.ndim == 1;
    if (!shape || info.format != format || info.strides[info.ndim - 1] != info.itemsize)
        throw py::value_error(std::string(what) + " must be an unbroken array of the documented type");
    return info;
}

std::shared_ptr<Drawing> make(const py::buffer &points, const py::buffer &kinds, const py::buffer &lines,
                              const std::string &geometry, const std::vector<double> &offset,
                              const std::string &coordinates, int plane, double plane_z) {
    const py::buffer_info p = rows(points, "points", "f", 9), k = rows(kinds, "kinds", "B", 0),
                          l = rows(lines, "lines", "i", 0);
    if (p.shape[0] != k.shape[0] || p.shape[0] != l.shape[0])
        throw py::value_error("points, kinds and lines must have the same length");
    Placement placement{geometry, {}, coordinates, plane, plane_z};
    for (size_t i = 0; i < placement.offset.size() && i < offset.size(); ++i) placement.offset[i] = offset[i];
    py::gil_scoped_release release;
    return std::make_shared<Drawing>(static_cast<const float *>(p.ptr), static_cast<const uint8_t *>(k.ptr),
                                     static_cast<const int32_t *>(l.ptr), size_t(p.shape[0]), size_t(p.shape[1]),
                                     placement);
}

template <class T> py::memoryview view(const Row<T> &data, const char *format, py::ssize_t width)
{
    const py::ssize_t item = sizeof(T), n = py::ssize_t(data.size());
    T *at = const_cast<T *>(data.data());
    static T nothing{};
    if (!at) at = &nothing;
    if (width) return py::memoryview::from_buffer(at, item, format, {n / width, width}, {width * item, item}, true);
    return py::memoryview::from_buffer(at, item, format, {n}, {item}, true);
}

} // namespace

void bind_drawing(py::module_ &m)
{
    py::class_<Drawing, std::shared_ptr<Drawing>>(
        m, "Drawing",
        "A program's path made ready to be drawn: points in space (inches) and levels of detail.\n\n"
        "vertices (N x 3 float32), kinds (N uint8), lines (N int32). Level k is a list of vertex numbers\n"
        "that is never further from the path than tolerance(k). The views live as long as the drawing.")
        .def(py::init(&make), py::arg("points"), py::arg("kinds"), py::arg("lines"), py::arg("geometry") = "XYZABCUVW",
             py::arg("offset") = std::vector<double>(), py::arg("coordinates") = "XYZABCUVW", py::arg("plane") = -1,
             py::arg("plane_z") = 0.0,
             "points: N x 9 (or the first 3 or more columns, the others zero) float32 (inches, degrees); plane 0 or 1: "
             "XY or UV of a foam cutter at height plane_z.")
        .def("write", &Drawing::write, py::arg("fd"), py::call_guard<py::gil_scoped_release>(),
             "Into a file, for mapped() in another process.")
        .def_static(
            "mapped",
            [](int fd) {
                py::gil_scoped_release release;
                return std::make_shared<Drawing>(std::make_unique<MappedFile>(fd));
            },
            py::arg("fd"),
            "The drawing that a file holds; it stays there (the descriptor may be closed). RuntimeError when it is not "
            "complete.")
        .def_property_readonly(
            "vertices", [](const Drawing &d) { return view(d.xyz(), "f", 3); }, py::keep_alive<0, 1>())
        .def_property_readonly(
            "kinds", [](const Drawing &d) { return view(d.kinds(), "B", 0); }, py::keep_alive<0, 1>())
        .def_property_readonly(
            "lines", [](const Drawing &d) { return view(d.lines(), "i", 0); }, py::keep_alive<0, 1>())
        .def_property_readonly("levels", [](const Drawing &d) { return d.levels().size(); })
        .def(
            "tolerance", [](const Drawing &d, size_t k) { return d.levels().at(k).tolerance; }, py::arg("level"),
            "Inches.")
        .def(
            "index", [](const Drawing &d, size_t k) { return view(d.levels().at(k).index, "I", 0); }, py::arg("level"),
            py::keep_alive<0, 1>(), "Vertex numbers of a level (uint32); level 0 has all and no list.")
        .def_property_readonly(
            "extents",
            [](const Drawing &d) -> py::object {
                std::array<double, 3> low, high;
                if (!d.extents(low, high)) return py::none();
                return py::make_tuple(py::cast(low), py::cast(high));
            },
            "((x, y, z) least, (x, y, z) greatest) of what is drawn, or None.")
        .def(
            "choose",
            [](const Drawing &d, const Matrix &matrix, int w, int h, double pixels, size_t budget) {
                const Choice c = d.choose(matrix, w, h, pixels, budget);
                return py::make_tuple(c.level, c.first, c.count, c.vertices, c.exact);
            },
            py::arg("matrix"), py::arg("width"), py::arg("height"), py::arg("pixels") = 0.7, py::arg("budget") = 0,
            "(level, first entries, counts, vertices, exact): what to draw in a window, exact to `pixels`; coarser\n"
            "where that needs more than `budget` vertices (0: no bound).")
        .def("spans", &Drawing::spans, py::arg("line"),
             "[(first, behind the last vertex)] of what a source line draws.")
        .def(
            "pick",
            [](const Drawing &d, const Matrix &matrix, int w, int h, double x, double y, double radius,
               unsigned shown) {
                py::gil_scoped_release release;
                return d.pick(matrix, w, h, x, y, radius, shown);
            },
            py::arg("matrix"), py::arg("width"), py::arg("height"), py::arg("x"), py::arg("y"), py::arg("radius") = 5.0,
            py::arg("shown") = 7, "Source line nearest to a pixel, or -1. shown: bit k is set where kind k is shown.");
}
