// SPDX-License-Identifier: GPL-2.0-or-later
//
// arguments.hh - linuxcncrsh: the words after a subcommand, checked and told of. [task]
#ifndef KERF_RSH_ARGUMENTS_HH
#define KERF_RSH_ARGUMENTS_HH

#include "session.hh"

namespace rsh {

constexpr char AXES[] = "XYZABCUVW";

__attribute__((format(printf, 1, 2))) std::string text(const char *format, ...);

// A finite number, nothing after it.
bool real(const std::string &w, double *v);

// false: the client has been told what is wrong with the word, and what would be right.
bool need_whole(Session &s, const std::string &w, int *v);
bool need_real(Session &s, const std::string &w, double *v);
bool need_on_off(Session &s, const std::string &w, bool *v);
// One of these words in any case, as its index.
bool need_word(Session &s, const std::string &w, const std::vector<std::string> &words, int *index);
// A joint of the machine, or from low (-1: all, -2: those with volatile home) up.
bool need_joint(Session &s, Server &v, const std::string &w, int low, int *j);
// A spindle of the machine, -1: all.
bool need_spindle(Session &s, Server &v, const std::string &w, int *n);
// A letter of XYZABCUVW or an index 0 to 8.
bool need_axis(Session &s, const std::string &w, int *a);

} // namespace rsh

#endif
