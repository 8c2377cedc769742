// SPDX-License-Identifier: GPL-2.0-or-later
//
// rcs_print.cc - see rcs_print.hh. One process, one destination.
#include "rcs_print.hh"

#include <syslog.h>

#include <cstdarg>
#include <cstdio>

#include "nml.hh"

int max_rcs_errors_to_print = -1;
int verbose_nml_error_messages = 1;

namespace {

uint32_t print_flags = PRINT_RCS_ERRORS;
RCS_PRINT_DESTINATION_TYPE destination = RCS_PRINT_TO_STDOUT;
int errors_printed = 0;

int put(const char *format, va_list args) {
    switch (destination) {
    case RCS_PRINT_TO_NULL:
        return 0;
    case RCS_PRINT_TO_LOGGER:
        vsyslog(LOG_USER | LOG_INFO, format, args);
        return 0;
    case RCS_PRINT_TO_FILE: {
        static FILE *file = fopen("rcs_print.log", "w");
        if (!file) return -1;
        int n = vfprintf(file, format, args);
        fflush(file);
        return n;
    }
    case RCS_PRINT_TO_STDERR: // no text window here: the terminal shows it
    case RCS_PRINT_TO_MESSAGE_BOX:
        return vfprintf(stderr, format, args);
    case RCS_PRINT_TO_STDOUT:
        break;
    }
    int n = vprintf(format, args);
    fflush(stdout);
    return n;
}

} // namespace

void set_rcs_print_flag(uint32_t flags) { print_flags = flags; }
void set_rcs_print_destination(RCS_PRINT_DESTINATION_TYPE d) { destination = d; }
RCS_PRINT_DESTINATION_TYPE get_rcs_print_destination() { return destination; }

int rcs_print(const char *format, ...) {
    va_list args;
    va_start(args, format);
    int n = put(format, args);
    va_end(args);
    return n;
}

int rcs_print_debug(uint32_t flag, const char *format, ...) {
    if (!(print_flags & flag)) return 0;
    va_list args;
    va_start(args, format);
    int n = put(format, args);
    va_end(args);
    return n;
}

int rcs_print_error(const char *format, ...) {
    if (!verbose_nml_error_messages || !(print_flags & PRINT_RCS_ERRORS)) return 0;
    if (max_rcs_errors_to_print >= 0 && errors_printed >= max_rcs_errors_to_print) return 0;
    errors_printed++;
    va_list args;
    va_start(args, format);
    int n = put(format, args);
    va_end(args);
    return n;
}
