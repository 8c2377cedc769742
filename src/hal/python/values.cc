// SPDX-License-Identifier: GPL-2.0-or-later
//
// values.cc - HAL values to Python objects and back.

#include "values.h"

#include <algorithm>
#include <cctype>
#include <cstring>

namespace halpy {

py::object text(const char *s)
{
    if (!s) return py::none();
    return py::reinterpret_steal<py::object>(
        PyUnicode_DecodeUTF8(s, static_cast<Py_ssize_t>(strlen(s)), "surrogateescape"));
}

const char *type_word(hal_type_t type)
{
    switch (type) {
    case HAL_BIT: return "BIT";
    case HAL_FLOAT: return "FLOAT";
    case HAL_S32: return "S32";
    case HAL_U32: return "U32";
    case HAL_PORT: return "PORT";
    case HAL_S64: return "S64";
    case HAL_U64: return "U64";
    default: return "UNKNOWN";
    }
}

const char *dir_word(hal_pdir_t dir)
{
    switch (dir) {
    case HAL_IN: return "IN";
    case HAL_OUT: return "OUT";
    case HAL_IO: return "IO";
    case HAL_RO: return "RO";
    case HAL_RW: return "RW";
    default: return "UNKNOWN";
    }
}

py::object to_python(hal_query_value_u value, hal_type_t type)
{
    switch (type) {
    case HAL_BIT: return py::bool_(value.b);
    case HAL_FLOAT: return py::float_(value.r);
    case HAL_S32:
    case HAL_S64: return py::int_(value.s);
    default: return py::int_(value.u);
    }
}

hal_query_value_u cell_get(const void *cell, hal_type_t type)
{
    hal_query_value_u v = {};
    auto at = const_cast<void *>(cell);
    switch (type) {
    case HAL_BIT: v.b = hal_get_bool(static_cast<hal_bool_t>(at)); break;
    case HAL_S32: v.s = hal_get_si32(static_cast<hal_sint_t>(at)); break;
    case HAL_U32: v.u = hal_get_ui32(static_cast<hal_uint_t>(at)); break;
    default: v.u = hal_get_uint(static_cast<hal_uint_t>(at)); break;
    }
    return v;
}

void cell_set(void *cell, hal_type_t type, hal_query_value_u value)
{
    switch (type) {
    case HAL_BIT: hal_set_bool(static_cast<hal_bool_t>(cell), value.b); break;
    case HAL_S32: hal_set_si32(static_cast<hal_sint_t>(cell), static_cast<rtapi_s32>(value.s)); break;
    case HAL_U32: hal_set_ui32(static_cast<hal_uint_t>(cell), static_cast<rtapi_u32>(value.u)); break;
    default: hal_set_uint(static_cast<hal_uint_t>(cell), value.u); break;
    }
}

namespace {

// int(value), also of text. Exceptions of int() pass through.
py::object as_int(py::handle value)
{
    return py::reinterpret_steal<py::object>(
        PyUnicode_Check(value.ptr()) ? PyLong_FromUnicodeObject(value.ptr(), 10) : PyNumber_Long(value.ptr()));
}

py::object checked_int(py::handle value)
{
    py::object number = as_int(value);
    if (!number) throw py::error_already_set();
    return number;
}

bool bit_from(py::handle value)
{
    if (PyUnicode_Check(value.ptr())) {
        std::string word = py::cast<std::string>(value);
        std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::tolower(c); });
        for (const char *yes : {"1", "true", "on", "yes"})
            if (word == yes) return true;
        for (const char *no : {"0", "false", "off", "no"})
            if (word == no) return false;
    }
    if (PyFloat_Check(value.ptr())) return PyFloat_AS_DOUBLE(value.ptr()) != 0.0;
    int truth = PyObject_IsTrue(checked_int(value).ptr());
    if (truth < 0) throw py::error_already_set();
    return truth != 0;
}

double real_from(py::handle value)
{
    double number = 0;
    if (PyUnicode_Check(value.ptr())) {
        py::object parsed = py::reinterpret_steal<py::object>(PyFloat_FromString(value.ptr()));
        if (parsed) return PyFloat_AS_DOUBLE(parsed.ptr());
    } else {
        number = PyFloat_AsDouble(value.ptr());
        if (!PyErr_Occurred()) return number;
    }
    if (PyErr_ExceptionMatches(PyExc_OverflowError)) throw py::error_already_set();
    PyErr_Clear();
    throw py::type_error(std::string("Number expected, not ") + Py_TYPE(value.ptr())->tp_name);
}

rtapi_s64 sint_from(py::handle value)
{
    long long number = PyLong_AsLongLong(checked_int(value).ptr());
    if (PyErr_Occurred()) throw py::error_already_set();
    return number;
}

rtapi_u64 uint_from(py::handle value)
{
    unsigned long long number = PyLong_AsUnsignedLongLong(checked_int(value).ptr());
    if (PyErr_Occurred()) throw py::error_already_set();
    return number;
}

rtapi_s64 ranged(py::handle value, rtapi_s64 low, rtapi_s64 high)
{
    py::object integer = checked_int(value);
    int overflow = 0;
    rtapi_s64 number = PyLong_AsLongLongAndOverflow(integer.ptr(), &overflow);
    if (overflow) {
        PyErr_SetString(PyExc_OverflowError, "int too big to convert");
        throw py::error_already_set();
    }
    if (PyErr_Occurred()) throw py::error_already_set();
    if (number < low || number > high) {
        PyErr_Format(PyExc_OverflowError, "Value %lld out of range", static_cast<long long>(number));
        throw py::error_already_set();
    }
    return number;
}

hal_query_value_u convert(py::handle value, hal_type_t type)
{
    hal_query_value_u v = {};
    switch (type) {
    case HAL_BIT: v.b = bit_from(value); break;
    case HAL_FLOAT: v.r = real_from(value); break;
    case HAL_S32: v.s = ranged(value, RTAPI_INT32_MIN, RTAPI_INT32_MAX); break;
    case HAL_U32: v.u = static_cast<rtapi_u64>(ranged(value, 0, RTAPI_UINT32_MAX)); break;
    case HAL_S64: v.s = sint_from(value); break;
    default: v.u = uint_from(value); break;
    }
    return v;
}

// Python shows notes below the message of an exception.
void add_note(py::error_already_set &e, const std::string &what, hal_type_t type)
{
    try {
        e.value().attr("add_note")("while setting " + what + " of type " + type_word(type));
    } catch (py::error_already_set &) {
        // before Python 3.11 exceptions take no notes
    }
}

} // namespace

hal_query_value_u from_python(py::handle value, hal_type_t type, const std::string &what)
{
    try {
        return convert(value, type);
    } catch (py::error_already_set &e) {
        add_note(e, what, type);
        throw;
    } catch (py::builtin_exception &e) {
        e.set_error();
        py::error_already_set set;
        add_note(set, what, type);
        throw set;
    }
}

} // namespace halpy
