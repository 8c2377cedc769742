/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * canon.cc - what all canons share.
 */
#include "canon.hh"

#include <cstdio>

void Canon::print_line(const char *text)
{
    fputs(text, stdout);
    fputc('\n', stdout);
    fflush(stdout);
}

void Canon::operator_error(const char *text) { fprintf(stderr, "%s\n", text); }
