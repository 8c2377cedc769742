// SPDX-License-Identifier: GPL-2.0-or-later
//
// ini_section.hh - command line and INI section of the drive programs vfs11_vfd and vfdb_vfd.
// Source: Modbus sheet, section 6.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "inifile.hh"
#include "modbus_link.hh"

namespace vfd {

/// -d -h -m -n -r -S -I, the same for all.
struct IniOptions {
    std::string name, section, file;
    bool debug = false, modbus_debug = false, report = false;
};

/// False with the status to end with.
bool parse_ini_options(int argc, char **argv, const char *about, IniOptions &options, int &status);

struct IniSettings {
    Connection connection;
    bool debug = false, modbus_debug = false;
    int poll_cycles = 10;
    double motor_hz = 50, motor_rpm = 1410, rpm_limit = 2000;
    double lowest_hz = 10, lowest_rpm = 600, highest_rpm = 5000; ///< of a nameplate; another is set back
};

/// Reads settings. A wrong one is told on stderr as PROGRAM: FILE:[SECTION]KEY: found 'x' - ...; the value then
/// stays as it was, and good() is false.
class IniSection {
public:
    explicit IniSection(const IniOptions &options);

    bool good() const { return good_; }
    void text(const char *key, std::string &value) const;
    void flag(const char *key, bool &value);
    void number(const char *key, double low, double high, double &value);
    void number(const char *key, int low, int high, int &value);
    /// One of several words; `required`: a missing one is a mistake.
    template <class T>
    void word(const char *key, const std::vector<std::pair<const char *, T>> &words, T &value, bool required = false) {
        auto found = find(key);
        std::string list;
        for (auto &[name, meaning] : words) {
            if (found && linuxcnc::IniFile::equalNoCase(name, *found)) {
                value = meaning;
                return;
            }
            list += std::string(list.empty() ? "" : ", ") + name;
        }
        if (found || required) wrong(key, found.value_or(""), "not one of: " + list);
    }

    /// What all drives have: DEBUG, MODBUS_DEBUG, DEVICE, BITS, PARITY, BAUD, STOPBITS, TARGET, POLLCYCLES and
    /// RECONNECT_DELAY.
    void common(IniSettings &settings);

private:
    std::optional<std::string> find(const char *key) const { return ini_.findString(key, options_.section); }
    void wrong(const char *key, const std::string &found, const std::string &expected);

    const IniOptions &options_;
    linuxcnc::IniFile ini_;
    bool good_;
};

} // namespace vfd
