/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * replace_file.hh - files that a power cut leaves whole: how every program of ours writes what
 * it keeps. From Python: kerf.files. [task, init]; waits for the disk
 */
#ifndef KERF_REPLACE_FILE_HH
#define KERF_REPLACE_FILE_HH

#include <string>

namespace linuxcnc
{

/// Writes FILE.new, syncs it and renames it: after a power cut there is the old text or the new
/// one, never a part. The old file stays as FILE.bak if `backup`; owner and rights stay, a
/// symbolic link keeps pointing to its file, devices and pipes are written to. False: errno, the old file is untouched.
bool replace_file(const std::string &filename, const std::string &text, bool backup);

} // namespace linuxcnc

#endif
