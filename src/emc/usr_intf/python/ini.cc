// SPDX-License-Identifier: GPL-2.0-or-later
//
// ini.cc - linuxcnc.ini: INI files for Python programs. Source: Python sheet, section 5.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "inifile.hh"
#include "module.hh"

namespace py = pybind11;

namespace {

class Ini {
public:
    explicit Ini(const std::string &name) {
        if (!file.open(name)) raise_error("inifile.open(" + name + ") failed");
    }
    linuxcnc::IniFile file;
};

// pybind11 would raise a TypeError of its own; num must be an int, not a bool or a default.
int occurrence(const py::object &num) {
    if (num.is_none()) return 1;
    if (!PyLong_Check(num.ptr()))
        throw py::type_error("'" + std::string(Py_TYPE(num.ptr())->tp_name) +
                             "' object cannot be interpreted as an integer");
    int n = num.cast<int>();
    if (n < 1) raise_error("Argument 'num' must be >= 1");
    return n;
}

template <class Value> py::object value_or(const std::optional<Value> &v, const py::object &fallback) {
    return v ? py::cast(*v) : fallback;
}

template <class F> void ini_getter(py::class_<Ini> &cls, const char *name, F find, const char *doc) {
    cls.def(
        name,
        [find](Ini &i, const std::string &sec, const std::string &var, const py::object &num,
               const py::object &fallback) { return value_or(find(i.file, occurrence(num), var, sec), fallback); },
        py::arg("section"), py::arg("variable"), py::arg("num") = py::none(), py::kw_only(),
        py::arg("fallback") = py::none(), doc);
}

template <class F> void mapper(py::class_<Ini> &cls, const char *name, F map, const char *doc) {
    cls.def(
        name,
        [map](Ini &, const std::string &text, const py::object &fallback) { return value_or(map(text), fallback); },
        py::arg("text"), py::kw_only(), py::arg("fallback") = py::none(), doc);
}

} // namespace

void define_ini(py::module_ &m) {
    using linuxcnc::IniFile;
    py::class_<Ini> cls(m, "ini", py::dynamic_attr(), "An INI file");
    cls.def(py::init([](const py::object &name) { return std::make_unique<Ini>(path_of(name)); }), py::arg("filename"));
    cls.def(
        "hassection", [](Ini &i, const std::string &sec) { return i.file.hasSection(sec); },
        "True when the section is there");
    cls.def(
        "hasvariable",
        [](Ini &i, const std::string &sec, const std::string &var, const py::object &num) {
            return i.file.hasVariable(var, sec, occurrence(num));
        },
        py::arg("section"), py::arg("variable"), py::arg("num") = py::none(), "True when the variable is there");
    auto text = [](const IniFile &f, int n, const std::string &var, const std::string &sec) {
        return f.findString(n, var, sec);
    };
    auto sint = [](const IniFile &f, int n, const std::string &var, const std::string &sec) {
        return f.findSInt(n, var, sec);
    };
    auto uint = [](const IniFile &f, int n, const std::string &var, const std::string &sec) {
        return f.findUInt(n, var, sec);
    };
    auto real = [](const IniFile &f, int n, const std::string &var, const std::string &sec) {
        return f.findReal(n, var, sec);
    };
    ini_getter(
        cls, "getbool",
        [](const IniFile &f, int n, const std::string &var, const std::string &sec) { return f.findBool(n, var, sec); },
        "true/yes/on/1 or false/no/off/0");
    ini_getter(cls, "getsint", sint, "Signed integer");
    ini_getter(cls, "getint", sint, "Signed integer");
    ini_getter(cls, "getuint", uint, "Unsigned integer");
    ini_getter(cls, "getreal", real, "Floating point number");
    ini_getter(cls, "getfloat", real, "Floating point number");
    ini_getter(cls, "getstring", text, "Text");
    ini_getter(cls, "find", text, "Text");
    ini_getter(
        cls, "getlinearunits",
        [](const IniFile &f, int n, const std::string &var, const std::string &sec) {
            return f.findLinearUnits(var, sec, n);
        },
        "Units per mm");
    ini_getter(
        cls, "getangularunits",
        [](const IniFile &f, int n, const std::string &var, const std::string &sec) {
            return f.findAngularUnits(var, sec, n);
        },
        "Units per degree");
    ini_getter(
        cls, "getjointtype",
        [](const IniFile &f, int n, const std::string &var, const std::string &sec) {
            return f.findJointType(var, sec, n);
        },
        "LINEAR or ANGULAR");
    mapper(
        cls, "maplinearunits", [](const std::string &t) { return IniFile::mapLinearUnits(t); },
        "mm, inch ... to units per mm");
    mapper(
        cls, "mapangularunits", [](const std::string &t) { return IniFile::mapAngularUnits(t); },
        "deg, rad ... to units per degree");
    mapper(
        cls, "mapjointtype", [](const std::string &t) { return IniFile::mapJointType(t); }, "LINEAR, ANGULAR to 1, 2");
    cls.def("findall", [](Ini &i, const std::string &sec, const py::object &var) {
            if (!var.is_none()) return i.file.findStringAll(var.cast<std::string>(), sec);
            std::vector<std::string> all;
            for (const auto &v : i.file.findVariables(sec)) all.push_back(v.value);
            return all;
        }, py::arg("section"), py::arg("variable") = py::none(), "All values, in file order");
    cls.def("getsections", [](Ini &i) { return i.file.findSections(); }, "Names of the sections");
    cls.def("getvariables", [](Ini &i, const std::string &sec) {
            py::list l;
            for (const auto &v : i.file.findVariables(sec)) l.append(py::make_tuple(v.name, v.value));
            return l;
        }, py::arg("section") = "", "(name, value) of all variables of a section");
    cls.def("lineof", [](Ini &i, const std::string &sec, const std::string &var, const py::object &num) -> py::object {
            auto at = i.file.lineOf(var, sec, occurrence(num));
            if (!at) return py::make_tuple(py::none(), py::none());
            return py::make_tuple(at->first, at->second);
        }, py::arg("section"), py::arg("variable"), py::arg("num") = py::none(), "(file, line) where it stands");
}
