/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * format.hh - HAL values, types and directions as text, and text as values.
 *
 * Thread: [any]. Source: HAL tools reference, sections 1.8 and 1.9.
 */
#ifndef KERF_HALCMD_FORMAT_HH
#define KERF_HALCMD_FORMAT_HH

#include "hal.h"

#include <string>
#include <vector>

namespace halcmd
{

const char *type_word(hal_type_t type);   ///< "bit", "float", ...
std::string type_field(hal_type_t type);  ///< the same, 5 wide
/// Type of a word as in `newsig` (case does not matter); HAL_TYPE_UNSPECIFIED if unknown.
hal_type_t type_of_word(const std::string &word);
const char *dir_word(hal_pdir_t dir);     ///< "IN", "OUT", "I/O", "RO", "RW"
const char *pin_arrow(hal_pdir_t dir);    ///< as seen from a pin: IN "<==", OUT "==>", I/O "<=>"
const char *signal_arrow(hal_pdir_t dir); ///< as seen from a signal: IN "==>", OUT "<==", I/O "<=>"

std::string value_wide(hal_type_t type, const hal_query_value_u &v);   ///< 20 wide, u32 and u64 in hex
std::string value_packed(hal_type_t type, const hal_query_value_u &v); ///< no padding, all decimal

/// Converts a text as `setp` and `sets` do. 0, -EINVAL or -ERANGE.
int parse_value(hal_type_t type, const std::string &text, hal_query_value_u &v);

/// Names to choose from: matches when there are none, or one is the beginning of the name
/// or a glob of the whole of it.
using Patterns = std::vector<std::string>;
bool matches(const Patterns &patterns, const char *name);

} // namespace halcmd

#endif
