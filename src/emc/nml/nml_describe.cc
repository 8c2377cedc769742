// SPDX-License-Identifier: GPL-2.0-or-later
//
// nml_describe.cc - documents made from the descriptions in messages.def and constants.def:
//   nml-describe docs      docs/nml-messages.md
//   nml-describe pyi FILE  type stubs of the Python module; FILE has the methods and marks where
//                          constants and status attributes go
#include <cstdio>
#include <fstream>
#include <iostream>
#include <string>

#include "messages.hh"

namespace {

// ---- C++ types in words ----

template <class T> std::string wire_type() {
    if constexpr (std::is_same_v<T, bool>) return "bool";
    else if constexpr (std::is_same_v<T, char>) return "char";
    else if constexpr (std::is_same_v<T, unsigned char>) return "uint8";
    else if constexpr (std::is_same_v<T, double>) return "double";
    else if constexpr (std::is_same_v<T, int>) return "int32";
    else if constexpr (std::is_same_v<T, unsigned>) return "uint32";
    else if constexpr (std::is_integral_v<T>) return "uint64";
    else if constexpr (std::is_same_v<T, EmcPose>) return "pose";
    else if constexpr (std::is_same_v<T, PmCartesian>) return "xyz";
    else return "structure";
}

template <class T> std::string wire_name(const T &sample) {
    using E = std::remove_cv_t<std::remove_all_extents_t<std::remove_reference_t<T>>>;
    std::string name = wire_type<E>();
    if constexpr (std::is_base_of_v<NMLmsg, E>) name = emc_symbol_lookup(E()._type);
    if constexpr (std::is_array_v<T>) name += "[" + std::to_string(sizeof sample / sizeof sample[0]) + "]";
    if constexpr (std::rank_v<T> == 2) name += "[" + std::to_string(std::extent_v<T, 1>) + "]";
    return name;
}

template <class T> std::string python_scalar() {
    if constexpr (std::is_same_v<T, bool>) return "bool";
    else if constexpr (std::is_integral_v<T>) return "int";
    else if constexpr (std::is_same_v<T, double>) return "float";
    else if constexpr (std::is_same_v<T, EmcPose>) return "Pose";
    else return "Any";
}

template <class T> std::string python_type() {
    using E = std::remove_cv_t<std::remove_extent_t<T>>;
    if constexpr (std::is_array_v<T> && std::is_same_v<E, char>) return "str";
    else if constexpr (std::is_array_v<T>) return "tuple[" + python_scalar<E>() + ", ...]";
    else return python_scalar<E>();
}

// ---- docs ----

struct Row {
    bool any = false;
    template <class T> void operator()(const nml::Field &f, const T &v) {
        any = true;
        std::string attribute = f.attribute;
        printf("| | | `%s` | %s | %s | %s |\n", f.name, wire_name(v).c_str(),
               attribute.empty() ? "" : ("`" + attribute + "`").c_str(), f.doc);
    }
};

template <class T> void document(const char *name) {
    T sample;
    printf("| %s | %d | | %s | | |\n", name, sample._type,
           std::is_base_of_v<RCS_CMD_MSG, T>    ? "command"
           : std::is_base_of_v<RCS_STAT_MSG, T> ? "status"
                                                : "message");
    Row row;
    T::fields(row, sample);
}

void docs() {
    printf(
        "<!-- Made by `objects/test/nml-describe docs` from src/emc/nml/messages.def; do not edit. -->\n"
        "# NML messages\n\n"
        "Fields stand in wire order. Commands begin with `int32 serial_number`; status structures with `int32 "
        "command_type,\n"
        "echo_serial_number, status, _state`. A pose is nine doubles x y z a b c u v w, an xyz three. mu = machine "
        "units.\n"
        "The attribute is that of Python's `linuxcnc.stat`, or the key in its `joint`, `axis` and `spindle` dicts.\n\n"
        "A new message is one entry in `messages.def`: struct, wire coding, symbol, this page and the Python attribute "
        "follow.\n\n"
        "| message | number | field | type | attribute | meaning |\n| --- | --- | --- | --- | --- | --- |\n");
#define F(...)
#define S(...)
#define L(...)
#define MSG(NAME, NUMBER, BASE, ...) document<NAME>(#NAME);
#include "messages.def"
#undef MSG
#undef F
#undef S
#undef L
}

// ---- stubs ----

void stub(const char *name, const std::string &type, const char *doc) {
    printf("    @property\n    def %s(self) -> %s:\n        \"\"\"%s\"\"\"\n", name, type.c_str(), doc);
}

struct StatStub {
    template <class T> void operator()(const nml::Field &f, const T &v) {
        if constexpr (std::is_base_of_v<NMLmsg, T>) T::fields(*this, v);
        else if constexpr (!std::is_base_of_v<NMLmsg, std::remove_extent_t<T>>) {
            if (*f.attribute) stub(f.attribute, python_type<T>(), f.doc);
        }
    }
};

struct DictStub {
    template <class T> void operator()(const nml::Field &f, const T &) {
        if constexpr (!std::is_base_of_v<NMLmsg, T>)
            if (*f.attribute) printf("    %s: %s  # %s\n", f.attribute, python_type<T>().c_str(), f.doc);
    }
};

template <class T> void dict_stub(const char *name) {
    printf("class %s(TypedDict):\n", name);
    DictStub d;
    T sample;
    T::fields(d, sample);
    printf("\n\n");
}

int pyi(const char *file) {
    std::ifstream in(file);
    if (!in) { perror(file); return 1; }
    for (std::string line; std::getline(in, line);) {
        if (line == "@constants@") {
#define C(NAME, VALUE) printf(#NAME ": Final = %d\n", VALUE);
#include "constants.def"
#undef C
        } else if (line == "@dicts@") {
            dict_stub<EMC_JOINT_STAT>("Joint");
            dict_stub<EMC_AXIS_STAT>("Axis");
            dict_stub<EMC_SPINDLE_STAT>("Spindle");
        } else if (line == "@stat@") {
            StatStub s;
            EMC_STAT sample;
            EMC_STAT::fields(s, sample);
        } else {
            printf("%s\n", line.c_str());
        }
    }
    return 0;
}

} // namespace

int main(int argc, char **argv) {
    std::string what = argc > 1 ? argv[1] : "";
    if (what == "docs") return docs(), 0;
    if (what == "pyi" && argc > 2) return pyi(argv[2]);
    fprintf(stderr, "usage: nml-describe docs | pyi FILE\n");
    return 1;
}
