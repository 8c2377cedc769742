/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * module.cc - the Python module `gcode`.
 *
 * Source: preview sheet, sections 1 and 5
 */
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "callbacks.hh"
#include "program.hh"

namespace py = pybind11;

namespace
{

using Path = std::filesystem::path; // from Python as os.fsencode() has it: any bytes

py::object decoded(const std::string &s, const char *errors)
{
    return py::reinterpret_steal<py::object>(PyUnicode_DecodeUTF8(s.data(), Py_ssize_t(s.size()), errors));
}

// Programs may hold any bytes; those that are no UTF-8 are shown escaped.
py::object text(const std::string &s)
{
    return decoded(s, "backslashreplace");
}

// An array that Python (and numpy) may look into without a copy; the program keeps it alive.
py::object view(const py::object &owner, const void *data, const char *format, size_t item,
                std::vector<Py_ssize_t> shape)
{
    std::vector<Py_ssize_t> strides(shape.size());
    Py_ssize_t step = Py_ssize_t(item);
    for (size_t i = shape.size(); i-- > 0;) {
        strides[i] = step;
        step *= shape[i];
    }
    static const char nothing[8] = {};
    py::object result = py::memoryview::from_buffer(const_cast<void *>(data ? data : nothing), Py_ssize_t(item), format,
                                                    shape, strides, true);
    (void)owner;
    return result;
}

py::object box_value(const Box &b)
{
    if (b.empty()) return py::make_tuple(py::make_tuple(0.0, 0.0, 0.0), py::make_tuple(0.0, 0.0, 0.0));
    return py::make_tuple(py::make_tuple(b.low[0], b.low[1], b.low[2]),
                          py::make_tuple(b.high[0], b.high[1], b.high[2]));
}

std::vector<std::string> text_list(const py::object &codes)
{
    std::vector<std::string> out;
    if (!codes.is_none())
        for (py::handle h : codes) out.push_back(h.cast<std::string>());
    return out;
}

std::vector<CANON_TOOL_TABLE> tool_list(const py::object &tools)
{
    std::vector<CANON_TOOL_TABLE> out;
    if (tools.is_none()) return out;
    for (py::handle h : tools) {
        py::sequence t = py::reinterpret_borrow<py::sequence>(h);
        CANON_TOOL_TABLE r = tooldata_entry_init();
        r.toolno = r.pocketno = t[0].cast<int>();
        double *offset = &r.offset.tran.x;
        for (size_t i = 0; i < 9; ++i) offset[i] = t[i + 1].cast<double>();
        r.diameter = t[10].cast<double>();
        r.frontangle = t[11].cast<double>();
        r.backangle = t[12].cast<double>();
        r.orientation = t[13].cast<int>();
        out.push_back(r);
    }
    return out;
}

std::shared_ptr<ProgramPath> load(const Path &file, const Path &parameter_file, const py::object &init,
                                  const py::object &tools, int axis_mask, double linear_units, double angular_units,
                                  const Path &ini, int arc_division, bool block_delete, const py::object &start,
                                  const py::object &progress, size_t max_vertices, const std::string &interpreter,
                                  bool keep_path, const std::string &hal_component)
{
    ProgramOptions o;
    o.interpreter = interpreter;
    o.parameter_file = parameter_file.string();
    o.ini_file = ini.string();
    o.init_codes = text_list(init);
    o.tools = tool_list(tools);
    o.axis_mask = axis_mask;
    o.linear_units = linear_units;
    o.angular_units = angular_units;
    o.arc_division = arc_division;
    o.block_delete = block_delete;
    o.max_vertices = max_vertices;
    o.keep_path = keep_path;
    o.hal_component = hal_component;
    if (!start.is_none()) {
        size_t i = 0;
        for (py::handle h : start)
            if (i < 9) o.start[i++] = h.cast<double>();
    }
    auto path = std::make_shared<ProgramPath>();
    const std::function<bool(int)> ask = [&](int line) {
        py::gil_scoped_acquire gil;
        if (PyErr_CheckSignals() != 0) throw py::error_already_set(); // Ctrl-C ends an endless program
        return !progress.is_none() && bool(py::bool_(progress(line)));
    };
    {
        py::gil_scoped_release free;
        read_program(*path, file.string(), o, ask);
    }
    return path;
}

PreviewFrame frame_of(const py::object &c)
{
    PreviewFrame f;
    static const char letters[] = "xyzabcuvw";
    for (size_t i = 0; i < 9; ++i) {
        f.g5x[i] = c.attr((std::string("g5x_offset_") + letters[i]).c_str()).cast<double>();
        f.g92[i] = c.attr((std::string("g92_offset_") + letters[i]).c_str()).cast<double>();
    }
    f.cosine = c.attr("rotation_cos").cast<double>();
    f.sine = c.attr("rotation_sin").cast<double>();
    return f;
}

py::list arc_to_segments(const py::object &canon, double x1, double y1, double cx, double cy, int rot, double z1,
                         double a, double b, double c, double u, double v, double w, int max_segments)
{
    const PreviewFrame frame = frame_of(canon);
    Point9 start;
    size_t i = 0;
    for (py::handle h : canon.attr("lo"))
        if (i < 9) start[i++] = h.cast<double>();
    double scale = 25.4;
    const py::object units = py::getattr(canon, "length_units", py::none());
    if (PyNumber_Check(units.ptr())) scale *= units.cast<double>(); // a canon may answer every name with a method
    std::vector<Point9> points;
    arc_segments(points, frame, canon.attr("plane").cast<int>(), start, x1, y1, cx, cy, rot, z1,
                 {0, 0, 0, a, b, c, u, v, w}, max_segments, scale);
    py::list out(points.size());
    for (size_t n = 0; n < points.size(); ++n) {
        py::tuple t(9);
        for (size_t k = 0; k < 9; ++k) t[k] = points[n][k];
        out[n] = t;
    }
    return out;
}

py::tuple calc_extents(const py::args &lists)
{
    double low[3] = {9e99, 9e99, 9e99}, high[3] = {-9e99, -9e99, -9e99};
    double low_tool[3] = {9e99, 9e99, 9e99}, high_tool[3] = {-9e99, -9e99, -9e99};
    auto add = [&](py::handle point, py::handle offset) {
        py::sequence p = py::reinterpret_borrow<py::sequence>(point), o = py::reinterpret_borrow<py::sequence>(offset);
        for (size_t i = 0; i < 3; ++i) {
            const double v = p[i].cast<double>(), t = v + o[i].cast<double>();
            low[i] = std::min(low[i], v);
            high[i] = std::max(high[i], v);
            low_tool[i] = std::min(low_tool[i], t);
            high_tool[i] = std::max(high_tool[i], t);
        }
    };
    for (py::handle list : lists) {
        py::sequence items = py::reinterpret_borrow<py::sequence>(list);
        const size_t n = items.size();
        for (size_t i = 0; i < n; ++i) {
            py::sequence item = py::reinterpret_borrow<py::sequence>(py::object(items[i]));
            const py::object offset = item[item.size() - 1];
            add(py::object(item[1]), offset);
            if (i + 1 == n) add(py::object(item[2]), offset);
        }
    }
    auto values = [](const double *v) {
        py::list l;
        for (int i = 0; i < 3; ++i) l.append(v[i]);
        return l;
    };
    return py::make_tuple(values(low), values(high), values(low_tool), values(high_tool));
}

template <size_t N, class T> py::tuple as_tuple(const T (&values)[N])
{
    py::tuple t(N);
    for (size_t i = 0; i < N; ++i) t[i] = values[i];
    return t;
}

py::tuple parse(const Path &file, const py::object &canon, const py::object &codes, const py::object &second,
                const py::object &third)
{
    std::vector<std::string> init;
    std::string library;
    if (PyList_Check(codes.ptr())) {
        init = text_list(codes);
        if (!second.is_none()) library = second.cast<std::string>();
    } else {
        if (!codes.is_none()) init.push_back(codes.cast<std::string>());
        if (!second.is_none()) init.push_back(second.cast<std::string>());
        if (!third.is_none()) library = third.cast<std::string>();
    }
    return parse_with_callbacks(file.string(), canon, init, library);
}

void bind_linecode(py::module_ &m)
{
    py::class_<LineCode> c(m, "linecode", "Active codes before a line; argument of next_line().");
    c.def_property_readonly("sequence_number", [](const LineCode &l) { return l.g[0]; });
    c.def_property_readonly("gcodes", [](const LineCode &l) { return as_tuple(l.g); });
    c.def_property_readonly("mcodes", [](const LineCode &l) { return as_tuple(l.m); });
    c.def_property_readonly("feed_rate", [](const LineCode &l) { return l.settings[1]; });
    c.def_property_readonly("speed", [](const LineCode &l) { return l.settings[2]; });
    static const struct { const char *name; int index; } g[] = {
        {"motion_mode", 1}, {"block", 2}, {"plane", 3}, {"cutter_side", 4}, {"units", 5}, {"distance_mode", 6},
        {"feed_mode", 7}, {"origin", 8}, {"tool_length_offset", 9}, {"retract_mode", 10}, {"path_mode", 11}};
    for (const auto &item : g) {
        const int i = item.index;
        c.def_property_readonly(item.name, [i](const LineCode &l) { return l.g[i]; });
    }
    static const struct { const char *name; int index; } mm[] = {
        {"stopping", 1}, {"spindle", 2}, {"toolchange", 3}, {"mist", 4}, {"flood", 5}, {"overrides", 6}};
    for (const auto &item : mm) {
        const int i = item.index;
        c.def_property_readonly(item.name, [i](const LineCode &l) { return l.m[i]; });
    }
}

void bind_program(py::module_ &m)
{
    using P = std::shared_ptr<ProgramPath>;
    py::class_<ProgramPath, P> c(m, "Program",
                                 "A program's tool path as arrays. Inches, degrees, inches a minute, seconds.\n\n"
                                 "positions (N x 9 float32), lines (N int32), kinds (N uint8): vertex n ends the\n"
                                 "piece that began at vertex n-1; kind 0 traverse, 1 feed, 2 arc, 3 jump (a new\n"
                                 "run begins here). The views stay valid as long as the program does.");
    c.def_property_readonly(
        "positions",
        [](const py::object &self) {
            auto &p = self.cast<ProgramPath &>().points;
            return view(self, p.nine(), "f", 4, {Py_ssize_t(p.size()), 9});
        },
        py::keep_alive<0, 1>());
    c.def_property_readonly(
        "points",
        [](const py::object &self) {
            const auto &p = self.cast<const ProgramPath &>().points;
            return view(self, p.data(), "f", 4, {Py_ssize_t(p.size()), Py_ssize_t(p.columns())});
        },
        py::keep_alive<0, 1>(), "As they are kept: N x 3, or as many columns as hold those axes that leave zero.");
    c.def_property_readonly(
        "lines",
        [](const py::object &self) {
            const auto &p = self.cast<const ProgramPath &>().lines;
            return view(self, p.data(), "i", 4, {Py_ssize_t(p.size())});
        },
        py::keep_alive<0, 1>());
    c.def_property_readonly(
        "kinds",
        [](const py::object &self) {
            const auto &p = self.cast<const ProgramPath &>().kinds;
            return view(self, p.data(), "B", 1, {Py_ssize_t(p.size())});
        },
        py::keep_alive<0, 1>());
    c.def_property_readonly("n_vertices", [](const ProgramPath &p) { return p.points.size(); });
    c.def_readonly("n_moves", &ProgramPath::moves);
    c.def_readonly("rapid_length", &ProgramPath::rapid_length);
    c.def_readonly("cutting_length", &ProgramPath::cutting_length);
    c.def_readonly("dwell_time", &ProgramPath::dwell_time);
    c.def("cutting_time", &ProgramPath::cutting_time, py::arg("max_feed"), "Seconds in feed; max_feed in in/min.");
    c.def(
        "run_time",
        [](const ProgramPath &p, double max_feed, double max_rapid) {
            return p.cutting_time(max_feed) + (max_rapid > 0 ? p.rapid_length / max_rapid * 60 : 0) + p.dwell_time;
        },
        py::arg("max_feed"), py::arg("max_rapid"), "Seconds; speeds in in/min.");
    c.def_property_readonly("extents", [](const ProgramPath &p) { return box_value(p.extents_notool); },
                            "((x,y,z) least, (x,y,z) greatest) of the controlled point.");
    c.def_property_readonly("extents_tool", [](const ProgramPath &p) { return box_value(p.extents); },
                            "The same with the tool offset added.");
    c.def_property_readonly("tools", [](const ProgramPath &p) {
        py::list l;
        for (const auto &[vertex, tool] : p.tool_changes) l.append(py::make_tuple(vertex, tool));
        return l;
    }, "(vertex, tool number) of each tool change.");
    c.def_property_readonly("marks", [](const ProgramPath &p) {
        py::list l;
        for (const ProgramMark &k : p.marks) l.append(py::make_tuple(k.line, k.x, k.y, k.z, k.plane, k.user_m));
        return l;
    }, "(line, x, y, z, plane, is M1xx) of dwells and user M codes.");
    c.def("mark_places", [](const ProgramPath &p, bool user_m) {
        const std::vector<float> points = p.mark_places(user_m);
        return py::bytes(reinterpret_cast<const char *>(points.data()), points.size() * sizeof(float));
    }, py::arg("user_m"), "The marks of a kind as rows of four float32: x, y, z in inches, plane.");
    c.def("release_path", &ProgramPath::release_path,
          "Frees positions, lines and kinds, of which no view may be left; lengths, extents, times and marks stay.");
    c.def_property_readonly("messages", [](const ProgramPath &p) {
        py::list l;
        for (const std::string &message : p.messages) l.append(text(message));
        return l;
    });
    c.def_readonly("result", &ProgramPath::result);
    c.def_readonly("last_line", &ProgramPath::last_line);
    c.def_property_readonly("error", [](const ProgramPath &p) { return text(p.error); });
    c.def_readonly("aborted", &ProgramPath::aborted);
    c.def_readonly("thinned", &ProgramPath::thinned, "1, or n when about every n-th piece was kept.");
    c.def_readonly("foam_z", &ProgramPath::foam_z,
                   "Height of the XY plane of a foam cutter that the program gave, inches, or None.");
    c.def_readonly("foam_w", &ProgramPath::foam_w, "Height of its UV plane.");
    c.def_readonly("notify", &ProgramPath::notify);
    c.def_property_readonly("notify_message", [](const ProgramPath &p) { return text(p.notify_message); });
    c.def_property_readonly("fault", [](const ProgramPath &p) -> py::object {
        if (p.error.empty()) return py::none();
        py::dict d;
        d["file"] = decoded(p.fault.file, "surrogateescape");
        d["line"] = p.fault.line;
        d["column"] = p.fault.column;
        d["length"] = p.fault.length;
        d["text"] = text(p.fault.text);
        d["what"] = text(p.fault.what);
        d["fix"] = text(p.fault.fix);
        d["report"] = text(p.fault.report());
        return d;
    });
}

} // namespace

PYBIND11_MODULE(gcode, m)
{
    m.doc() = "The interpreter for previews: parse() with a canon written in Python, load() into arrays.";
    bind_linecode(m);
    bind_program(m);
    m.attr("MAX_ERROR") = -1;
    m.attr("MIN_ERROR") = int(INTERP_MIN_ERROR);
    m.def("parse", &parse, py::arg("filename"), py::arg("canon"), py::arg("codes") = py::none(),
          py::arg("initcode") = py::none(), py::arg("interpname") = py::none(),
          "parse(filename, canon[, unitcode[, initcode[, interpname]]]) or\n"
          "parse(filename, canon, initcodes[, interpname]) -> (result, last line)\n\n"
          "Calls the canon's methods with inches and degrees. A result above MIN_ERROR is an error.");
    m.def("strerror", [](int code) { return text(last_error(code)); }, py::arg("code"), "Text of the last parse's error.");
    m.def("arc_to_segments", &arc_to_segments, py::arg("canon"), py::arg("x1"), py::arg("y1"), py::arg("cx"),
          py::arg("cy"), py::arg("rot"), py::arg("z1"), py::arg("a"), py::arg("b"), py::arg("c"), py::arg("u"),
          py::arg("v"), py::arg("w"), py::arg("max_segments") = 128);
    m.def("calc_extents", &calc_extents,
          "calc_extents(moves, ...) -> min, max, min with tool, max with tool; moves: (line, start, end, [feed,] "
          "offset)");
    m.def("load", &load, py::arg("filename"), py::arg("parameter_file") = "", py::arg("initcodes") = py::none(),
          py::arg("tools") = py::none(), py::arg("axis_mask") = 0x1ff, py::arg("linear_units") = 1.0,
          py::arg("angular_units") = 1.0, py::arg("ini") = "", py::arg("arc_division") = 64,
          py::arg("block_delete") = false, py::arg("start") = py::none(), py::arg("progress") = py::none(),
          py::arg("max_vertices") = 0, py::arg("interpreter") = "", py::arg("keep_path") = true,
          py::arg("hal_component") = "",
          "Read a program into a Program. linear_units: machine units per mm; tools: 14-tuples as of get_tool();\n"
          "progress(line) is called about ten times a second and stops the reading when it returns true.\n"
          "max_vertices: a longer path is kept coarser (thinned); lengths, times and extents stay exact.\n"
          "interpreter: library of another language, as [TASK]INTERPRETER.\n"
          "keep_path: False for these alone. hal_component: joins HAL as NAME and the process's number when the\n"
          "program looks at a pin; else this process must have joined for that.\n"
          "The parameter file is read and, like by every interpreter start, written: give a copy.");
}
