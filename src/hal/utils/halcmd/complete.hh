/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * complete.hh - what may stand at the end of a command that is being typed.
 *
 * Thread: [task].
 */
#ifndef KERF_HALCMD_COMPLETE_HH
#define KERF_HALCMD_COMPLETE_HH

#include <string>
#include <vector>

namespace halcmd
{

/// Words that may follow. `before` are the complete words of the command (its name first),
/// `prefix` the beginning of the next one. HAL must be mapped for names of items to be
/// offered. want_files is set when file names fit too.
std::vector<std::string> complete(const std::vector<std::string> &before, const std::string &prefix, bool &want_files);

/// The same for a line; the words are split at blanks.
std::vector<std::string> complete_line(const std::string &line, bool &want_files);

} // namespace halcmd

#endif
