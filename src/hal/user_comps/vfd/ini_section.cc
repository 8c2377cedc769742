// SPDX-License-Identifier: GPL-2.0-or-later
//
// ini_section.cc - see ini_section.hh.
#include "ini_section.hh"

#include <getopt.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "option_values.hh"

namespace vfd {

namespace {

constexpr option LONG[] = {{"debug", 0, nullptr, 'd'},         {"help", 0, nullptr, 'h'},
                           {"ini", 1, nullptr, 'I'},           {"modbus-debug", 0, nullptr, 'm'},
                           {"name", 1, nullptr, 'n'},          {"report-device", 0, nullptr, 'r'},
                           {"section", 1, nullptr, 'S'},       {nullptr, 0, nullptr, 0}};

void usage(const char *about, const IniOptions &o) {
    printf("%s [-n NAME] [-I INIFILE] [-S SECTION] [-r] [-d] [-m]\n%s\n"
           "Defaults: %s, the environment's INI_FILE_NAME, %s.\n"
           "-r tells what the drive says of itself, -d what is done, -m the traffic (SIGUSR1 and SIGUSR2 change -d and "
           "-m).\n",
           o.name.c_str(), about, o.name.c_str(), o.section.c_str());
}

} // namespace

bool parse_ini_options(int argc, char **argv, const char *about, IniOptions &o, int &status) {
    const std::string program = o.name;
    status = 1;
    if (const char *file = getenv("INI_FILE_NAME")) o.file = file;
    for (int c; (c = getopt_long(argc, argv, "dhI:mn:rS:", LONG, nullptr)) != -1;) {
        switch (c) {
        case 'd': o.debug = true; break;
        case 'm': o.modbus_debug = true; break;
        case 'r': o.report = true; break;
        case 'I': o.file = optarg; break;
        case 'S': o.section = optarg; break;
        case 'n': if (!name_of(program.c_str(), optarg, o.name)) return false; break;
        case 'h': usage(about, o); status = 0; return false;
        default: return false;
        }
    }
    if (optind < argc) {
        fprintf(stderr, "%s: %s: not an option\n", program.c_str(), argv[optind]);
        return false;
    }
    if (!o.file.empty()) return true;
    fprintf(stderr, "%s: no INI file: give -I FILE, or set INI_FILE_NAME in the environment\n", program.c_str());
    return false;
}

IniSection::IniSection(const IniOptions &options) : options_(options), good_(ini_.open(options.file)) {
    if (!good_ || ini_.hasSection(options.section)) return;
    good_ = false;
    fprintf(stderr, "%s: %s: has no section [%s]\n", options.name.c_str(), options.file.c_str(),
            options.section.c_str());
}

void IniSection::wrong(const char *key, const std::string &found, const std::string &expected) {
    fprintf(stderr, "%s: %s:[%s]%s: found '%s' - %s\n", options_.name.c_str(), options_.file.c_str(),
            options_.section.c_str(), key, found.c_str(), expected.c_str());
    good_ = false;
}

void IniSection::text(const char *key, std::string &value) const {
    if (auto found = find(key)) value = *found;
}

void IniSection::flag(const char *key, bool &value) {
    auto found = find(key);
    if (!found) return;
    if (auto meaning = linuxcnc::IniFile::convertBool(*found)) value = *meaning;
    else wrong(key, *found, "not one of: 0, 1");
}

void IniSection::number(const char *key, double low, double high, double &value) {
    auto found = find(key);
    if (!found) return;
    auto number = linuxcnc::IniFile::convertReal(*found);
    if (number && *number >= low && *number <= high) {
        value = *number;
        return;
    }
    char expected[80];
    snprintf(expected, sizeof expected, "not a number from %g to %g", low, high);
    wrong(key, *found, expected);
}

void IniSection::number(const char *key, int low, int high, int &value) {
    auto found = find(key);
    if (!found) return;
    auto number = linuxcnc::IniFile::convertSInt(*found);
    if (number && *number >= low && *number <= high) value = static_cast<int>(*number);
    else
        wrong(key, *found, "not a whole number from " + std::to_string(low) + " to " + std::to_string(high));
}

void IniSection::common(IniSettings &settings) {
    SerialLine &line = settings.connection.line;
    flag("DEBUG", settings.debug);
    flag("MODBUS_DEBUG", settings.modbus_debug);
    text("DEVICE", line.device);
    number("BITS", 5, 8, line.bits);
    word<char>("PARITY", {{"even", 'E'}, {"odd", 'O'}, {"none", 'N'}}, line.parity);
    number("BAUD", 110, 921600, line.rate);
    number("STOPBITS", 1, 2, line.stop);
    number("TARGET", 1, 254, line.target);
    number("RECONNECT_DELAY", 0.0, 3600.0, settings.connection.reconnect_s);
    number("POLLCYCLES", 1, 1000000, settings.poll_cycles);
}

} // namespace vfd
