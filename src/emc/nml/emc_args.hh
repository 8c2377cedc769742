// SPDX-License-Identifier: GPL-2.0-or-later
//
// emc_args.hh - what all NML programs share: the command line -ini FILE, -rcsdebug, -queryhost,
// -host HOST (anything else is left alone), and the settings of messages in the INI file. [init]
#ifndef KERF_EMC_ARGS_HH
#define KERF_EMC_ARGS_HH

#include <cstdint>
#include <string>

#include "inifile.hh"

struct EmcArgs {
    std::string ini_file = "emc.ini";
    bool ini_given = false;
    EmcArgs(int argc, char **argv);
};

// Messages of the library as [EMC]DEBUG, RCS_DEBUG, RCS_DEBUG_DEST and RCS_MAX_ERR say. Returns DEBUG.
uint64_t set_rcs_print(const linuxcnc::IniFile &ini);

// [DISPLAY]LINEAR_UNITS or ANGULAR_UNITS, in lower case: the units of a shell until a client asks for others. "auto" if
// it is missing or none that is known.
std::string unit_setting(const linuxcnc::IniFile &ini, const char *name);

#endif
