// SPDX-License-Identifier: GPL-2.0-or-later
//
// hal_number.cc - see hal_number.hh.
#include "hal_number.hh"

#include <unistd.h>

#include <hal.h>

namespace {

struct Membership {
    int comp;
    explicit Membership(const std::string &name) : comp(hal_init((name + std::to_string(getpid())).c_str())) {
        if (comp > 0) hal_ready(comp);
    }
    ~Membership() { if (comp > 0) hal_exit(comp); }
};

} // namespace

bool hal_number_joining(const std::string &component, const char *name, double *value) {
    static const Membership membership(component);
    return membership.comp > 0 && hal_number(name, value);
}

bool hal_number(const char *name, double *value) {
    hal_type_t type;
    hal_data_u *data = nullptr;
    bool connected;
    if (hal_get_pin_value_by_name(name, &type, &data, &connected) != 0 &&
        hal_get_signal_value_by_name(name, &type, &data, &connected) != 0 &&
        hal_get_param_value_by_name(name, &type, &data) != 0)
        return false;
    switch (type) {
    case HAL_BIT: *value = data->b ? 1 : 0; return true;
    case HAL_FLOAT: *value = data->f; return true;
    case HAL_S32: *value = data->s; return true;
    case HAL_U32: *value = data->u; return true;
    case HAL_S64: *value = static_cast<double>(data->ls); return true;
    case HAL_U64: *value = static_cast<double>(data->lu); return true;
    default: return false;
    }
}
