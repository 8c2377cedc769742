// SPDX-License-Identifier: GPL-2.0-or-later
//
// kerf_clock.cc - Python module kerf_clock: the clock of kerf_clock.h for scripts. [task]
// Times are seconds (float). Every wait lets other Python threads run.

#include <pybind11/pybind11.h>
#include <stdexcept>
#include "kerf_clock.h"
#include "kerf_instance.h"

namespace py = pybind11;

static void check(int result, const char *what)
{
    if (result < 0) throw std::runtime_error(std::string(what) + ": error " + std::to_string(-result));
}

PYBIND11_MODULE(kerf_clock, m)
{
    m.doc() = "The controller's clock, real or virtual (KERF_CLOCK). Times in seconds.";
    m.attr("SLOT_ENV") = KERF_CLOCK_SLOT_ENV;
    m.def("now", [] { return double(kerf_clock_now_ns()) * 1e-9; }, "present time, s");
    m.def("now_ns", &kerf_clock_now_ns, "present time, ns");
    m.def("is_virtual", [] { return kerf_clock_is_virtual() != 0; });
    m.def("pace", &kerf_clock_pace, "multiple of wall time; 0 = as fast as possible");
    m.def("sleep", [](double s) {
        py::gil_scoped_release release;
        kerf_clock_sleep_ns(int64_t(s * 1e9 + 0.5));
    }, py::arg("seconds"));
    m.def("sleep_until_ns", [](int64_t when) {
        py::gil_scoped_release release;
        kerf_clock_sleep_until_ns(when);
    });
    m.def("join", [](const std::string &name, int priority) {
        py::gil_scoped_release release;
        check(kerf_clock_join(name.c_str(), priority), "join");
    }, py::arg("name"), py::arg("priority") = KERF_CLOCK_PRIO_USER);
    m.def("leave", &kerf_clock_leave);
    m.def("joined", [] { return kerf_clock_joined() != 0; });
    m.def("suspend", &kerf_clock_suspend);
    m.def("resume", [] {
        py::gil_scoped_release release;
        kerf_clock_resume();
    });
    m.def("lend", [] {
        char value[KERF_CLOCK_SLOT_LEN];
        check(kerf_clock_lend(value, sizeof value), "lend");
        return std::string(value);
    }, "lends this thread's place to a child; the value goes into its environment");
    m.def("reclaim", [] {
        py::gil_scoped_release release;
        kerf_clock_reclaim();
    });
    m.def("reserve", [](const std::string &name, int priority) {
        char value[KERF_CLOCK_SLOT_LEN];
        check(kerf_clock_reserve(value, sizeof value, name.c_str(), priority), "reserve");
        return std::string(value);
    }, py::arg("name"), py::arg("priority") = KERF_CLOCK_PRIO_USER);
    m.def("reserved_for", [](const std::string &value, int pid) { kerf_clock_reserved_for(value.c_str(), pid); });
    m.def("unreserve", [](const std::string &value) { kerf_clock_unreserve(value.c_str()); });
    m.def("instance_key", &kerf_instance_key);
}
