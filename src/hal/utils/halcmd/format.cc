/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * format.cc - see format.hh.
 */
#include "format.hh"
#include "text.hh"

#include <cctype>
#include <cerrno>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <fnmatch.h>
#include <strings.h>

namespace halcmd
{

const char *type_word(hal_type_t type)
{
    switch (type) {
    case HAL_BIT: return "bit";
    case HAL_FLOAT: return "float";
    case HAL_S32: return "s32";
    case HAL_U32: return "u32";
    case HAL_S64: return "s64";
    case HAL_U64: return "u64";
    case HAL_PORT: return "port";
    default: return "undef";
    }
}

std::string type_field(hal_type_t type) { return strf("%-5s", type_word(type)); }

hal_type_t type_of_word(const std::string &word)
{
    static const struct {
        const char *word;
        hal_type_t type;
    } words[] = {{"bit", HAL_BIT},   {"bool", HAL_BIT},  {"float", HAL_FLOAT}, {"real", HAL_FLOAT},
                 {"s32", HAL_S32},   {"u32", HAL_U32},   {"s64", HAL_S64},     {"sint", HAL_S64},
                 {"u64", HAL_U64},   {"uint", HAL_U64},  {"port", HAL_PORT}};
    for (auto &w : words)
        if (!strcasecmp(w.word, word.c_str())) return w.type;
    return HAL_TYPE_UNSPECIFIED;
}

const char *dir_word(hal_pdir_t dir)
{
    switch (dir) {
    case HAL_IN: return "IN";
    case HAL_OUT: return "OUT";
    case HAL_IO: return "I/O";
    case HAL_RO: return "RO";
    case HAL_RW: return "RW";
    default: return "???";
    }
}

const char *pin_arrow(hal_pdir_t dir)
{
    return dir == HAL_IN ? "<==" : dir == HAL_OUT ? "==>" : dir == HAL_IO ? "<=>" : "???";
}

const char *signal_arrow(hal_pdir_t dir)
{
    return dir == HAL_IN ? "==>" : dir == HAL_OUT ? "<==" : dir == HAL_IO ? "<=>" : "???";
}

std::string value_wide(hal_type_t type, const hal_query_value_u &v)
{
    switch (type) {
    case HAL_BIT: return v.b ? "                TRUE" : "               FALSE";
    case HAL_FLOAT: return strf("%20.7g", v.r);
    case HAL_U32: return strf("          0x%08lX", static_cast<unsigned long>(v.u & 0xffffffffUL));
    case HAL_U64: return strf("  0x%016llX", static_cast<unsigned long long>(v.u));
    default: return strf("%20lld", static_cast<long long>(v.s));
    }
}

std::string value_packed(hal_type_t type, const hal_query_value_u &v)
{
    switch (type) {
    case HAL_BIT: return v.b ? "TRUE" : "FALSE";
    case HAL_FLOAT: return strf("%.7g", v.r);
    case HAL_U32:
    case HAL_U64: return strf("%llu", static_cast<unsigned long long>(v.u));
    default: return strf("%lld", static_cast<long long>(v.s));
    }
}

static int parse_bit(const char *text, hal_query_value_u &v)
{
    for (const char *word : {"1", "TRUE", "ON", "YES"})
        if (!strcasecmp(text, word)) {
            v.b = true;
            return 0;
        }
    for (const char *word : {"0", "FALSE", "OFF", "NO"})
        if (!strcasecmp(text, word)) {
            v.b = false;
            return 0;
        }
    return -EINVAL;
}

int parse_value(hal_type_t type, const std::string &text, hal_query_value_u &v)
{
    const char *start = text.c_str();
    char *end = nullptr;
    errno = 0;
    switch (type) {
    case HAL_BIT: return parse_bit(start, v);
    case HAL_FLOAT: v.r = strtod(start, &end); break;
    case HAL_S32:
    case HAL_S64:
        v.s = strtoll(start, &end, 0);
        if (type == HAL_S32 && (v.s < INT_MIN || v.s > INT_MAX)) return -ERANGE;
        break;
    case HAL_U32:
    case HAL_PORT:
    case HAL_U64:
        v.u = strtoull(start, &end, 0);
        if (type != HAL_U64 && v.u > UINT_MAX) return -ERANGE;
        break;
    default: return -EBADF;
    }
    if (errno) return -errno;
    if (end == start || (*end && !isspace(static_cast<unsigned char>(*end)))) return -EINVAL;
    return 0;
}

bool matches(const Patterns &patterns, const char *name)
{
    if (patterns.empty()) return true;
    for (auto &p : patterns)
        if (!strncmp(p.c_str(), name, p.size()) || !fnmatch(p.c_str(), name, 0)) return true;
    return false;
}

} // namespace halcmd
