// SPDX-License-Identifier: GPL-2.0-or-later
//
// config.cc - reads the file of mb2hal. Source: Modbus sheet, section 1.
#include "config.hh"

#include <strings.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>

#include "inifile.hh"

namespace mb2hal {

namespace {

constexpr const char *INIT = "MB2HAL_INIT";
constexpr size_t MAX_IP = 16, MAX_DEVICE = 127;

struct Name { const char *text; Code code; bool new_only; };
constexpr Name CODES[] = {{"fnct_01_read_coils", Code::read_coils, true},
                          {"fnct_02_read_discrete_inputs", Code::read_inputs, false},
                          {"fnct_03_read_holding_registers", Code::read_holding, false},
                          {"fnct_04_read_input_registers", Code::read_input_registers, false},
                          {"fnct_05_write_single_coil", Code::write_coil, true},
                          {"fnct_06_write_single_register", Code::write_register, false},
                          {"fnct_15_write_multiple_coils", Code::write_coils, false},
                          {"fnct_16_write_multiple_registers", Code::write_registers, false}};

bool same(const std::string &a, const char *b) { return strcasecmp(a.c_str(), b) == 0; }

/// One [TRANSACTION_nn] section, with the transaction before it.
class Reader {
public:
    Reader(const linuxcnc::IniFile &ini, Config &config) : ini_(ini), config_(config) {}

    bool transaction(int number) {
        char section[32];
        snprintf(section, sizeof section, "TRANSACTION_%02d", number);
        section_ = section;
        Transaction t = before_;
        t.number = number;
        t.elements.clear();
        return link(t) && common(t) && kind(t) && elements(t) && keep(std::move(t));
    }

private:
    bool fail(const std::string &text) {
        say(config_, 1, config_.debug, "parse_transaction_section", "[" + section_ + "] " + text);
        return false;
    }

    bool missing(const std::string &keys, const char *why = "") {
        say(config_, 1, config_.debug, "parse_transaction_section",
            "required [" + section_ + "] " + keys + " not found" + why);
        return false;
    }

    std::optional<std::string> text(const char *key) { return ini_.findString(key, section_); }

    /// A setting that the transaction before gives when it is missing. The first has no one before it, nor has one
    /// of another link type.
    template <class T> bool inherited(const char *key, std::optional<T> found, T &value) {
        if (found) value = *found;
        else if (!inherits_) return missing(std::string("[") + key + "]", ", and previous LINK_TYPE is useless");
        return true;
    }

    bool number(const char *key, int &value, int low, int high, bool required) {
        if (!ini_.isSet(key, section_)) {
            if (required && !inherits_) return inherited<int>(key, std::nullopt, value);
            return true;
        }
        auto found = ini_.findInt(key, section_);
        if (!found || *found < low || *found > high)
            return fail(std::string(key) + " = " + ini_.findString(key, section_).value_or("") +
                        ": must be a number from " + std::to_string(low) + " to " + std::to_string(high));
        value = *found;
        return true;
    }

    bool link(Transaction &t) {
        auto type = text("LINK_TYPE");
        if (!type && before_type_.empty()) return missing("[LINK_TYPE]");
        std::string word = type.value_or(before_type_);
        if (!same(word, "tcp") && !same(word, "serial")) return fail("LINK_TYPE = " + word + ": must be tcp or serial");
        inherits_ = same(word, before_type_.c_str());
        if (!inherits_) t = fresh(t);
        Link l = inherits_ ? *before_.link : Link{};
        l.tcp = same(word, "tcp");
        before_type_ = word;
        if (!(l.tcp ? tcp(l) : serial(l))) return false;
        t.link = shared(l);
        return true;
    }

    /// Of another link type nothing is taken over.
    static Transaction fresh(const Transaction &t) {
        Transaction f;
        f.number = t.number;
        return f;
    }

    bool tcp(Link &l) {
        if (!inherited<std::string>("TCP_IP", text("TCP_IP"), l.ip)) return false;
        if (l.ip.size() > MAX_IP)
            return fail("TCP_IP = " + l.ip + ": more than " + std::to_string(MAX_IP) + " characters");
        return number("TCP_PORT", l.port, 1, 65535, false);
    }

    bool serial(Link &l) {
        if (!inherited<std::string>("SERIAL_PORT", text("SERIAL_PORT"), l.device)) return false;
        if (l.device.size() > MAX_DEVICE)
            return fail("SERIAL_PORT: more than " + std::to_string(MAX_DEVICE) + " characters");
        std::string parity = l.parity == 'E' ? "even" : l.parity == 'O' ? "odd" : "none";
        if (!number("SERIAL_BAUD", l.baud, 1, 10000000, true) || !number("SERIAL_BITS", l.bits, 5, 8, true) ||
            !inherited<std::string>("SERIAL_PARITY", text("SERIAL_PARITY"), parity) ||
            !number("SERIAL_STOP", l.stop, 1, 2, true))
            return false;
        if (same(parity, "even")) l.parity = 'E';
        else if (same(parity, "odd")) l.parity = 'O';
        else if (same(parity, "none")) l.parity = 'N';
        else return fail("SERIAL_PARITY = " + parity + ": must be even, odd or none");
        return true;
    }

    Link *shared(const Link &l) {
        for (auto &have : config_.links)
            if (have->tcp == l.tcp && (l.tcp ? have->ip == l.ip && have->port == l.port : have->device == l.device))
                return have.get();
        config_.links.push_back(std::make_unique<Link>(l));
        return config_.links.back().get();
    }

    bool common(Transaction &t) {
        if (!number("MB_SLAVE_ID", t.slave, 0, 255, true) ||
            !number("SERIAL_DELAY_MS", t.delay_ms, 0, 3600000, false) ||
            !number("MB_RESPONSE_TIMEOUT_MS", t.response_ms, 0, 3600000, false) ||
            !number("MB_BYTE_TIMEOUT_MS", t.byte_ms, 0, 3600000, false) || !number("DEBUG", t.debug, 0, 4, false))
            return false;
        if (ini_.isSet("MAX_UPDATE_RATE", section_)) {
            auto rate = ini_.findReal("MAX_UPDATE_RATE", section_, 0.0);
            if (!rate || !std::isfinite(*rate)) return fail("MAX_UPDATE_RATE: must be a number from 0 (Hz)");
            t.rate_hz = *rate;
        }
        return true;
    }

    bool kind(Transaction &t) {
        auto word = text("MB_TX_CODE");
        if (!word) return missing("[MB_TX_CODE]");
        for (const Name &n : CODES) {
            if (!same(*word, n.text)) continue;
            if (n.new_only && !config_.names_kinds())
                return fail("MB_TX_CODE = " + *word + ": out of range, needs [" + INIT + "] VERSION = 1.1");
            t.code = n.code;
            return true;
        }
        return fail("MB_TX_CODE = " + *word + ": out of range");
    }

    bool elements(Transaction &t) {
        if (!ini_.isSet("FIRST_ELEMENT", section_)) return missing("[FIRST_ELEMENT]");
        if (!number("FIRST_ELEMENT", t.first, 0, 65535, false)) return false;
        std::vector<std::string> names = split(text("PIN_NAMES").value_or(""));
        int count = static_cast<int>(names.size());
        if (!names.empty() && std::any_of(names.begin(), names.end(), [](const std::string &n) { return n.empty(); }))
            return fail("PIN_NAMES: an empty name");
        if (!ini_.isSet("NELEMENTS", section_)) {
            if (names.empty()) return missing("[NELEMENTS] or [PIN_NAMES]");
        } else if (!number("NELEMENTS", count, 1, 65536, false)) {
            return false;
        }
        for (int n = 0; n < count; n++) {
            char plain[16];
            snprintf(plain, sizeof plain, "%02d", n);
            Element e;
            e.name = n < static_cast<int>(names.size()) ? names[static_cast<size_t>(n)] : plain;
            t.elements.push_back(e);
        }
        return true;
    }

    static std::vector<std::string> split(const std::string &list) {
        std::vector<std::string> parts;
        if (list.empty()) return parts;
        size_t at = 0;
        for (size_t comma; (comma = list.find(',', at)) != std::string::npos; at = comma + 1)
            parts.push_back(list.substr(at, comma - at));
        parts.push_back(list.substr(at));
        for (auto &p : parts) {
            p.erase(0, std::min(p.size(), p.find_first_not_of(" \t")));
            p.erase(p.find_last_not_of(" \t") + 1);
        }
        return parts;
    }

    bool keep(Transaction t) {
        char plain[16];
        snprintf(plain, sizeof plain, "%02d", t.number);
        t.name = text("HAL_TX_NAME").value_or(plain);
        before_ = t;
        config_.transactions.push_back(std::move(t));
        return true;
    }

    const linuxcnc::IniFile &ini_;
    Config &config_;
    std::string section_, before_type_;
    Transaction before_;
    bool inherits_ = false;
};

/// M.m as M * 1000 + m, or nothing.
std::optional<int> version_of(const std::string &text) {
    int major = 0, minor = 0;
    char rest;
    if (sscanf(text.c_str(), "%d.%d%c", &major, &minor, &rest) != 2 || major < 0 || major > 1000 || minor < 0 ||
        minor > 999)
        return std::nullopt;
    return major * 1000 + minor;
}

} // namespace

void say(const Config &config, int level, int debug, const char *function, const std::string &text) {
    constexpr const char *WORDS[] = {"", "ERR", "OK", "DEBUG", "DEBUGMAX"};
    if (level > debug) return;
    FILE *out = level == 1 ? stderr : stdout;
    fprintf(out, "%s %s %s: %s\n", config.module.c_str(), function, WORDS[level], text.c_str());
    fflush(out);
}

bool read_config(const std::string &path, Config &config) {
    linuxcnc::IniFile ini;
    auto fail = [&](const std::string &text) {
        say(config, 1, 1, "parse_common_section", text);
        return false;
    };
    if (!ini.open(path)) return fail("Unable to open config file " + path);
    config.module = ini.findStringV("HAL_MODULE_NAME", INIT, config.module);
    config.debug = ini.findIntV("INIT_DEBUG", INIT, config.debug);
    auto version = version_of(ini.findStringV("VERSION", INIT, "1.0"));
    if (!version) return fail(std::string("[") + INIT + "] VERSION must be like 1.1");
    config.version = *version;
    if (ini.isSet("SLOWDOWN", INIT)) {
        auto slowdown = ini.findReal("SLOWDOWN", INIT, 0.0);
        if (!slowdown || !std::isfinite(*slowdown))
            return fail(std::string("[") + INIT + "] SLOWDOWN must be a number of seconds from 0");
        config.slowdown_s = *slowdown;
    }
    int total = ini.findIntV("TOTAL_TRANSACTIONS", INIT, 0);
    if (total < 1) return fail(std::string("required [") + INIT + "] [TOTAL_TRANSACTIONS] not found or less than 1");
    Reader reader(ini, config);
    for (int n = 0; n < total; n++)
        if (!reader.transaction(n)) return false;
    return true;
}

} // namespace mb2hal
