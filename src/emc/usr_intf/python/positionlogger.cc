// SPDX-License-Identifier: GPL-2.0-or-later
//
// positionlogger.cc - linuxcnc.positionlogger: the path of the tool as coloured points, and
// the geometry functions beside it. Source: Python sheet, sections 6 and 7.
//
// A point is the commanded position less the tool offset, turned by the geometry string. It
// is kept when the direction or the kind of move changes; the last point always moves along.
#include <pybind11/pybind11.h>

#include <array>
#include <atomic>
#include <cmath>
#include <mutex>
#include <vector>

#include "kerf_clock.h"
#include "module.hh"

namespace py = pybind11;

namespace {

constexpr size_t MAX_POINTS = 100000, DROPPED = 10000;

struct Color { unsigned char r, g, b, a; };
struct Point { // record of points(): 32 bytes
    float x, y, z;
    Color color;
    float rx, ry, rz;
    Color second;
};
static_assert(sizeof(Point) == 32);

// Rotations happen about these offsets when respected (axis letters A, B, C).
std::array<double, 3> rot_offsets{};
bool respect_offsets = false;
std::string respect_coordinates;

void turn(double &a, double &b, double degrees) {
    double t = degrees * M_PI / 180, c = std::cos(t), s = std::sin(t), na = a * c - b * s;
    b = a * s + b * c;
    a = na;
}

// The nine coordinates p as a point in space, letters applied from left to right.
std::array<double, 3> vertex(const std::array<double, 9> &p, const char *geometry) {
    std::array<double, 3> q{};
    double sign = 1;
    for (const char *g = geometry; *g; g++) {
        auto has = [&](char letter) {
            return respect_offsets && respect_coordinates.find(letter) != std::string::npos;
        };
        double ox = respect_offsets ? rot_offsets[0] : 0, oy = respect_offsets ? rot_offsets[1] : 0,
               oz = respect_offsets ? rot_offsets[2] : 0;
        switch (toupper(static_cast<unsigned char>(*g))) {
        case '-': sign = -1; continue;
        case 'X': q[0] += p[0] * sign; break;
        case 'Y': q[1] += p[1] * sign; break;
        case 'Z': q[2] += p[2] * sign; break;
        case 'U': q[0] += p[6] * sign; break;
        case 'V': q[1] += p[7] * sign; break;
        case 'W': q[2] += p[8] * sign; break;
        case 'A':
            if (respect_offsets && !has('A')) break;
            q[1] -= oy;
            q[2] -= oz;
            turn(q[1], q[2], p[3] * sign);
            q[1] += oy;
            q[2] += oz;
            break;
        case 'B':
            if (respect_offsets && !has('B')) break;
            q[2] -= oz;
            q[0] -= ox;
            turn(q[0], q[2], p[4] * sign);
            q[2] += oz;
            q[0] += ox;
            break;
        case 'C':
            if (respect_offsets && !has('C')) break;
            q[0] -= ox;
            q[1] -= oy;
            turn(q[0], q[1], p[5] * sign);
            q[0] += ox;
            q[1] += oy;
            break;
        default: break;
        }
        sign = 1;
    }
    return q;
}

class PositionLogger {
public:
    PositionLogger(py::object stat, const std::array<Color, 6> &colors, std::string geometry, bool is_xyuv)
        : stat_object_(std::move(stat)), colors_(colors), geometry_(std::move(geometry)), is_xyuv_(is_xyuv) {}

    void start(double interval_s) {
        Stat &stat = stat_object_.cast<Stat &>();
        std::string file = nml_file();
        (void)stat;
        NML channel(emc_messages(), "emcStatus", "xemc", file.empty() ? nullptr : file.c_str());
        clear();
        stop_ = false;
        py::gil_scoped_release go;
        EMC_STAT status;
        bool known = false;
        while (!stop_) {
            if (!channel.valid()) break;
            if (channel.peek() == EMC_STAT_TYPE) {
                status = *channel.get<EMC_STAT>();
                known = true;
            }
            if (known) add(status);
            kerf_clock_sleep_ns(static_cast<int64_t>(interval_s * 1e9));
        }
    }

    void stop() { stop_ = true; }

    void clear() {
        std::lock_guard<std::mutex> hold(guard_);
        points_.clear();
        lead_ = false;
    }

    size_t npts() const { std::lock_guard<std::mutex> hold(guard_); return points_.size(); }

    py::tuple points() {
        std::lock_guard<std::mutex> hold(guard_);
        drawn_ = points_.size();
        return py::make_tuple(py::bytes(reinterpret_cast<const char *>(points_.data()), points_.size() * sizeof(Point)),
                              points_.size(), is_xyuv_ ? 1 : 0);
    }

    py::object last(int flag) const {
        std::lock_guard<std::mutex> hold(guard_);
        size_t n = flag ? std::min(drawn_, points_.size()) : points_.size();
        if (n == 0) return py::none();
        const Point &p = points_[n - 1];
        return py::make_tuple(p.x, p.y, p.z, p.rx, p.ry, p.rz);
    }

    void set_depth(double z, double w) { foam_z_ = z; foam_w_ = w; }
    void set_colors(const std::array<Color, 6> &c) { std::lock_guard<std::mutex> hold(guard_); colors_ = c; }
    py::tuple get_colors() const {
        py::tuple t(6);
        for (size_t i = 0; i < 6; i++) t[i] = py::make_tuple(colors_[i].r, colors_[i].g, colors_[i].b, colors_[i].a);
        return t;
    }

private:
    static bool same(Color a, Color b) { return a.r == b.r && a.g == b.g && a.b == b.b && a.a == b.a; }

    static bool straight(double ax, double ay, double az, double bx, double by, double bz) {
        double aa = ax * ax + ay * ay + az * az, bb = bx * bx + by * by + bz * bz;
        if (aa == 0 || bb == 0) return true;
        return 1 - (ax * bx + ay * by + az * bz) / std::sqrt(aa * bb) <= 1e-4;
    }

    void add(const EMC_STAT &s) {
        const EmcPose &p = s.motion.traj.position, &t = s.task.toolOffset;
        std::array<double, 9> q{p.tran.x - t.tran.x, p.tran.y - t.tran.y, p.tran.z - t.tran.z, p.a - t.a, p.b - t.b,
                                p.c - t.c,           p.u - t.u,           p.v - t.v,           p.w - t.w};
        int kind = s.motion.traj.motion_type;
        if (kind < 0 || kind > 5) kind = 0;
        std::lock_guard<std::mutex> hold(guard_);
        Color color = colors_[static_cast<size_t>(kind)];
        Point n{};
        if (is_xyuv_) {
            n.x = static_cast<float>(q[0]);
            n.y = static_cast<float>(q[1]);
            n.z = static_cast<float>(foam_z_);
            n.rx = static_cast<float>(q[6]);
            n.ry = static_cast<float>(q[7]);
            n.rz = static_cast<float>(foam_w_);
        } else {
            std::array<double, 3> v = vertex(q, geometry_.c_str());
            n.x = static_cast<float>(v[0]);
            n.y = static_cast<float>(v[1]);
            n.z = static_cast<float>(v[2]);
            n.rx = static_cast<float>(q[3]);
            n.ry = static_cast<float>(-q[4]);
            n.rz = static_cast<float>(q[5]);
        }
        n.color = n.second = color;
        size_t count = points_.size();
        bool color_changed = count > 0 && !same(points_[count - 1].color, color);
        if (count == 0) {
            push(n);
            push(n);
            return;
        }
        Point &end = points_[count - 1];
        if (color_changed) { // the old colour ends here, the new one begins
            Point joint = n;
            joint.color = joint.second = end.color;
            end = joint;
            push(n);
            push(n);
            return;
        }
        bool keep = false;
        if (count >= 2) {
            const Point &before = points_[count - 2];
            keep = !straight(end.x - before.x, end.y - before.y, end.z - before.z, n.x - end.x, n.y - end.y,
                             n.z - end.z) ||
                   !straight(end.rx - before.rx, end.ry - before.ry, end.rz - before.rz, n.rx - end.rx, n.ry - end.ry,
                             n.rz - end.rz);
            if (is_xyuv_) {
                double dx = n.x - before.x, dy = n.y - before.y;
                keep = keep || dx * dx + dy * dy > 0.01;
            }
        }
        if (keep) push(n);
        else end = n;
    }

    void push(const Point &p) {
        if (points_.size() >= MAX_POINTS) points_.erase(points_.begin(), points_.begin() + DROPPED);
        points_.push_back(p);
    }

    py::object stat_object_;
    mutable std::mutex guard_;
    std::array<Color, 6> colors_;
    std::vector<Point> points_;
    size_t drawn_ = 0;
    bool lead_ = false;
    std::string geometry_;
    bool is_xyuv_;
    double foam_z_ = 0, foam_w_ = 1.5;
    std::atomic<bool> stop_{false};
};

Color color_of(const py::handle &h) {
    py::tuple t = py::reinterpret_borrow<py::object>(h);
    if (t.size() != 4) throw py::type_error("a color has four numbers from 0 to 255");
    return {t[0].cast<unsigned char>(), t[1].cast<unsigned char>(), t[2].cast<unsigned char>(),
            t[3].cast<unsigned char>()};
}

void deprecated(const char *text) {
    if (PyErr_WarnEx(PyExc_DeprecationWarning, text, 1) != 0) throw py::error_already_set();
}

void no_drawing(const char *name) {
    static std::vector<std::string> told;
    for (const std::string &t : told) if (t == name) return;
    told.emplace_back(name);
    deprecated(("linuxcnc." + std::string(name) + "() no longer draws; use rs274.glcanon_scene").c_str());
}

std::array<double, 9> nine(const py::object &o) {
    py::tuple t = o;
    if (t.size() != 9) throw py::type_error("a position has nine numbers");
    std::array<double, 9> v;
    for (size_t i = 0; i < 9; i++) v[i] = t[i].cast<double>();
    return v;
}

} // namespace

void define_positionlogger(py::module_ &m) {
    py::class_<PositionLogger> cls(m, "positionlogger", py::dynamic_attr(), "Records the path of the tool");
    cls.def(py::init([](py::object stat, const py::object &c0, const py::object &c1, const py::object &c2,
                        const py::object &c3, const py::object &c4, const py::object &c5, const std::string &geometry,
                        int is_xyuv) {
                if (!py::isinstance<Stat>(stat)) throw py::type_error("the first argument must be a linuxcnc.stat");
                return std::make_unique<PositionLogger>(stat,
                                                        std::array<Color, 6>{color_of(c0), color_of(c1), color_of(c2),
                                                                             color_of(c3), color_of(c4), color_of(c5)},
                                                        geometry, is_xyuv != 0);
            }),
            py::arg("stat"), py::arg("c0"), py::arg("c1"), py::arg("c2"), py::arg("c3"), py::arg("c4"), py::arg("c5"),
            py::arg("geometry"), py::arg("is_xyuv") = 0);
    cls.def("start", &PositionLogger::start, "Records every `interval` seconds until stop(); run it in a thread");
    cls.def("stop", &PositionLogger::stop);
    cls.def("clear", &PositionLogger::clear);
    cls.def_property_readonly("npts", &PositionLogger::npts);
    cls.def("last", &PositionLogger::last, py::arg("flag") = 1);
    cls.def("points", &PositionLogger::points, "(bytes, number, is_xyuv): records x y z rgba rx ry rz rgba");
    cls.def("set_depth", &PositionLogger::set_depth);
    cls.def("set_colors", [](PositionLogger &p, const py::object &c0, const py::object &c1, const py::object &c2,
                             const py::object &c3, const py::object &c4, const py::object &c5) {
        p.set_colors({color_of(c0), color_of(c1), color_of(c2), color_of(c3), color_of(c4), color_of(c5)});
    });
    cls.def("get_colors", &PositionLogger::get_colors);
    cls.def("call",
            [](PositionLogger &) { deprecated("positionlogger.call() no longer draws; use positionlogger.points()"); });

    m.def("vertex9", [](const std::string &geometry, const py::object &p) {
        std::array<double, 3> v = vertex(nine(p), geometry.c_str());
        return py::make_tuple(v[0], v[1], v[2]);
    });
    m.def("gui_rot_offsets", [](double x, double y, double z) { rot_offsets = {x, y, z}; });
    m.def("gui_respect_offsets", [](const std::string &coordinates, int flag) {
        respect_coordinates = coordinates;
        for (char &c : respect_coordinates) c = static_cast<char>(toupper(static_cast<unsigned char>(c)));
        respect_offsets = flag != 0;
    });
    m.def("line9", [](const std::string &, const py::object &a, const py::object &b) {
        nine(a);
        nine(b);
        no_drawing("line9");
    });
    m.def(
        "draw_lines", [](const std::string &, const py::list &, int) { no_drawing("draw_lines"); }, py::arg("geometry"),
        py::arg("lines"), py::arg("for_selection") = 0);
    m.def(
        "draw_dwells", [](const std::string &, const py::list &, double, int, int) { no_drawing("draw_dwells"); },
        py::arg("geometry"), py::arg("dwells"), py::arg("alpha"), py::arg("for_selection"), py::arg("is_lathe"));
}
