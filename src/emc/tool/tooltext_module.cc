// SPDX-License-Identifier: GPL-2.0-or-later
// Python module kerf_tooltext: lines of tool tables, and files that are replaced whole. [task]
#include "replace_file.hh"
#include "tooltext.hh"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cerrno>

namespace py = pybind11;

namespace
{

// Bytes that are no UTF-8 come back as they were with surrogateescape.
py::str decoded(const std::string &text)
{
    PyObject *s = PyUnicode_DecodeUTF8(text.data(), py::ssize_t(text.size()), "surrogateescape");
    if (!s) throw py::error_already_set();
    return py::reinterpret_steal<py::str>(s);
}

py::tuple split(const std::string &line)
{
    const tooltext::Line parts = tooltext::split(line);
    py::list words;
    for (auto &w : parts.words) {
        const py::str whole = decoded(w.text); // the letter may be any character of a damaged file
        py::object letter = py::str(std::string(1, w.letter & 0x7f));
        if (w.letter & 0x80) letter = whole[py::int_(0)];
        words.append(py::make_tuple(letter, whole[py::slice(1, py::ssize_t(py::len(whole)), 1)], w.column));
    }
    if (!parts.has_comment) return py::make_tuple(words, py::none());
    return py::make_tuple(words, decoded(parts.comment));
}

[[noreturn]] void fail(const std::string &filename)
{
    PyErr_SetFromErrnoWithFilename(PyExc_OSError, filename.c_str());
    throw py::error_already_set();
}

void replace_file(const std::string &filename, const py::bytes &text, bool backup)
{
    if (!linuxcnc::replace_file(filename, text, backup)) fail(filename);
}

} // namespace

PYBIND11_MODULE(kerf_tooltext, m)
{
    m.doc() = "Lines of tool tables, as the controller reads them; files that are replaced whole.";
    m.attr("FIELDS") = py::str(tooltext::FIELDS);
    m.def("split", &split, py::arg("line"),
          "([(LETTER, text behind it, column from 1)], text behind the first semicolon or None)");
    m.def("replace_file", &replace_file, py::arg("filename"), py::arg("text"), py::arg("backup"),
          "Writes, syncs and puts in place; keeps the old file as FILE.bak if backup. OSError: the old file is "
          "untouched.");
}
