// SPDX-License-Identifier: GPL-2.0-or-later
//
// option_values.hh - values of the options of drive programs. Source: Modbus sheet.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <string>

/// The one of `choices` that `text` is, or begins alone. Null, with a message on stderr, otherwise.
inline const char *one_of(const char *program, const char *what, const char *text,
                          std::initializer_list<const char *> choices) {
    const char *found = nullptr;
    int matches = 0;
    for (const char *c : choices) {
        if (strcmp(c, text) == 0) return c;
        if (*text && strncmp(c, text, strlen(text)) == 0) {
            found = c;
            matches++;
        }
    }
    if (matches == 1) return found;
    fprintf(stderr, "%s: %s %s: %s; possible:", program, what, text,
            matches > 1 ? "could be several" : "not one of the values");
    for (const char *c : choices) fprintf(stderr, " %s", c);
    fprintf(stderr, "\n");
    return nullptr;
}

/// The number that `text` is, from `low` to `high`. False, with a message on stderr, otherwise.
inline bool number_of(const char *program, const char *what, const char *text, double low, double high, double &value) {
    char *end = nullptr;
    value = strtod(text, &end);
    if (end != text && *end == '\0' && value >= low && value <= high) return true;
    fprintf(stderr, "%s: %s %s: must be a number from %g to %g\n", program, what, text, low, high);
    return false;
}

/// A component name that leaves room for its pins. False, with a message on stderr, otherwise.
inline bool name_of(const char *program, const char *text, std::string &name) {
    constexpr size_t MAX_NAME = 27;
    name = text;
    if (!name.empty() && name.size() <= MAX_NAME) return true;
    fprintf(stderr, "%s: name %s: must have 1 to %zu characters\n", program, text, MAX_NAME);
    return false;
}
