// SPDX-License-Identifier: GPL-2.0-or-later
//
// _hal.cc - Python module _hal: the binding under the module hal.

#include "component.h"

#include <cstring>

namespace halpy {
namespace {
PyObject *hal_error;
}

void throw_hal_error(const std::string &message)
{
    PyErr_SetString(hal_error, message.c_str());
    throw py::error_already_set();
}

void throw_hal_error(int negative_errno)
{
    throw_hal_error(std::string(strerror(-negative_errno)));
}

namespace {
void add_constants(py::module_ &m)
{
    static const struct {
        const char *name;
        long value;
    } constants[] = {
        {"HAL_BIT", HAL_BIT},     {"HAL_BOOL", HAL_BOOL}, {"HAL_FLOAT", HAL_FLOAT}, {"HAL_REAL", HAL_REAL},
        {"HAL_S32", HAL_S32},     {"HAL_U32", HAL_U32},   {"HAL_PORT", HAL_PORT},   {"HAL_S64", HAL_S64},
        {"HAL_SINT", HAL_SINT},   {"HAL_U64", HAL_U64},   {"HAL_UINT", HAL_UINT},   {"HAL_IN", HAL_IN},
        {"HAL_OUT", HAL_OUT},     {"HAL_IO", HAL_IO},     {"HAL_RO", HAL_RO},       {"HAL_RW", HAL_RW},
        {"MSG_NONE", RTAPI_MSG_NONE}, {"MSG_ERR", RTAPI_MSG_ERR}, {"MSG_WARN", RTAPI_MSG_WARN},
        {"MSG_INFO", RTAPI_MSG_INFO}, {"MSG_DBG", RTAPI_MSG_DBG}, {"MSG_ALL", RTAPI_MSG_ALL},
        {"REALTIME_TYPE_UNINITIALIZED", REALTIME_TYPE_UNINITIALIZED},
        {"REALTIME_TYPE_NONE", REALTIME_TYPE_NONE},
        {"REALTIME_TYPE_UNKNOWN", REALTIME_TYPE_UNKNOWN},
        {"REALTIME_TYPE_PREEMPT_DYNAMIC", REALTIME_TYPE_PREEMPT_DYNAMIC},
        {"REALTIME_TYPE_PREEMPT_RT", REALTIME_TYPE_PREEMPT_RT},
        {"REALTIME_TYPE_RTAI", REALTIME_TYPE_RTAI},
        {"REALTIME_TYPE_LXRT", REALTIME_TYPE_LXRT},
        {"REALTIME_TYPE_XENOMAI", REALTIME_TYPE_XENOMAI},
        {"REALTIME_TYPE_XENOMAI_EVL", REALTIME_TYPE_XENOMAI_EVL},
        {"streamer_base", 0x48535430}, {"sampler_base", 0x48534130},
    };
    for (const auto &c : constants) m.attr(c.name) = c.value;
    m.attr("is_kernelspace") = rtapi_is_kernelspace();
    m.attr("is_userspace") = rtapi_is_kernelspace() ? 0 : 1;
    m.attr("kernel_version") = "Not Available";
}
} // namespace
} // namespace halpy

PYBIND11_MODULE(_hal, m)
{
    using namespace halpy;
    m.doc() = "HAL of this controller instance: use module hal.";
    int result = hal_lib_init();
    if (result < 0)
        throw py::import_error("Initializing hal_lib returned error=" + std::to_string(result));
    hal_error = PyErr_NewException("hal.error", PyExc_Exception, nullptr);
    m.attr("error") = py::reinterpret_borrow<py::object>(hal_error);
    add_constants(m);
    bind_component(m);
    bind_stream(m);
    bind_query(m);
    m.def(
        "set_msg_level", [](int level) { rtapi_set_msg_level(level); },
        "Messages of the HAL library, MSG_NONE to MSG_ALL.");
    m.def("get_msg_level", &rtapi_get_msg_level);
    m.def("_get_realtime_type", [] { return static_cast<int>(hal_get_realtime_type()); });
    m.def("is_initialized", [] { return hal_is_init() != 0; });
    m.def("_lib_exit", &hal_lib_exit);
}
