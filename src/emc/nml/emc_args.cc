// SPDX-License-Identifier: GPL-2.0-or-later
//
// emc_args.cc - see emc_args.hh.
#include "emc_args.hh"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "messages.hh"
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

uint64_t set_rcs_print(const linuxcnc::IniFile &ini) {
    uint64_t debug = ini.findUIntV("DEBUG", "EMC", 0);
    if (auto flags = ini.findUInt("RCS_DEBUG", "EMC")) set_rcs_print_flag(static_cast<uint32_t>(*flags));
    else if (debug & (EMC_DEBUG_RCS | EMC_DEBUG_NML)) set_rcs_print_flag(PRINT_EVERYTHING);
    if (auto dest = ini.findMap<RCS_PRINT_DESTINATION_TYPE>({{"STDOUT", RCS_PRINT_TO_STDOUT},
                                                             {"STDERR", RCS_PRINT_TO_STDERR},
                                                             {"FILE", RCS_PRINT_TO_FILE},
                                                             {"LOGGER", RCS_PRINT_TO_LOGGER},
                                                             {"MSGBOX", RCS_PRINT_TO_MESSAGE_BOX},
                                                             {"NULL", RCS_PRINT_TO_NULL}},
                                                            "RCS_DEBUG_DEST", "EMC"))
        set_rcs_print_destination(*dest);
    max_rcs_errors_to_print = ini.findIntV("RCS_MAX_ERR", "EMC", -1);
    return debug;
}

std::string unit_setting(const linuxcnc::IniFile &ini, const char *name) {
    std::string text = ini.findStringV(name, "DISPLAY", "auto");
    for (char &c : text) c = static_cast<char>(tolower(static_cast<unsigned char>(c)));
    for (const char *known : name[0] == 'L' ? std::array{"inch", "mm", "cm"} : std::array{"deg", "rad", "grad"})
        if (text == known) return text;
    return "auto";
}
