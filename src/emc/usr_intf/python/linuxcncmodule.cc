// SPDX-License-Identifier: GPL-2.0-or-later
//
// linuxcncmodule.cc - Python module linuxcnc: stat, command, error_channel, constants.
// The other types: ini.cc, positionlogger.cc. Source: Python sheet.
//
// Attributes of stat come from the descriptions in messages.def: name, type and docstring.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>

#include "client.hh"
#include "kerf_clock.h"
#include "kerf_paths.h"
#include "module.hh"
#include "rcs_print.hh"
#include "task_text.hh"
#include "tooldata.h"

namespace py = pybind11;

PyObject *linuxcnc_error = nullptr;

void raise_error(const std::string &text) {
    PyErr_SetString(linuxcnc_error, text.c_str());
    throw py::error_already_set();
}

// Bytes of a str (UTF-8) or bytes object. Raises UnicodeEncodeError for what is no text.
// errors: "surrogateescape" for names of files, which may have any bytes but 0, which would end the message's text.
static std::string text_of(const py::handle &o, const char *errors = "strict") {
    py::object bytes = py::reinterpret_borrow<py::object>(o);
    if (!py::isinstance<py::bytes>(o))
        bytes = py::reinterpret_steal<py::object>(PyUnicode_AsEncodedString(o.ptr(), "utf-8", errors));
    if (!bytes) throw py::error_already_set();
    std::string text = bytes.cast<std::string>();
    if (text.find('\0') != std::string::npos) throw py::value_error("embedded null character");
    return text;
}

std::string path_of(const py::handle &name) {
    py::object path = py::reinterpret_steal<py::object>(PyOS_FSPath(name.ptr()));
    if (!path) throw py::error_already_set();
    return text_of(path, "surrogateescape");
}

std::string nml_file() {
    py::object f = py::module_::import("linuxcnc").attr("nmlfile");
    return f.is_none() ? "" : path_of(f);
}

namespace {

constexpr double RECEIVE_TIMEOUT_S = 5.0;

// ---- values ----

py::object to_python(const EmcPose &p) {
    return py::make_tuple(p.tran.x, p.tran.y, p.tran.z, p.a, p.b, p.c, p.u, p.v, p.w);
}
py::object to_python(bool v) { return py::bool_(v); }
py::object to_python(double v) { return py::float_(v); }
template <class T> std::enable_if_t<std::is_integral_v<T> && !std::is_same_v<T, bool>, py::object> to_python(T v) {
    return py::int_(v);
}
// errors: how bytes come that are no UTF-8.
template <size_t N> py::object decoded(const char (&v)[N], const char *errors) {
    return py::reinterpret_steal<py::object>(
        PyUnicode_DecodeUTF8(v, static_cast<Py_ssize_t>(strnlen(v, N)), errors));
}
template <size_t N> py::object to_python(const char (&v)[N]) { return decoded(v, "backslashreplace"); }
template <class T, size_t N> py::object to_python(const T (&v)[N]) {
    py::tuple t(N);
    for (size_t i = 0; i < N; i++) t[i] = to_python(v[i]);
    return t;
}

// Fields of one structure as a dict.
struct DictMaker {
    py::dict d;
    template <class T> void operator()(const nml::Field &f, const T &v) {
        if constexpr (!std::is_base_of_v<NMLmsg, T>) if (*f.attribute) d[f.attribute] = to_python(v);
    }
};

template <class T> py::dict to_dict(const T &s) {
    DictMaker m;
    T::fields(m, s);
    return m.d;
}

template <class T, size_t N> py::tuple dicts(const T (&all)[N]) {
    py::tuple t(N);
    for (size_t i = 0; i < N; i++) t[i] = to_dict(all[i]);
    return t;
}

// ---- stat ----

PyTypeObject *tool_type = nullptr;

py::object make_tool(const CANON_TOOL_TABLE &t) {
    py::object o = py::reinterpret_steal<py::object>(PyStructSequence_New(tool_type));
    int i = 0;
    auto put = [&](PyObject *v) { PyStructSequence_SetItem(o.ptr(), i++, v); };
    put(PyLong_FromLong(t.toolno));
    for (double v : {t.offset.tran.x, t.offset.tran.y, t.offset.tran.z, t.offset.a, t.offset.b, t.offset.c, t.offset.u,
                     t.offset.v, t.offset.w, t.diameter, t.frontangle, t.backangle})
        put(PyFloat_FromDouble(v));
    put(PyLong_FromLong(t.orientation));
    return o;
}

void define_tool_type(py::module_ &m) {
    static PyStructSequence_Field fields[] = {{"id", nullptr},        {"xoffset", nullptr},     {"yoffset", nullptr},
                                              {"zoffset", nullptr},   {"aoffset", nullptr},     {"boffset", nullptr},
                                              {"coffset", nullptr},   {"uoffset", nullptr},     {"voffset", nullptr},
                                              {"woffset", nullptr},   {"diameter", nullptr},    {"frontangle", nullptr},
                                              {"backangle", nullptr}, {"orientation", nullptr}, {nullptr, nullptr}};
    static PyStructSequence_Desc desc = {"tool_result", "One entry of the tool table (machine units, degrees)", fields,
                                         14};
    tool_type = PyStructSequence_NewType(&desc);
    m.attr("tool") = py::reinterpret_borrow<py::object>(reinterpret_cast<PyObject *>(tool_type));
}

enum class Tools { unknown, here, absent } tools = Tools::unknown;

bool attach_tools() {
    if (tools == Tools::unknown) {
        tools = tool_mmap_user() == 0 ? Tools::here : Tools::absent;
        if (tools == Tools::absent) {
            printf("tool_mmap_user(): tool mmap not available\npoll(): continuing without tool mmap data\n");
            fflush(stdout);
        }
    }
    return tools == Tools::here;
}

template <size_t N, class F> py::tuple per_joint(const EMC_JOINT_STAT (&j)[N], F f) {
    py::tuple t(N);
    for (size_t i = 0; i < N; i++) t[i] = f(j[i]);
    return t;
}

// Gives `cls` a read-only property for each field with an attribute name.
struct PropertyMaker {
    py::class_<Stat> &cls;
    const EMC_STAT &base;
    template <class T> void operator()(const nml::Field &f, const T &member) {
        if constexpr (std::is_base_of_v<NMLmsg, T>) {
            T::fields(*this, member);
        } else if constexpr (!std::is_base_of_v<NMLmsg, std::remove_extent_t<T>>) {
            if (!*f.attribute) return;
            std::ptrdiff_t at = reinterpret_cast<const char *>(&member) - reinterpret_cast<const char *>(&base);
            cls.def_property_readonly(
                f.attribute,
                [at, is_file = strstr(f.attribute, "file") != nullptr](const Stat &s) {
                    const T &v = *reinterpret_cast<const T *>(reinterpret_cast<const char *>(&s.data) + at);
                    if constexpr (std::is_same_v<std::remove_extent_t<T>, char>)
                        if (is_file) return decoded(v, "surrogateescape"); // it can be opened
                    return to_python(v);
                },
                f.doc);
        }
    }
};

void poll_stat(Stat &s) {
    if (!s.channel->valid()) raise_error("emcStatusBuffer invalid err=" + std::to_string(s.channel->error_type));
    if (s.channel->peek() == EMC_STAT_TYPE) s.data = *s.channel->get<EMC_STAT>();
    else if (s.channel->remote() && (s.channel->status == CMS_NO_SERVER_ERROR || s.channel->status == CMS_TIMED_OUT))
        raise_error("emcStatusBuffer: no answer of the server err=" + std::to_string(s.channel->error_type));
    s.polled = true;
    attach_tools();
}

py::object tool_table(const Stat &s) {
    if (!s.polled || tools != Tools::here) return py::tuple();
    int last = tooldata_last_index_get();
    py::tuple t(static_cast<size_t>(last + 1));
    for (int i = 0; i <= last; i++) {
        CANON_TOOL_TABLE rec = tooldata_entry_init();
        tooldata_get(&rec, i);
        t[static_cast<size_t>(i)] = make_tool(rec);
    }
    return t;
}

py::object tool_info(const Stat &s, int toolno) {
    if (!s.polled || tools != Tools::here) throw py::value_error("toolinfo: NOT READY (initial poll reqd)\n");
    if (toolno == 0) throw py::value_error("toolinfo: for tool in spindle: use linuxnc.stat.tool_table[0]");
    CANON_TOOL_TABLE rec = tooldata_entry_init();
    int idx = tooldata_find_index_for_tool(toolno);
    if (idx < 0) throw py::value_error("toolinfo: NO tooldata for toolno=" + std::to_string(toolno));
    tooldata_get(&rec, idx);
    py::dict d;
    d["toolno"] = rec.toolno;
    d["pocketno"] = rec.pocketno;
    d["diameter"] = rec.diameter;
    d["frontangle"] = rec.frontangle;
    d["backangle"] = rec.backangle;
    d["orientation"] = rec.orientation;
    d["xoffset"] = rec.offset.tran.x;
    d["yoffset"] = rec.offset.tran.y;
    d["zoffset"] = rec.offset.tran.z;
    d["aoffset"] = rec.offset.a;
    d["boffset"] = rec.offset.b;
    d["coffset"] = rec.offset.c;
    d["uoffset"] = rec.offset.u;
    d["voffset"] = rec.offset.v;
    d["woffset"] = rec.offset.w;
    d["comment"] = to_python(rec.comment);
    return d;
}

void define_stat(py::module_ &m) {
    py::class_<Stat> cls(m, "stat", py::dynamic_attr(), "Status of the controller: a snapshot taken by poll()");
    cls.def(py::init([](const py::args &, const py::kwargs &) { return std::make_unique<Stat>(nml_file()); }));
    cls.def("poll", &poll_stat, "Takes a new snapshot");
    EMC_STAT sample;
    PropertyMaker maker{cls, sample};
    EMC_STAT::fields(maker, sample);
    cls.def_property_readonly("state", [](const Stat &s) { return s.data.status; }, "RCS_DONE, RCS_EXEC or RCS_ERROR");
    cls.def_property_readonly(
        "echo_serial_number", [](const Stat &s) { return s.data.echo_serial_number; },
        "serial number of the last command task has read");
    cls.def_property_readonly("mdi_queue", [](const Stat &s) {
            py::list lines;
            for (int i = 0; i < EMC_MDI_QUEUE_SHOWN && s.data.mdi_serial[i] != 0; i++)
                lines.append(py::make_tuple(s.data.mdi_serial[i], to_python(s.data.mdi_line[i])));
            return py::tuple(lines);
        }, "MDI lines that wait, the next one first, at most 16: (serial number of the command that brought it, line)");
    cls.def_property_readonly("joint", [](const Stat &s) { return dicts(s.data.motion.joint); }, "one dict per joint");
    cls.def_property_readonly(
        "axis", [](const Stat &s) { return dicts(s.data.motion.axis); }, "one dict per axis, XYZABCUVW");
    cls.def_property_readonly(
        "spindle", [](const Stat &s) { return dicts(s.data.motion.spindle); }, "one dict per spindle");
    cls.def_property_readonly(
        "homed",
        [](const Stat &s) {
            return per_joint(s.data.motion.joint, [](const EMC_JOINT_STAT &j) { return py::int_(int(j.homed)); });
        },
        "0/1 per joint");
    cls.def_property_readonly(
        "limit",
        [](const Stat &s) {
            return per_joint(s.data.motion.joint, [](const EMC_JOINT_STAT &j) {
                return py::int_((j.minHardLimit ? 1 : 0) | (j.maxHardLimit ? 2 : 0) | (j.minSoftLimit ? 4 : 0) |
                                (j.maxSoftLimit ? 8 : 0));
            });
        },
        "per joint: 1 min hard, 2 max hard, 4 min soft, 8 max soft");
    cls.def_property_readonly(
        "joint_position",
        [](const Stat &s) {
            return per_joint(s.data.motion.joint, [](const EMC_JOINT_STAT &j) { return py::float_(j.output); });
        },
        "commanded position per joint, machine units");
    cls.def_property_readonly(
        "joint_actual_position",
        [](const Stat &s) {
            return per_joint(s.data.motion.joint, [](const EMC_JOINT_STAT &j) { return py::float_(j.input); });
        },
        "position by feedback per joint, machine units");
    cls.def_property_readonly("tool_table", &tool_table, "tools by index, 0 is the spindle; read when asked for");
    cls.def("toolinfo", &tool_info, "Data of a tool number as a dict");
}

// ---- command ----

class Command {
public:
    Command() : client(nml_file()) {}
    EmcClient client;

    // Sends and waits until task has read it.
    void give(RCS_CMD_MSG &m) {
        bool sent;
        {
            py::gil_scoped_release go;
            sent = client.send(m);
            if (sent) client.wait_received(RECEIVE_TIMEOUT_S);
        }
        if (!sent) raise_error("emcCommandBuffer invalid err=" + std::to_string(client.command_channel().error_type));
    }
    template <class T> void plain() { T m; give(m); }
};

template <class M, class V, V M::*FIELD> void one_value(Command &c, V v) {
    M m;
    m.*FIELD = v;
    c.give(m);
}

void program_open(Command &c, const py::args &args, const py::kwargs &kwargs) {
    c.plain<EMC_TASK_PLAN_CLOSE>();
    if (kwargs && kwargs.size() > 0) throw py::type_error("program_open() takes no keyword arguments");
    if (args.size() != 1)
        throw py::type_error("function takes exactly 1 argument (" + std::to_string(args.size()) + " given)");
    std::string file = path_of(args[0]);
    if (file.size() >= LINELEN) throw py::value_error("File name limited to 254 characters");
    EMC_TASK_PLAN_OPEN m;
    copy_text(m.file, file.c_str());
    if (c.client.remote()) {
        std::ifstream in(file, std::ios::binary);
        if (!in) {
            PyErr_SetFromErrnoWithFilename(PyExc_OSError, file.c_str());
            throw py::error_already_set();
        }
        std::string content(std::istreambuf_iterator<char>(in), {});
        if (content.empty()) content = "\n"; // 0 bytes to come would name a file over there
        m.remote_filesize = content.size();
        for (size_t at = 0; at < content.size(); at += sizeof m.remote_buffer) {
            m.remote_buffersize = std::min(content.size() - at, sizeof m.remote_buffer);
            memset(m.remote_buffer, 0, sizeof m.remote_buffer);
            content.copy(reinterpret_cast<char *>(m.remote_buffer), m.remote_buffersize, at);
            c.give(m);
        }
        return;
    }
    c.give(m);
}

void mdi(Command &c, const py::object &text) {
    if (!py::isinstance<py::str>(text) && !py::isinstance<py::bytes>(text))
        throw py::type_error("argument 1 must be str or bytes, not " + std::string(Py_TYPE(text.ptr())->tp_name));
    std::string line = text_of(text);
    EMC_TASK_PLAN_EXECUTE m;
    if (line.size() >= sizeof m.command) throw py::value_error("MDI commands limited to 254 characters");
    copy_text(m.command, line.c_str());
    c.give(m);
}

void automatic(Command &c, const py::args &a) {
    if (a.size() < 1 || a.size() > 2)
        throw py::type_error("function takes at least 1 and at most 2 arguments (" + std::to_string(a.size()) +
                             " given)");
    int op = a[0].cast<int>(), line = a.size() > 1 ? a[1].cast<int>() : 0;
    if (op >= 1 && op <= 5 && a.size() != 1)
        throw py::type_error("function takes exactly 1 argument (" + std::to_string(a.size()) + " given)");
    if (op == 0 && a.size() == 2) {
        EMC_TASK_PLAN_RUN m;
        m.line = line;
        c.give(m);
        return;
    }
    switch (op) {
    case 1: return c.plain<EMC_TASK_PLAN_PAUSE>();
    case 2: return c.plain<EMC_TASK_PLAN_RESUME>();
    case 3: return c.plain<EMC_TASK_PLAN_STEP>();
    case 4: return c.plain<EMC_TASK_PLAN_REVERSE>();
    case 5: return c.plain<EMC_TASK_PLAN_FORWARD>();
    default: raise_error("Unexpected argument '" + std::to_string(op) + "' to command.auto");
    }
}

void take_control(Command &c, const std::string &name) {
    EMC_TASK_TAKE_CONTROL m;
    copy_text(m.name, name.c_str());
    c.give(m);
}

void mdi_cancel(Command &c, int serial) {
    EMC_TASK_MDI_CANCEL m;
    m.line_serial = serial;
    c.give(m);
}

void restore(Command &c, int line) {
    EMC_TASK_PLAN_RESTORE m;
    m.line = line;
    c.give(m);
}

void restore_confirm(Command &c, int line) {
    EMC_TASK_PLAN_RESTORE_CONFIRM m;
    m.line = line;
    c.give(m);
}

void set_spindle(Command &c, const py::args &a) {
    if (a.size() < 1 || a.size() > 4)
        throw py::type_error("function takes at least 1 and at most 4 arguments (" + std::to_string(a.size()) +
                             " given)");
    int dir = a[0].cast<int>();
    double a1 = a.size() > 1 ? a[1].cast<double>() : 0;
    int a2 = a.size() > 2 ? a[2].cast<int>() : 0, a3 = a.size() > 3 ? a[3].cast<int>() : 0;
    switch (dir) {
    case 1: case -1:
        {
            EMC_SPINDLE_ON m;
            m.speed = dir * a1;
            m.spindle = a2;
            m.wait_for_spindle_at_speed = a3;
            c.give(m);
            return;
        }
    case 0: { EMC_SPINDLE_OFF m; m.spindle = static_cast<int>(a1); c.give(m); return; }
    case 10: { EMC_SPINDLE_INCREASE m; m.spindle = static_cast<int>(a1); c.give(m); return; }
    case 11: { EMC_SPINDLE_DECREASE m; m.spindle = static_cast<int>(a1); c.give(m); return; }
    case 12: { EMC_SPINDLE_CONSTANT m; m.spindle = static_cast<int>(a1); c.give(m); return; }
    default:
        throw py::value_error("Spindle direction should be SPINDLE_FORWARD, SPINDLE_REVERSE, SPINDLE_OFF, "
                              "SPINDLE_INCREASE, SPINDLE_DECREASE, or SPINDLE_CONSTANT");
    }
}

void jog(Command &c, const py::args &a) {
    if (a.size() < 3)
        throw py::type_error("function takes at least 3 arguments (" + std::to_string(a.size()) + " given)");
    if (a.size() > 5)
        throw py::type_error("function takes at most 5 arguments (" + std::to_string(a.size()) + " given)");
    int op = a[0].cast<int>(), jjogmode = a[1].cast<int>(), nr = a[2].cast<int>();
    auto count = [&](size_t n, const char *what) {
        if (a.size() != n)
            throw py::type_error(std::string("jog(") + what + ", ...) takes " + std::to_string(n) + " arguments (" +
                                 std::to_string(a.size()) + " given)");
    };
    switch (op) {
    case 0:
        {
            count(3, "JOG_STOP");
            EMC_JOG_STOP m;
            m.joint_or_axis = nr;
            m.jjogmode = jjogmode;
            c.give(m);
            return;
        }
    case 1:
        {
            count(4, "JOG_CONTINUOUS");
            EMC_JOG_CONT m;
            m.joint_or_axis = nr;
            m.jjogmode = jjogmode;
            m.vel = a[3].cast<double>();
            c.give(m);
            return;
        }
    case 2:
        {
            count(5, "JOG_INCREMENT");
            EMC_JOG_INCR m;
            m.joint_or_axis = nr;
            m.jjogmode = jjogmode;
            m.vel = a[3].cast<double>();
            m.incr = a[4].cast<double>();
            c.give(m);
            return;
        }
    default: throw py::type_error("jog() first argument must be JOG_xxx");
    }
}

bool jog_held(Command &c, int jjogmode, int nr) {
    EMC_JOG_HELD m;
    m.joint_or_axis = nr;
    m.jjogmode = jjogmode;
    return c.client.send_aside(m);
}

template <class ON, class OFF> void on_off(Command &c, int on, const char *what) {
    if (on == 1) c.plain<ON>();
    else if (on == 0) c.plain<OFF>();
    else throw py::value_error(what);
}

template <class M, size_t N> void relay(Command &c, const py::str &text, char (M::*field)[N]) {
    M m;
    copy_text(m.*field, text_of(text).c_str());
    c.give(m);
}

unsigned char octet(long v) {
    if (v < 0) {
        PyErr_SetString(PyExc_OverflowError, "unsigned byte integer is less than minimum");
        throw py::error_already_set();
    }
    if (v > 255) {
        PyErr_SetString(PyExc_OverflowError, "unsigned byte integer is greater than maximum");
        throw py::error_already_set();
    }
    return static_cast<unsigned char>(v);
}

// pybind11 reports a failed cast as RuntimeError; an argument of a wrong type is a TypeError.
template <class F> auto checked(F f) {
    return [f](Command &c, const py::args &a) {
        try {
            f(c, a);
        } catch (const py::cast_error &) {
            throw py::type_error("an argument has a wrong type");
        }
    };
}

// Waits at most timeout_s (what is no positive number: looks once), and lets Python's signals through meanwhile.
int wait_complete(Command &c, double timeout_s) {
    constexpr double SLICE_S = 0.25, FOR_EVER_S = 1e9;
    if (!c.client.status_channel().valid())
        raise_error("emcStatusBuffer invalid err=" + std::to_string(c.client.status_channel().error_type));
    double left_s = timeout_s > 0 ? std::min(timeout_s, FOR_EVER_S) : 0;
    const int64_t end = kerf_clock_now_ns() + static_cast<int64_t>(left_s * 1e9);
    for (;;) {
        int result;
        {
            py::gil_scoped_release go;
            result = c.client.wait_done(std::min(left_s, SLICE_S));
        }
        left_s = static_cast<double>(end - kerf_clock_now_ns()) * 1e-9;
        if (result != -1 || left_s <= 0) return result;
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    }
}

void define_command(py::module_ &m) {
    py::class_<Command> cls(m, "command", py::dynamic_attr(),
                            "Commands to the controller; each returns when task has read it");
    cls.def(py::init([](const py::args &, const py::kwargs &) { return std::make_unique<Command>(); }));
    cls.def_property_readonly(
        "serial", [](const Command &c) { return c.client.serial(); }, "serial number of the last command");
    cls.def("abort", [](Command &c) { c.plain<EMC_TASK_ABORT>(); }, "Stops everything");
    cls.def("take_control", &take_control, py::arg("name"),
            "take_control(name): only this program commands the machine from now on; see stat.control_pid");
    cls.def(
        "release_control", [](Command &c) { c.plain<EMC_TASK_RELEASE_CONTROL>(); },
        "Everybody commands the machine again");
    cls.def("mdi_cancel", &mdi_cancel, py::arg("serial"),
            "mdi_cancel(serial): takes the MDI line that this command brought out of those that wait (stat.mdi_queue); "
            "0: all of them");
    cls.def("restore", &restore, py::arg("line"),
            "restore(line): shows what a start at that line would restore first (stat.restore_text); nothing moves");
    cls.def("restore_confirm", &restore_confirm, py::arg("line"),
            "restore_confirm(line): restores what was shown for that line, then runs from there");
    cls.def("auto", checked(automatic),
            "auto(AUTO_RUN, line) or auto(AUTO_PAUSE | AUTO_RESUME | AUTO_STEP | AUTO_REVERSE | AUTO_FORWARD)");
    cls.def("brake", [](Command &c, int state, int spindle) {
            if (state == 1) { EMC_SPINDLE_BRAKE_ENGAGE b; b.spindle = spindle; c.give(b); }
            else if (state == 0) { EMC_SPINDLE_BRAKE_RELEASE b; b.spindle = spindle; c.give(b); }
            else throw py::value_error("BRAKE should be BRAKE_ENGAGE or BRAKE_RELEASE");
        }, py::arg("state"), py::arg("spindle") = 0);
    cls.def("debug", [](Command &c, int bits) {
        one_value<EMC_SET_DEBUG, unsigned, &EMC_SET_DEBUG::debug>(c, static_cast<unsigned>(bits));
    });
    cls.def("display_msg",
            [](Command &c, const py::str &s) { relay<EMC_OPERATOR_DISPLAY>(c, s, &EMC_OPERATOR_DISPLAY::display); });
    cls.def("error_msg",
            [](Command &c, const py::str &s) { relay<EMC_OPERATOR_ERROR>(c, s, &EMC_OPERATOR_ERROR::error); });
    cls.def("text_msg", [](Command &c, const py::str &s) { relay<EMC_OPERATOR_TEXT>(c, s, &EMC_OPERATOR_TEXT::text); });
    cls.def("feedrate", &one_value<EMC_TRAJ_SET_SCALE, double, &EMC_TRAJ_SET_SCALE::scale>,
            "Feed override, 1.0 = 100 %");
    cls.def("rapidrate", &one_value<EMC_TRAJ_SET_RAPID_SCALE, double, &EMC_TRAJ_SET_RAPID_SCALE::scale>,
            "Rapid override, 1.0 = 100 %");
    cls.def("maxvel", &one_value<EMC_TRAJ_SET_MAX_VELOCITY, double, &EMC_TRAJ_SET_MAX_VELOCITY::velocity>,
            "Cap of the path velocity, machine units/s");
    cls.def("spindleoverride", [](Command &c, double scale, int spindle) {
            EMC_TRAJ_SET_SPINDLE_SCALE s;
            s.scale = scale;
            s.spindle = spindle;
            c.give(s);
        }, py::arg("scale"), py::arg("spindle") = 0, "Spindle override, 1.0 = 100 %");
    cls.def("flood", [](Command &c, int on) {
        on_off<EMC_COOLANT_FLOOD_ON, EMC_COOLANT_FLOOD_OFF>(c, on, "FLOOD should be FLOOD_ON or FLOOD_OFF");
    });
    cls.def("mist", [](Command &c, int on) {
        on_off<EMC_COOLANT_MIST_ON, EMC_COOLANT_MIST_OFF>(c, on, "Mist should be MIST_ON or MIST_OFF");
    });
    cls.def("home", &one_value<EMC_JOINT_HOME, int, &EMC_JOINT_HOME::joint>, "Homes a joint, -1 all");
    cls.def("unhome", &one_value<EMC_JOINT_UNHOME, int, &EMC_JOINT_UNHOME::joint>,
            "Unhomes a joint, -1 all, -2 those with volatile home");
    cls.def("jog", checked(jog),
            "jog(JOG_STOP, jjogmode, nr), jog(JOG_CONTINUOUS, jjogmode, nr, vel), jog(JOG_INCREMENT, jjogmode, nr, "
            "vel, distance)");
    cls.def("jog_held", &jog_held, py::arg("jjogmode"), py::arg("nr"),
            "jog_held(jjogmode, nr): the key of this continuous jog is still down. From the first such message on task "
            "stops the jog when the next one does not come within 0.25 s. Returns at once; False: not sent");
    cls.def("load_tool_table", [](Command &c) { c.plain<EMC_TOOL_LOAD_TOOL_TABLE>(); });
    cls.def("mdi", &mdi, "Executes one line of G-code");
    cls.def("mode", [](Command &c, int mode) {
        if (mode < 1 || mode > 3) throw py::value_error("Mode should be MODE_MDI, MODE_MANUAL, or MODE_AUTO");
        EMC_TASK_SET_MODE s;
        s.mode = mode;
        c.give(s);
    });
    cls.def("state", [](Command &c, int state) {
        if (state < 1 || state > 4)
            throw py::value_error("Machine state should be STATE_ESTOP, STATE_ESTOP_RESET, STATE_ON, or STATE_OFF");
        EMC_TASK_SET_STATE s;
        s.state = state;
        c.give(s);
    });
    cls.def("override_limits", [](Command &c) { c.plain<EMC_JOINT_OVERRIDE_LIMITS>(); });
    cls.def("program_open", &program_open, "Opens a program file");
    cls.def("reset_interpreter", [](Command &c) { c.plain<EMC_TASK_PLAN_INIT>(); });
    cls.def("task_plan_synch", [](Command &c) { c.plain<EMC_TASK_PLAN_SYNCH>(); });
    cls.def("set_adaptive_feed", [](Command &c, long on) { EMC_MOTION_ADAPTIVE s; s.status = octet(on); c.give(s); });
    cls.def("set_feed_hold", [](Command &c, long on) { EMC_TRAJ_SET_FH_ENABLE s; s.mode = octet(on); c.give(s); });
    cls.def("set_feed_override", [](Command &c, long on) { EMC_TRAJ_SET_FO_ENABLE s; s.mode = octet(on); c.give(s); });
    cls.def("set_spindle_override", [](Command &c, long on, int spindle) {
            EMC_TRAJ_SET_SO_ENABLE s;
            s.mode = octet(on);
            s.spindle = spindle;
            c.give(s);
        }, py::arg("on"), py::arg("spindle") = 0);
    cls.def("set_analog_output", [](Command &c, long index, double value) {
        EMC_MOTION_SET_AOUT s;
        s.index = octet(index);
        s.now = 1;
        s.start = s.end = value;
        c.give(s);
    });
    cls.def("set_digital_output", [](Command &c, long index, long value) {
        EMC_MOTION_SET_DOUT s;
        s.index = octet(index);
        s.now = 1;
        s.start = s.end = octet(value);
        c.give(s);
    });
    cls.def("set_block_delete", [](Command &c, int on) {
        EMC_TASK_PLAN_SET_BLOCK_DELETE s;
        s.state = on != 0;
        c.give(s);
    });
    cls.def("set_optional_stop", [](Command &c, int on) {
        EMC_TASK_PLAN_SET_OPTIONAL_STOP s;
        s.state = on != 0;
        c.give(s);
    });
    cls.def("set_max_limit", [](Command &c, int joint, double limit) {
        EMC_JOINT_SET_MAX_POSITION_LIMIT s;
        s.joint = joint;
        s.limit = limit;
        c.give(s);
    });
    cls.def("set_min_limit", [](Command &c, int joint, double limit) {
        EMC_JOINT_SET_MIN_POSITION_LIMIT s;
        s.joint = joint;
        s.limit = limit;
        c.give(s);
    });
    cls.def(
        "spindle", checked(set_spindle),
        "spindle(SPINDLE_FORWARD | SPINDLE_REVERSE, rpm[, spindle[, wait]]), spindle(SPINDLE_OFF | ...[, spindle])");
    cls.def("teleop_enable", &one_value<EMC_TRAJ_SET_TELEOP_ENABLE, int, &EMC_TRAJ_SET_TELEOP_ENABLE::enable>);
    cls.def("traj_mode", &one_value<EMC_TRAJ_SET_MODE, int, &EMC_TRAJ_SET_MODE::mode>);
    cls.def("tool_offset", [](Command &c, int toolno, double z, double x, double diameter, double front, double back,
                              int orientation) {
        EMC_TOOL_SET_OFFSET s;
        s.toolno = toolno;
        s.offset.tran.z = z;
        s.offset.tran.x = x;
        s.diameter = diameter;
        s.frontangle = front;
        s.backangle = back;
        s.orientation = orientation;
        c.give(s);
    });
    cls.def("wait_complete", &wait_complete, py::arg("timeout") = 5.0,
            "Waits for the last command: RCS_DONE, RCS_ERROR, or -1 after timeout seconds");
}

// ---- error channel ----

class ErrorChannel {
public:
    ErrorChannel() : channel(std::make_unique<NML>(emc_messages(), "emcError", "xemc", file().c_str())) {}
    std::unique_ptr<NML> channel;

    py::object poll() {
        if (!channel->valid()) raise_error("Error buffer invalid");
        NMLTYPE type = channel->read();
        if (type == 0) return py::none();
        if (type < 0) raise_error("Error buffer invalid"); // the server is gone
        py::object text;
        switch (type) {
        case NML_ERROR_TYPE_: text = to_python(channel->get<::NML_ERROR>()->error); break;
        case NML_TEXT_TYPE: text = to_python(channel->get<NML_TEXT>()->text); break;
        case NML_DISPLAY_TYPE: text = to_python(channel->get<NML_DISPLAY>()->display); break;
        case EMC_OPERATOR_ERROR_TYPE: text = to_python(channel->get<EMC_OPERATOR_ERROR>()->error); break;
        case EMC_OPERATOR_TEXT_TYPE: text = to_python(channel->get<EMC_OPERATOR_TEXT>()->text); break;
        case EMC_OPERATOR_DISPLAY_TYPE: text = to_python(channel->get<EMC_OPERATOR_DISPLAY>()->display); break;
        default: text = py::str("unrecognized error " + std::to_string(type)); break;
        }
        return py::make_tuple(type, text);
    }
private:
    static std::string file() { std::string f = nml_file(); return f.empty() ? default_nml_config_file() : f; }
    static constexpr NMLTYPE NML_ERROR_TYPE_ = 1;
};

void define_error_channel(py::module_ &m) {
    py::class_<ErrorChannel> cls(m, "error_channel", py::dynamic_attr(),
                                 "Messages to the operator; each is given to one reader");
    cls.def(py::init([](const py::args &, const py::kwargs &) { return std::make_unique<ErrorChannel>(); }));
    cls.def("poll", &ErrorChannel::poll, "The oldest message as (kind, text), or None");
}

// ---- message log ----

// The last messages to the operator; every reader sees them all.
class MessageLog {
public:
    MessageLog() {
        std::string f = nml_file();
        channel_ = std::make_unique<NML>(emc_messages(), "emcMessages", "xemc", f.empty() ? nullptr : f.c_str());
    }
    int missed = 0; // messages that came and went between two polls

    py::list poll() {
        if (!channel_->valid()) raise_error("emcMessages buffer invalid err=" + std::to_string(channel_->error_type));
        py::list news;
        if (channel_->peek() != EMC_MESSAGE_LOG_TYPE) return news;
        const EMC_MESSAGE_LOG &log = *channel_->get<EMC_MESSAGE_LOG>();
        int oldest = std::max(1, log.count - EMC_MESSAGE_LOG_LENGTH + 1);
        if (seen_ > log.count) seen_ = 0; // another controller was started
        if (seen_ > 0 && oldest > seen_ + 1) missed += oldest - seen_ - 1;
        for (int n = std::max(oldest, seen_ + 1); n <= log.count; n++) {
            int at = n % EMC_MESSAGE_LOG_LENGTH;
            py::dict d;
            d["number"] = n;
            d["kind"] = log.kind[at];
            d["text"] = to_python(log.text[at]);
            d["source"] = log.source[at] == EMC_SOURCE_MOTION ? "motion" : "task";
            d["command"] = log.command[at];
            d["time"] = log.time[at];
            news.append(d);
        }
        seen_ = log.count;
        return news;
    }
private:
    std::unique_ptr<NML> channel_;
    int seen_ = 0;
};

void define_message_log(py::module_ &m) {
    py::class_<MessageLog> cls(m, "message_log", py::dynamic_attr(),
                               "The last messages to the operator; every reader sees them all");
    cls.def(py::init<>());
    cls.def("poll", &MessageLog::poll, "Those since the last poll as dicts: number, kind, text, source, command, time");
    cls.def_readonly("missed", &MessageLog::missed, "messages that came and went between two polls");
}

void define_constants(py::module_ &m) {
#define C(NAME, VALUE) m.attr(#NAME) = VALUE;
#include "constants.def"
#undef C
}

} // namespace

Stat::Stat(const std::string &nmlfile)
    : channel(std::make_unique<NML>(emc_messages(), "emcStatus", "xemc", nmlfile.empty() ? nullptr : nmlfile.c_str())) {
    unsigned char *raw = reinterpret_cast<unsigned char *>(&data);
    std::memset(raw, 0, sizeof data); // all attributes are zero before the first poll
}

PYBIND11_MODULE(linuxcnc, m) {
    verbose_nml_error_messages = 0;
    set_rcs_print_destination(RCS_PRINT_TO_NULL);
    m.doc() = "Interface to a running controller";
    linuxcnc_error = PyErr_NewException("linuxcnc.error", PyExc_RuntimeError, nullptr);
    m.attr("error") = py::reinterpret_borrow<py::object>(linuxcnc_error);
    m.attr("PREFIX") = kerf_path(KERF_PATH_HOME);
    m.attr("SHARE") = std::string(kerf_path(KERF_PATH_HOME)) + "/share";
    m.attr("nmlfile") = kerf_path(KERF_PATH_NMLFILE);
    m.attr("version") = KERF_VERSION;
    define_tool_type(m);
    define_stat(m);
    define_command(m);
    define_error_channel(m);
    define_message_log(m);
    define_ini(m);
    define_positionlogger(m);
    define_constants(m);
}
