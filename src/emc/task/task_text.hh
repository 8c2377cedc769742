// SPDX-License-Identifier: GPL-2.0-or-later
//
// task_text.hh - text into the fixed fields of messages. [any]
#ifndef KERF_TASK_TEXT_HH
#define KERF_TASK_TEXT_HH

#include <cstring>

// Copies at most N-1 bytes, always terminated, never cutting a UTF-8 character in two.
template <size_t N> void copy_text(char (&to)[N], const char *from) {
    size_t n = strnlen(from, N);
    if (n >= N) {
        n = N - 1;
        while (n > 0 && (static_cast<unsigned char>(from[n]) & 0xc0) == 0x80) n--;
    }
    std::memset(to, 0, N);
    std::memcpy(to, from, n);
}

#endif
