// SPDX-License-Identifier: GPL-2.0-or-later
//
// choices.hh - options of the drive programs whose values are one of a list. Source: Modbus sheet.
#pragma once

#include <cstdio>
#include <cstring>
#include <initializer_list>

/// The one of `choices` that `text` is, or begins alone. Null, with a message on stderr, otherwise.
inline const char *one_of(const char *program, const char *what, const char *text, std::initializer_list<const char *> choices) {
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
    fprintf(stderr, "%s: %s %s: %s; possible:", program, what, text, matches > 1 ? "could be several" : "not one of the values");
    for (const char *c : choices) fprintf(stderr, " %s", c);
    fprintf(stderr, "\n");
    return nullptr;
}
