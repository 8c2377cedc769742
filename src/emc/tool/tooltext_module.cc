// SPDX-License-Identifier: GPL-2.0-or-later
// Python module kerf_tooltext: lines of tool tables, and files that are replaced whole. [task]
#include "tooltext.hh"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cerrno>
#include <optional>

namespace py = pybind11;

namespace
{

using Words = std::vector<std::tuple<char, std::string, int>>;

std::pair<Words, std::optional<std::string>> split(const std::string &line)
{
    const tooltext::Line parts = tooltext::split(line);
    Words words;
    for (auto &w : parts.words) words.emplace_back(w.letter, w.text.substr(1), w.column);
    if (!parts.has_comment) return {words, std::nullopt};
    return {words, parts.comment};
}

[[noreturn]] void fail(const std::string &filename)
{
    PyErr_SetFromErrnoWithFilename(PyExc_OSError, filename.c_str());
    throw py::error_already_set();
}

void replace_file(const std::string &filename, const py::bytes &text, bool backup)
{
    if (!tooltext::replace_file(filename, text, backup)) fail(filename);
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
