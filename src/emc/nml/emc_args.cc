// SPDX-License-Identifier: GPL-2.0-or-later
//
// emc_args.cc - see emc_args.hh.
#include "emc_args.hh"

#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "nml.hh"
#include "rcs_print.hh"

static void remote(const std::string &host) {
    nmlSetHostAlias(host.c_str(), "localhost");
    nmlForceRemoteConnection();
}

EmcArgs::EmcArgs(int argc, char **argv) {
    for (int i = 1; i < argc; i++) {
        std::string a = argv[i];
        if (a == "-ini") {
            if (i + 1 >= argc) {
                fprintf(stderr, "%s: -ini needs a file name\n", argv[0]);
                exit(1);
            }
            ini_file = argv[++i];
            ini_given = true;
            if (ini_file.size() > 254) {
                fprintf(stderr, "INI file name too long (max 254): %s\n", ini_file.c_str());
                exit(1);
            }
        } else if (a == "-rcsdebug") {
            set_rcs_print_flag(PRINT_EVERYTHING);
            max_rcs_errors_to_print = -1;
        } else if (a == "-host" && i + 1 < argc) {
            remote(argv[++i]);
        } else if (a == "-queryhost") {
            char host[256];
            printf("EMC Host?");
            fflush(stdout);
            if (fgets(host, sizeof host, stdin)) {
                host[strcspn(host, "\r\n")] = 0;
                if (*host) remote(host);
            }
        }
    }
}
