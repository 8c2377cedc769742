/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * interpreter_module.cc - Python module `interpreter`.
 *
 * Source: remap sheet, section 8
 */
#include <pybind11/stl.h>

#include <cmath>

#include "py_interp.hh"
#include "stages.hh"

namespace py = pybind11;

namespace ngc
{
namespace
{

// ---- arrays that look into the state --------------------------------------------------

/// A row of values of the interpreter; T converts to and from the element.
template <class T> struct Array {
    PyInterp owner;
    size_t size;
    std::function<T(Setup &, size_t)> get;
    std::function<void(Setup &, size_t, const T &)> set; // empty: read-only
};

template <class T> void bind_array(py::module_ &m, const char *name)
{
    py::class_<Array<T>> c(m, name);
    auto index = [](const Array<T> &a, long i) {
        if (i < 0) i += long(a.size);
        if (i < 0 || size_t(i) >= a.size) throw py::index_error("index out of range");
        return size_t(i);
    };
    c.def("__len__", [](const Array<T> &a) { return a.size; });
    c.def("__getitem__", [index](const Array<T> &a, long i) { return a.get(a.owner.get(), index(a, i)); });
    c.def("__setitem__", [index](const Array<T> &a, long i, const T &v) {
        if (!a.set) throw py::type_error("this array cannot be written");
        a.set(a.owner.get(), index(a, i), v);
    });
}

// Each kind of array has a name of its own in the documentation; values are int or float.
struct IntArray : Array<int> {};
struct FloatArray : Array<double> {};

// ---- blocks ---------------------------------------------------------------------------

/// The block at a remap level: 0 executes, n > 0 is put aside for its handler.
struct BlockRef {
    PyInterp owner;
    size_t level;
    Block &get() const
    {
        Setup &s = owner.get();
        if (level == 0 || s.remap_frames.empty()) return s.block;
        const size_t n = std::min(level, s.remap_frames.size());
        return s.remap_frames[n - 1].block;
    }
};

struct RemapRef {
    const Remap *remap;
};

py::object text_or_none(const std::string &text) {
    return text.empty() ? py::object(py::none()) : py::object(py::str(text));
}

void bind_block(py::module_ &m)
{
    py::class_<BlockRef> c(m, "Block");
    for (const char *l = "abcdefhijklpqrstuvwxyz"; *l; ++l) {
        const char letter = *l;
        const std::string flag = std::string(1, letter) + "_flag";
        const std::string number = std::string(1, letter) + (letter == 'd' ? "_number_float" : "_number");
        c.def_property(
            flag.c_str(), [letter](const BlockRef &b) { return b.get().has(letter); },
            [letter](const BlockRef &b, bool on) {
                Block &block = b.get();
                if (on) block.present |= word_bit(letter);
                else block.present &= ~word_bit(letter);
            });
        const bool whole = letter == 'h' || letter == 'l' || letter == 't';
        c.def_property(
            number.c_str(),
            [letter, whole](const BlockRef &b) -> py::object {
                const double v = b.get().has(letter) ? b.get()[letter] : -1;
                return whole ? py::object(py::int_(int(v))) : py::object(py::float_(v));
            },
            [letter](const BlockRef &b, double v) { b.get().num[word_index(letter)] = v; });
    }
    auto polar = [&](const char *flag, const char *name, char letter) {
        c.def_property_readonly(flag, [letter](const BlockRef &b) { return b.get().has(letter); });
        c.def_property(
            name, [letter](const BlockRef &b) { return b.get().value(letter, 0); },
            [letter](const BlockRef &b, double v) { b.get().num[word_index(letter)] = v; });
    };
    polar("radius_flag", "radius", '@');
    polar("theta_flag", "theta", '^');
    c.def_property_readonly("comment", [](const BlockRef &b) {
        const Block &k = b.get();
        return k.comment ? std::string(k.comment, size_t(k.comment_length)) : std::string();
    });
    c.def_property_readonly("o_name", [](const BlockRef &b) { return b.get().o_name; });
    c.def_property_readonly("o_type", [](const BlockRef &b) { return int(b.get().o_type); });
    c.def_property("line_number", [](const BlockRef &b) { return b.level ? 0 : b.get().line_number; },
                   [](const BlockRef &b, int v) { b.get().line_number = v; });
    c.def_property_readonly("saved_line_number", [](const BlockRef &b) { return b.get().line_number; });
    c.def_property("motion_to_be", [](const BlockRef &b) { return b.get().motion; },
                   [](const BlockRef &b, int v) { b.get().motion = v; });
    c.def_property_readonly("m_count", [](const BlockRef &b) { return b.get().m_count; });
    c.def_property_readonly("user_m", [](const BlockRef &b) { return b.get().user_m; });
    c.def_property_readonly("n_number", [](const BlockRef &b) { return b.get().line_number; });
    c.def_property_readonly("phase", [](const BlockRef &b) { return b.get().phase; });
    c.def_property_readonly("builtin_used", [](const BlockRef &b) { return b.get().builtin_used; });
    c.def_property_readonly("offset", [](const BlockRef &b) { return b.owner.get().line_offset; });
    c.def_property_readonly("call_type", [](const BlockRef &b) { return int(b.owner.get().frame().type); });
    c.def_property_readonly("breadcrumbs", [](const BlockRef &b) { return (1 << b.get().phase) - 1; });
    c.def_property_readonly("executing_remap", [](const BlockRef &b) -> py::object {
        const Remap *r = b.get().executing;
        return r ? py::cast(RemapRef{r}) : py::object(py::none());
    });
    c.def_property_readonly("params", [](const BlockRef &b) {
        FloatArray a;
        a.owner = b.owner;
        a.size = SUB_ARGUMENTS;
        a.get = [b](Setup &, size_t i) { return int(i) < b.get().params ? b.get().param[i] : 0.0; };
        a.set = [b](Setup &, size_t i, const double &v) { b.get().param[i] = v; };
        return a;
    });
    c.def_property_readonly("g_modes", [](const BlockRef &b) {
        IntArray a;
        a.owner = b.owner;
        a.size = GM_GROUPS;
        a.get = [b](Setup &, size_t i) { return int(b.get().g_modes[i]); };
        a.set = [b](Setup &, size_t i, const int &v) { b.get().g_modes[i] = int16_t(v); };
        return a;
    });
    c.def_property_readonly("m_modes", [](const BlockRef &b) {
        IntArray a;
        a.owner = b.owner;
        a.size = MM_GROUPS;
        a.get = [b](Setup &, size_t i) { return int(b.get().m_modes[i]); };
        a.set = [b](Setup &, size_t i, const int &v) { b.get().m_modes[i] = int16_t(v); };
        return a;
    });

    py::class_<RemapRef> r(m, "Remap");
    r.def_property_readonly("name", [](const RemapRef &x) { return x.remap->name; });
    r.def_property_readonly("argspec", [](const RemapRef &x) { return x.remap->argspec; });
    r.def_property_readonly("modal_group", [](const RemapRef &x) { return x.remap->modal_group; });
    r.def_property_readonly("prolog_func", [](const RemapRef &x) { return text_or_none(x.remap->prolog); });
    r.def_property_readonly("remap_py", [](const RemapRef &x) { return text_or_none(x.remap->python); });
    r.def_property_readonly("remap_ngc", [](const RemapRef &x) { return text_or_none(x.remap->ngc); });
    r.def_property_readonly("epilog_func", [](const RemapRef &x) { return text_or_none(x.remap->epilog); });
    r.def_property_readonly("motion_code", [](const RemapRef &x) { return x.remap->motion_code; });
    r.def("__str__", [](const RemapRef &x) {
        auto show = [](const std::string &t) { return t.empty() ? std::string("None") : t; };
        const Remap &p = *x.remap;
        return "Remap(" + p.name + " argspec=" + p.argspec + " modal_group=" + std::to_string(p.modal_group) +
               " prolog=" + show(p.prolog) + " ngc=" + show(p.ngc) + " python=" + show(p.python) +
               " epilog=" + show(p.epilog) + ") ";
    });
}

// ---- call levels ------------------------------------------------------------------------

struct ContextRef {
    PyInterp owner;
    size_t level;
    Frame &get() const { return owner.get().frames[level]; }
};

struct ParameterValueRef {
    int attr;
    double value;
};

void bind_context(py::module_ &m)
{
    py::class_<ParameterValueRef> v(m, "ParameterValue");
    v.def_readonly("attr", &ParameterValueRef::attr);
    v.def_readonly("value", &ParameterValueRef::value);
    py::class_<ContextRef> c(m, "Context");
    c.def_property_readonly("position", [](const ContextRef &x) { return x.get().offset; });
    c.def_property_readonly("sequence_number", [](const ContextRef &x) { return x.get().line; });
    c.def_property_readonly("filename", [](const ContextRef &x) {
        const Setup &s = x.owner.get();
        const int source = x.get().source;
        return source >= 0 && size_t(source) < s.sources.size() ? s.sources[size_t(source)]->path() : std::string();
    });
    c.def_property_readonly("subname", [](const ContextRef &x) { return x.get().sub; });
    c.def_property_readonly("call_type", [](const ContextRef &x) { return int(x.get().type); });
    c.def_property_readonly("context_status", [](const ContextRef &x) {
        const Frame &f = x.get();
        return int(f.modes.restore_on_return) | int(f.modes.valid) << 1 | int(f.type == CALL_REMAP) << 2;
    });
    c.def_property_readonly("saved_params", [](const ContextRef &x) {
        FloatArray a;
        a.owner = x.owner;
        a.size = SUB_ARGUMENTS;
        a.get = [x](Setup &, size_t i) { return x.get().saved_arguments[i + 1]; };
        return a;
    });
    c.def_property_readonly("saved_g_codes", [](const ContextRef &x) {
        return std::vector<int>(x.get().modes.g, x.get().modes.g + ACTIVE_G_CODES);
    });
    c.def_property_readonly("saved_m_codes", [](const ContextRef &x) {
        return std::vector<int>(x.get().modes.m, x.get().modes.m + ACTIVE_M_CODES);
    });
    c.def_property_readonly("saved_settings", [](const ContextRef &x) {
        return std::vector<double>(x.get().modes.settings, x.get().modes.settings + ACTIVE_SETTINGS);
    });
    c.def_property_readonly("named_params", [](const ContextRef &x) {
        py::dict d;
        for (const auto &e : x.get().locals)
            d[py::str(e.name)] = ParameterValueRef{int(e.value.read_only), e.value.value};
        return d;
    });
}

// ---- parameters by name or number -----------------------------------------------------

struct ParamsRef {
    PyInterp owner;
};

std::string lower(std::string text)
{
    for (char &c : text)
        if (c >= 'A' && c <= 'Z') c = char(c + 32);
    return text;
}

py::list names_of(const NameTable<NamedParameter> &table)
{
    py::list l;
    for (const auto &e : table) l.append(e.name);
    return l;
}

void bind_params(py::module_ &m)
{
    py::class_<ParamsRef> c(m, "Params");
    c.def("__getitem__", [](const ParamsRef &p, const py::object &key) -> double {
        Setup &s = p.owner.get();
        if (PyLong_Check(key.ptr())) {
            const long i = key.cast<long>();
            if (i < 0 || i > MAX_PARAMETER)
                throw std::runtime_error("params subscript out of range : " + std::to_string(i) +
                                         " - must be between 0 and 5602");
            return i == 0 ? s.parameters[0] : parameter_now(s, int(i));
        }
        if (!PyUnicode_Check(key.ptr())) throw std::runtime_error("params subscript type must be integer or string");
        const std::string name = key.cast<std::string>();
        double value;
        if (named_value(s, name, &value) || named_value(s, lower(name), &value)) return value;
        throw std::runtime_error("parameter does not exist: " + name);
    });
    c.def("__setitem__", [](const ParamsRef &p, const py::object &key, double value) {
        Setup &s = p.owner.get();
        if (PyLong_Check(key.ptr())) {
            const long i = key.cast<long>();
            if (i < 0 || i > MAX_PARAMETER)
                throw std::runtime_error("params subscript out of range : " + std::to_string(i) +
                                         " - must be between 0 and 5602");
            s.parameters[size_t(i)] = value;
            return;
        }
        if (!PyUnicode_Check(key.ptr())) throw std::runtime_error("params subscript type must be integer or string");
        const std::string name = lower(key.cast<std::string>());
        NamedParameter &n = make_named(s, name);
        if (n.read_only) throw std::runtime_error("can't assign value to parameter: " + name);
        n.value = value;
    });
    c.def("__len__", [](const ParamsRef &) { return MAX_PARAMETER + 1; });
    c.def("locals", [](const ParamsRef &p) { return names_of(p.owner.get().frame().locals); });
    c.def("globals", [](const ParamsRef &p) { return names_of(p.owner.get().globals); });
    c.def("__call__", [](const ParamsRef &p) {
        py::list l = names_of(p.owner.get().frame().locals);
        for (py::handle h : names_of(p.owner.get().globals)) l.append(h);
        return l;
    });
}

// ---- poses and tools --------------------------------------------------------------------

void bind_pose(py::module_ &m)
{
    py::class_<PmCartesian> t(m, "PmCartesian");
    t.def(py::init<>([] { return PmCartesian{}; }));
    t.def(py::init<>([](double x, double y, double z) { return PmCartesian{x, y, z}; }));
    t.def_readwrite("x", &PmCartesian::x).def_readwrite("y", &PmCartesian::y).def_readwrite("z", &PmCartesian::z);
    t.def("__str__", [](const PmCartesian &p) {
        char text[160];
        snprintf(text, sizeof text, "PmCartesian(x=%.4f y=%.4f z=%.4f)", p.x, p.y, p.z);
        return std::string(text);
    });
    py::class_<EmcPose> p(m, "EmcPose");
    p.def(py::init<>([] { return EmcPose{}; }));
    p.def_readwrite("tran", &EmcPose::tran);
    for (int i = 0; i < AXES; ++i)
        p.def_property(
            std::string(1, AXIS_LETTERS[i]).c_str(), [i](const EmcPose &e) { return axis(e, i); },
            [i](EmcPose &e, double v) { axis(e, i) = v; });
    p.def("zero", [](EmcPose &e) { e = EmcPose{}; });
    p.def("__str__", [](const EmcPose &e) {
        char text[512];
        snprintf(text, sizeof text, "EmcPose(x=%.4f y=%.4f z=%.4f a=%.4f b=%.4f c=%.4f u=%.4f v=%.4f w=%.4f)",
                 e.tran.x, e.tran.y, e.tran.z, e.a, e.b, e.c, e.u, e.v, e.w);
        return std::string(text);
    });
    py::class_<CANON_TOOL_TABLE> c(m, "CANON_TOOL_TABLE");
    c.def(py::init<>([] { return tooldata_entry_init(); }));
    c.def_readwrite("toolno", &CANON_TOOL_TABLE::toolno);
    c.def_readwrite("offset", &CANON_TOOL_TABLE::offset);
    c.def_readwrite("diameter", &CANON_TOOL_TABLE::diameter);
    c.def_readwrite("frontangle", &CANON_TOOL_TABLE::frontangle);
    c.def_readwrite("backangle", &CANON_TOOL_TABLE::backangle);
    c.def_readwrite("orientation", &CANON_TOOL_TABLE::orientation);
    c.def("zero", [](CANON_TOOL_TABLE &e) { e = tooldata_entry_init(); });
    c.def("__str__", [](const CANON_TOOL_TABLE &e) {
        char text[512];
        snprintf(
            text, sizeof text,
            "Tool(T%d D%.4f I%.4f J%.4f Q%d offset: x=%.4f y=%.4f z=%.4f a=%.4f b=%.4f c=%.4f u=%.4f v=%.4f w=%.4f)",
            e.toolno, e.diameter, e.frontangle, e.backangle, e.orientation, e.offset.tran.x, e.offset.tran.y,
            e.offset.tran.z, e.offset.a, e.offset.b, e.offset.c, e.offset.u, e.offset.v, e.offset.w);
        return std::string(text);
    });
}

// ---- the interpreter ----------------------------------------------------------------------

py::object exception_type;

[[noreturn]] void raise_fault(Setup &s)
{
    py::object e = exception_type(s.error, s.fault.line, s.fault.text);
    PyErr_SetObject(exception_type.ptr(), e.ptr());
    throw py::error_already_set();
}

py::object execute(PyInterp &p, const std::string &text, int line)
{
    Setup &s = p.get();
    if (line >= 0) s.sequence_number = line;
    const int status = run_inner(s, text.c_str());
    if (status > INTERP_MIN_ERROR) raise_fault(s);
    return py::module_::import("interpreter").attr("InterpReturn")(status);
}

template <class Class, class Member> void value(Class &c, const char *name, Member Setup::*member)
{
    c.def_property(
        name, [member](const PyInterp &p) { return p.get().*member; },
        [member](const PyInterp &p, Member v) { p.get().*member = v; });
}

template <class Class> void pose_values(Class &c, const char *const *names, EmcPose Setup::*pose)
{
    for (int i = 0; i < AXES; ++i)
        c.def_property(
            names[i], [pose, i](const PyInterp &p) { return axis(p.get().*pose, i); },
            [pose, i](const PyInterp &p, double v) { axis(p.get().*pose, i) = v; });
}

void bind_self(py::module_ &m)
{
    py::class_<PyInterp> c(m, "Interp", py::dynamic_attr());
    c.def("execute", [](PyInterp &p, const std::string &text) { return execute(p, text, -1); });
    c.def("execute", [](PyInterp &p, const std::string &text, int line) { return execute(p, text, line); });
    c.def("read", [](PyInterp &p, const std::string &text) {
        Setup &s = p.get();
        int status = take_line(s, text);
        if (status == INTERP_OK) status = read_block(s);
        return status;
    });
    c.def("find_tool_pocket", [](PyInterp &p, int toolno) {
        Setup &s = p.get();
        const int idx = tool_index(s, toolno);
        if (idx < 0) {
            (void)s.fail("find_tool_pocket", "Requested tool %d not found in the tool table", toolno);
            return py::make_tuple(int(INTERP_ERROR), 0);
        }
        return py::make_tuple(int(INTERP_OK), s.tools[size_t(idx)].pocketno);
    });
    c.def("load_tool_table", [](PyInterp &p) {
        load_tool_table(p.get());
        return int(INTERP_OK);
    });
    c.def("set_tool_parameters", [](PyInterp &p) { set_tool_parameters(p.get()); });
    c.def("set_errormsg", [](PyInterp &p, const std::string &text) {
        p.interp->set_error_text(text.empty() ? "###" : text.c_str());
    });
    c.def("get_errormsg", [](PyInterp &p) { return p.get().error; });
    c.def("stack", [](PyInterp &p) {
        py::list l;
        for (int i = 0; i < p.get().stack_size; ++i) l.append(p.get().stack[size_t(i)]);
        return l;
    });
    c.def("synch", [](PyInterp &p) { return p.interp->synch(); });

    c.def_property_readonly("task", [](const PyInterp &p) { return int(p.get().options.task); });
    c.def_property_readonly("filename", [](const PyInterp &p) { return std::string(p.interp->file()); });
    c.def_property_readonly("linetext", [](const PyInterp &p) { return std::string(p.get().raw); });

    value(c, "arc_not_allowed", &Setup::arc_not_allowed);
    value(c, "cutter_comp_firstmove", &Setup::comp_first_move);
    value(c, "feed_override", &Setup::feed_override);
    value(c, "input_digital", &Setup::input_digital);
    value(c, "input_flag", &Setup::input_flag);
    value(c, "mdi_interrupt", &Setup::mdi);
    value(c, "mist", &Setup::mist);
    value(c, "flood", &Setup::flood);
    value(c, "percent_flag", &Setup::percent_flag);
    value(c, "probe_flag", &Setup::probe_flag);
    value(c, "toolchange_flag", &Setup::toolchange_flag);
    static const char *const current[] = {"current_x", "current_y", "current_z", "AA_current", "BB_current",
                                          "CC_current", "u_current", "v_current", "w_current"};
    static const char *const g92[] = {"axis_offset_x", "axis_offset_y", "axis_offset_z", "AA_axis_offset",
                                      "BB_axis_offset", "CC_axis_offset", "u_axis_offset", "v_axis_offset",
                                      "w_axis_offset"};
    static const char *const g5x[] = {"origin_offset_x", "origin_offset_y", "origin_offset_z", "AA_origin_offset",
                                      "BB_origin_offset", "CC_origin_offset", "u_origin_offset", "v_origin_offset",
                                      "w_origin_offset"};
    pose_values(c, current, &Setup::current);
    pose_values(c, g92, &Setup::g92);
    pose_values(c, g5x, &Setup::g5x);
    value(c, "tool_offset", &Setup::tool_offset);
    value(c, "cutter_comp_radius", &Setup::comp_radius);
    value(c, "cycle_cc", &Setup::cycle_cc);
    value(c, "cycle_i", &Setup::cycle_i);
    value(c, "cycle_il", &Setup::cycle_il);
    value(c, "cycle_j", &Setup::cycle_j);
    value(c, "cycle_k", &Setup::cycle_k);
    value(c, "cycle_p", &Setup::cycle_p);
    value(c, "cycle_q", &Setup::cycle_q);
    value(c, "cycle_r", &Setup::cycle_r);
    value(c, "cycle_il_flag", &Setup::cycle_il_flag);
    value(c, "cycle_l", &Setup::cycle_l);
    value(c, "feed_rate", &Setup::feed_rate);
    value(c, "program_x", &Setup::program_x);
    value(c, "program_y", &Setup::program_y);
    value(c, "program_z", &Setup::program_z);
    value(c, "return_value", &Setup::return_value);
    value(c, "rotation_xy", &Setup::rotation);
    value(c, "traverse_rate", &Setup::traverse_rate);
    value(c, "parameter_g73_peck_clearance", &Setup::peck_g73);
    value(c, "parameter_g83_peck_clearance", &Setup::peck_g83);
    value(c, "active_spindle", &Setup::active_spindle);
    value(c, "num_spindles", &Setup::num_spindles);
    value(c, "call_level", &Setup::call_level);
    value(c, "current_pocket", &Setup::current_pocket);
    value(c, "selected_pocket", &Setup::selected_pocket);
    value(c, "selected_tool", &Setup::selected_tool);
    value(c, "cutter_comp_orientation", &Setup::comp_orientation);
    value(c, "cutter_comp_side", &Setup::comp_side);
    value(c, "debugmask", &Setup::debug_mask);
    value(c, "loggingLevel", &Setup::log_level);
    value(c, "distance_mode", &Setup::distance_mode);
    value(c, "ijk_distance_mode", &Setup::ijk_distance_mode);
    value(c, "feed_mode", &Setup::feed_mode);
    value(c, "retract_mode", &Setup::retract_mode);
    value(c, "input_index", &Setup::input_index);
    value(c, "motion_mode", &Setup::motion_mode);
    value(c, "origin_index", &Setup::origin_index);
    value(c, "random_toolchanger", &Setup::random_toolchanger);
    value(c, "remap_level", &Setup::remap_level);
    value(c, "sequence_number", &Setup::sequence_number);
    value(c, "tool_change_at_g30", &Setup::tool_change_at_g30);
    value(c, "tool_change_quill_up", &Setup::tool_change_quill_up);
    value(c, "tool_change_with_spindle_on", &Setup::tool_change_with_spindle_on);
    c.def_property("current_tool", [](const PyInterp &p) { return p.get().tools[0].toolno; },
                   [](const PyInterp &p, int v) { p.get().tools[0].toolno = v; });
    c.def_property("length_units", [](const PyInterp &p) { return int(p.get().units); },
                   [](const PyInterp &p, int v) { p.get().units = CANON_UNITS(v); });
    c.def_property("plane", [](const PyInterp &p) { return int(p.get().plane); },
                   [](const PyInterp &p, int v) { p.get().plane = CANON_PLANE(v); });
    c.def_property("value_returned", [](const PyInterp &p) { return int(p.get().value_returned); },
                   [](const PyInterp &p, int v) { p.get().value_returned = v != 0; });
    c.def_property_readonly("stack_index", [](const PyInterp &p) { return p.get().stack_size; });
    c.def_property_readonly("speed_feed_mode", [](const PyInterp &) { return int(CANON_INDEPENDENT); });
    static const char *const wrapped[] = {"a_axis_wrapped", "b_axis_wrapped", "c_axis_wrapped"};
    static const char *const indexer[] = {"a_indexer_jnum", "b_indexer_jnum", "c_indexer_jnum"};
    for (int n = 0; n < 3; ++n) {
        c.def_property_readonly(wrapped[n], [n](const PyInterp &p) { return int(p.get().wrapped[n]); });
        c.def_property_readonly(indexer[n], [n](const PyInterp &p) { return p.get().indexer_joint[n]; });
    }

    // By spindle.
    auto per_spindle = [&c](const char *name, int (*value)(const Setup &, size_t)) {
        c.def_property_readonly(name, [value](const PyInterp &p) {
            IntArray a;
            a.owner = p;
            a.size = CANON_MAX_SPINDLES;
            a.get = [value](Setup &s, size_t i) { return value(s, i); };
            return a;
        });
    };
    per_spindle("speed_override", [](const Setup &s, size_t i) { return int(s.speed_override[i]); });
    per_spindle("spindle_mode", [](const Setup &s, size_t i) { return s.spindle_mode[i]; });
    per_spindle("spindle_turning", [](const Setup &s, size_t i) { return int(s.spindle_turning[i]); });
    c.def_property_readonly("speed", [](const PyInterp &p) {
        FloatArray a;
        a.owner = p;
        a.size = CANON_MAX_SPINDLES;
        a.get = [](Setup &s, size_t i) { return s.speed[i]; };
        a.set = [](Setup &s, size_t i, const double &v) { s.speed[i] = v; };
        return a;
    });
    c.def_property_readonly("parameters", [](const PyInterp &p) {
        FloatArray a;
        a.owner = p;
        a.size = MAX_PARAMETER + 1;
        a.get = [](Setup &s, size_t i) { return i ? parameter_now(s, int(i)) : s.parameters[0]; };
        a.set = [](Setup &s, size_t i, const double &v) { s.parameters[i] = v; };
        return a;
    });
    c.def_property_readonly("active_g_codes", [](const PyInterp &p) {
        IntArray a;
        a.owner = p;
        a.size = ACTIVE_G_CODES;
        a.get = [](Setup &s, size_t i) {
            int g[ACTIVE_G_CODES];
            active_g(s, g);
            return g[i];
        };
        return a;
    });
    c.def_property_readonly("active_m_codes", [](const PyInterp &p) {
        IntArray a;
        a.owner = p;
        a.size = ACTIVE_M_CODES;
        a.get = [](Setup &s, size_t i) {
            int codes[ACTIVE_M_CODES];
            active_m(s, codes);
            return codes[i];
        };
        return a;
    });
    c.def_property_readonly("active_settings", [](const PyInterp &p) {
        FloatArray a;
        a.owner = p;
        a.size = ACTIVE_SETTINGS;
        a.get = [](Setup &s, size_t i) {
            double v[ACTIVE_SETTINGS];
            active_values(s, v);
            return v[i];
        };
        return a;
    });
    c.def_property_readonly("blocks", [](const PyInterp &p) {
        Array<BlockRef> a;
        a.owner = p;
        a.size = MAX_CALL_LEVELS;
        a.get = [p](Setup &, size_t i) { return BlockRef{p, i}; };
        return a;
    });
    c.def_property_readonly("sub_context", [](const PyInterp &p) {
        Array<ContextRef> a;
        a.owner = p;
        a.size = MAX_CALL_LEVELS;
        a.get = [p](Setup &, size_t i) { return ContextRef{p, i}; };
        return a;
    });
    c.def_property_readonly("tool_table", [](const PyInterp &p) {
        Array<CANON_TOOL_TABLE *> a;
        a.owner = p;
        a.size = CANON_POCKETS_MAX;
        a.get = [](Setup &s, size_t i) { return &s.tools[i]; };
        return a;
    });
    c.def_property_readonly("params", [](const PyInterp &p) { return ParamsRef{p}; });
    c.def_property_readonly("remaps", [](const PyInterp &p) {
        py::dict d;
        if (p.get().remaps)
            for (const auto &r : p.get().remaps->all) d[py::str(r->name)] = RemapRef{r.get()};
        return d;
    });
}

} // namespace

void bind_interpreter(py::module_ &m)
{
    // Integers that handlers compare, return and yield; a number of their own is told from them (link.cc).
    py::dict codes;
    codes["INTERP_OK"] = int(INTERP_OK);
    codes["INTERP_EXIT"] = int(INTERP_EXIT);
    codes["INTERP_EXECUTE_FINISH"] = int(INTERP_EXECUTE_FINISH);
    codes["INTERP_ENDFILE"] = int(INTERP_ENDFILE);
    codes["INTERP_FILE_NOT_OPEN"] = int(INTERP_FILE_NOT_OPEN);
    codes["INTERP_ERROR"] = int(INTERP_ERROR);
    py::object type = py::module_::import("enum").attr("IntEnum")("InterpReturn", codes);
    type.attr("__module__") = "interpreter";
    m.attr("InterpReturn") = type;
    for (const auto &code : codes) m.attr(code.first) = type(code.second);
    m.attr("INTERP_MIN_ERROR") = int(INTERP_MIN_ERROR);
    m.attr("TOLERANCE_EQUAL") = TOLERANCE_EQUAL;
    m.attr("throw_exceptions") = 1;
    m.attr("MODE_ABSOLUTE") = int(MODE_ABSOLUTE);
    m.attr("MODE_INCREMENTAL") = int(MODE_INCREMENTAL);
    m.attr("R_PLANE") = int(R_PLANE);
    m.attr("OLD_Z") = int(OLD_Z);
    m.attr("UNITS_PER_MINUTE") = int(UNITS_PER_MINUTE);
    m.attr("INVERSE_TIME") = int(INVERSE_TIME);
    m.attr("UNITS_PER_REVOLUTION") = int(UNITS_PER_REVOLUTION);
    m.attr("OFF") = int(COMP_OFF);
    m.attr("RIGHT") = int(COMP_RIGHT);
    m.attr("LEFT") = int(COMP_LEFT);
    m.attr("CONSTANT_RPM") = int(CONSTANT_RPM);
    m.attr("CONSTANT_SURFACE") = int(CONSTANT_SURFACE);
    m.def("equal", [](double a, double b) { return fabs(a - b) < TOLERANCE_EQUAL; });
    m.def("is_near_int", [](double x) { return fabs(trunc(x + 0.5) - x) < TOLERANCE_INT; });
    m.def("nearest_int", [](double x) { return int(trunc(x + 0.5)); });
    py::dict scope;
    scope["__builtins__"] = py::module_::import("builtins");
    py::exec(R"(
class InterpreterException(Exception):
    """A line given to execute() failed."""
    def __init__(self, error_message, line_number, line_text):
        Exception.__init__(self, error_message)
        self.error_message = error_message
        self.line_number = line_number
        self.line_text = line_text
    def __str__(self):
        return "%s, line %d: %s" % (self.error_message, self.line_number, self.line_text)

from enum import IntEnum
def modes(name, *values):
    return IntEnum(name, {v: n for n, v in enumerate(values)}, module="interpreter")
DISTANCE_MODE = modes("DISTANCE_MODE", "MODE_ABSOLUTE", "MODE_INCREMENTAL")
RETRACT_MODE = modes("RETRACT_MODE", "R_PLANE", "OLD_Z")
FEED_MODE = modes("FEED_MODE", "UNITS_PER_MINUTE", "INVERSE_TIME", "UNITS_PER_REVOLUTION")
CUTTER_COMP_DIRECTION = modes("CUTTER_COMP_DIRECTION", "OFF", "RIGHT", "LEFT")
SPINDLE_MODE = modes("SPINDLE_MODE", "CONSTANT_RPM", "CONSTANT_SURFACE")
)",
             scope);
    for (const char *name : {"DISTANCE_MODE", "RETRACT_MODE", "FEED_MODE", "CUTTER_COMP_DIRECTION", "SPINDLE_MODE"})
        m.attr(name) = scope[name];
    exception_type = scope["InterpreterException"];
    exception_type.attr("__module__") = "interpreter";
    exception_type.inc_ref(); // lives as long as the process
    m.attr("InterpreterException") = exception_type;

    bind_array<int>(m, "IntArrayBase");
    bind_array<double>(m, "FloatArrayBase");
    py::class_<IntArray, Array<int>>(m, "ActiveGcodesArray");
    py::class_<FloatArray, Array<double>>(m, "ParametersArray");
    bind_pose(m);
    bind_block(m);
    bind_context(m);
    bind_params(m);
    bind_array<BlockRef>(m, "BlocksArray");
    bind_array<ContextRef>(m, "SubcontextArray");
    py::class_<Array<CANON_TOOL_TABLE *>> tools(m, "ToolTableArray");
    tools.def("__len__", [](const Array<CANON_TOOL_TABLE *> &a) { return a.size; });
    tools.def(
        "__getitem__",
        [](const Array<CANON_TOOL_TABLE *> &a, size_t i) {
            if (i >= a.size) throw py::index_error("index out of range");
            return a.get(a.owner.get(), i);
        },
        py::return_value_policy::reference);
    bind_self(m);
    for (const char *same : {"ActiveMcodesArray", "GmodesArray", "MmodesArray"})
        m.attr(same) = m.attr("ActiveGcodesArray");
    for (const char *same : {"SpindleSpeedArray", "ActiveSettingsArray", "SubroutineParamsArray"})
        m.attr(same) = m.attr("ParametersArray");
    m.attr("RemapMap") = py::type::of(py::dict());
    m.attr("ParameterMap") = py::type::of(py::dict());
    m.attr("this") = py::none();
}

} // namespace ngc
