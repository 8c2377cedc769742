/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * snapshot.hh - copies of HAL's lists, taken in one pass each, for everything that prints.
 *
 * Thread: [task]. Order is HAL's: pins, parameters, signals and functions by name,
 * components and threads the newest first.
 */
#ifndef KERF_HALCMD_SNAPSHOT_HH
#define KERF_HALCMD_SNAPSHOT_HH

#include "hal.h"

#include <map>
#include <string>
#include <vector>

namespace halcmd
{

/// A pin or parameter.
struct Item {
    std::string name, original; ///< original name when `name` is an alias, else empty
    hal_type_t type;
    hal_pdir_t dir;
    hal_query_value_u value;
    std::string signal; ///< linked to, or empty
    std::string comp;
    int comp_id;
};

struct SignalItem {
    std::string name;
    hal_type_t type;
    hal_query_value_u value;
    int writers, readers, bidirs;
};

struct CompItem {
    std::string name;
    int id;
    hal_comp_type_t type;
    int pid;
    bool ready, has_args;
    std::string args;
};

struct FunctItem {
    std::string name, comp;
    int comp_id, users;
    unsigned long long code, arg;
    bool reentrant;
};

struct ThreadItem {
    std::string name, comp;
    int priority;
    long period; ///< ns
    std::vector<std::string> cyclic, init;
    bool timed; ///< time and tmax were found
    long time, tmax; ///< ns
};

std::vector<Item> list_pins();
std::vector<Item> list_params();
std::vector<SignalItem> list_signals();
std::vector<CompItem> list_comps();
std::vector<FunctItem> list_functs();
std::vector<ThreadItem> list_threads();

/// Pins of every signal, in the order of their names.
using PinsOfSignal = std::map<std::string, std::vector<const Item *>>;
/// Borrows from pins.
PinsOfSignal pins_by_signal(const std::vector<Item> &pins);

} // namespace halcmd

#endif
