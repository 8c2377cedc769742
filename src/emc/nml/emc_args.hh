// SPDX-License-Identifier: GPL-2.0-or-later
//
// emc_args.hh - command line that all NML programs share: -ini FILE, -rcsdebug, -queryhost,
// -host HOST. Anything else is left alone. [init]
#ifndef KERF_EMC_ARGS_HH
#define KERF_EMC_ARGS_HH

#include <string>

struct EmcArgs {
    std::string ini_file = "emc.ini";
    bool ini_given = false;
    EmcArgs(int argc, char **argv);
};

#endif
