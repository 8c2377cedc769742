// SPDX-License-Identifier: GPL-2.0-or-later
// Python module kerf_raster: pictures of tool paths in memory.
#include "module.hh"
#include "drawing.hh"

#include <pybind11/stl.h>

#include <stdexcept>

namespace py = pybind11;
using namespace kerf;

namespace {

/// A float32 buffer (N x 3 or more) and an optional uint8 buffer (N); they must outlive the Path.
struct Arrays {
    py::buffer_info xyz, kinds;
    Path path;

    Arrays(const py::buffer &points, const py::object &colours) : xyz(points.request())
    {
        if (xyz.ndim != 2 || xyz.shape[1] < 3 || xyz.format != "f" || xyz.strides[1] != 4 || xyz.strides[0] % 4)
            throw py::value_error("vertices must be a float32 array of N rows of 3 or more numbers");
        path.xyz = static_cast<const float *>(xyz.ptr);
        path.count = size_t(xyz.shape[0]);
        path.stride = size_t(xyz.strides[0]) / 4;
        if (colours.is_none()) return;
        kinds = py::cast<py::buffer>(colours).request();
        if (kinds.ndim != 1 || kinds.itemsize != 1 || kinds.strides[0] != 1 || size_t(kinds.shape[0]) != path.count)
            throw py::value_error("kinds must be one byte for each vertex");
        path.kinds = static_cast<const uint8_t *>(kinds.ptr);
    }
};

Rgba colour(const std::array<int, 4> &c)
{
    for (int v : c)
        if (v < 0 || v > 255) throw py::value_error("colours are four numbers 0 to 255: red, green, blue, alpha");
    return {uint8_t(c[0]), uint8_t(c[1]), uint8_t(c[2]), uint8_t(c[3])};
}

std::vector<Rgba> colours(const std::vector<std::array<int, 4>> &list)
{
    std::vector<Rgba> out;
    for (const auto &c : list) out.push_back(colour(c));
    return out;
}

using Palette = std::vector<std::array<int, 4>>;

void draw(Raster &raster, const py::buffer &points, const py::object &kinds, const Palette &palette,
          const Matrix &matrix, size_t first, size_t last, int width) {
    Arrays arrays(points, kinds);
    auto list = colours(palette);
    py::gil_scoped_release release;
    raster.draw(arrays.path, list, matrix, first, last, width);
}

// Records of linuxcnc.positionlogger: x y z rgba x y z rgba, 32 bytes; `second`: the other path too, and the
// wires between both.
void draw_plot(Raster &raster, const py::bytes &records, const Matrix &matrix, size_t first, size_t last, bool second)
{
    constexpr size_t record = 8, half = 4;     // floats
    std::string_view data = records;
    auto xyz = reinterpret_cast<const float *>(data.data());
    auto rgba = reinterpret_cast<const uint8_t *>(data.data()) + 3 * sizeof(float);
    Path path;
    path.count = data.size() / (record * sizeof(float));
    path.stride = record;
    last = std::min(last, path.count);
    py::gil_scoped_release release;
    for (size_t side = 0; side < (second ? 2 : 1); side++) {
        path.xyz = xyz + side * half;
        path.rgba = rgba + side * half * sizeof(float);
        raster.draw(path, {}, matrix, first, last, 2);
    }
    path.count = 2;
    path.stride = half;
    for (size_t i = first; second && i < last; i++) {
        path.xyz = xyz + i * record;
        path.rgba = rgba + i * record * sizeof(float);
        raster.draw(path, {}, matrix, 0, 2);
    }
}

long pick(const py::buffer &points, const py::object &kinds, const Palette &palette, const Matrix &matrix, int width,
          int height, double x, double y, double radius) {
    Arrays arrays(points, kinds);
    auto list = colours(palette);
    py::gil_scoped_release release;
    return Raster::pick(arrays.path, list, matrix, width, height, x, y, radius);
}

} // namespace

PYBIND11_MODULE(kerf_raster, m)
{
    m.doc() = "Pictures of tool paths, drawn in memory.\n\n"
              "vertices: float32, N x 3 or more; kinds: uint8, N: colour of the piece that ends at a vertex\n"
              "(index in palette); matrix: 16 numbers, row-major, clip = matrix * (x, y, z, 1).";
    py::class_<Raster>(m, "Raster")
        .def(py::init<int, int>(), py::arg("width"), py::arg("height"), "Pixels, 1 to 16384.")
        .def_property_readonly("width", &Raster::width)
        .def_property_readonly("height", &Raster::height)
        .def(
            "assign", [](Raster &r, const Raster &from) { r = from; }, py::arg("other"),
            "Becomes a copy of another picture.")
        .def(
            "clear", [](Raster &r, const std::array<int, 4> &c) { r.clear(colour(c)); }, py::arg("colour"))
        .def("draw", &draw, py::arg("vertices"), py::arg("kinds"), py::arg("palette"), py::arg("matrix"),
             py::arg("first") = 0, py::arg("last") = size_t(-1), py::arg("width") = 1)
        .def(
            "draw_drawing",
            [](Raster &r, const Drawing &d, const Palette &palette, const Matrix &matrix, double pixels) {
                const auto list = colours(palette);
                py::gil_scoped_release release;
                d.draw(r, list, matrix, pixels);
            },
            py::arg("drawing"), py::arg("palette"), py::arg("matrix"), py::arg("pixels") = 0.7,
            "A Drawing, exact to `pixels`.")
        .def(
            "draw_pieces",
            [](Raster &r, const Drawing &d, const Palette &palette, const Matrix &matrix, size_t level,
               const std::vector<int32_t> &first, const std::vector<int32_t> &count) {
                const auto list = colours(palette);
                py::gil_scoped_release release;
                d.draw(r, list, matrix, level, first, count);
            },
            py::arg("drawing"), py::arg("palette"), py::arg("matrix"), py::arg("level"), py::arg("first"),
            py::arg("count"), "Pieces of a level of a Drawing, as its choose() gives them. IndexError.")
        .def("draw_plot", &draw_plot, py::arg("records"), py::arg("matrix"), py::arg("first"), py::arg("last"),
             py::arg("second") = false,
             "Points first to last (exclusive) of linuxcnc.positionlogger.points(), 2 pixels wide.")
        .def(
            "ppm", [](const Raster &r) { return py::bytes(r.ppm()); }, "The picture as a binary PPM file.")
        .def("pixel", [](const Raster &r, int x, int y) {
            Rgba c = r.pixel(x, y);
            return py::make_tuple(c.r, c.g, c.b);
        });
    bind_drawing(m);
    m.def("pick", &pick, py::arg("vertices"), py::arg("kinds"), py::arg("palette"), py::arg("matrix"), py::arg("width"),
          py::arg("height"), py::arg("x"), py::arg("y"), py::arg("radius") = 5.0,
          "Vertex that ends the piece nearest to a pixel, or -1.");
}
