// SPDX-License-Identifier: GPL-2.0-or-later
//
// arguments.cc - linuxcncrsh: the words after a subcommand. Source: rsh sheet, B.5 and B.6.
#include "arguments.hh"

#include <charconv>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "task_text.hh"

namespace rsh {

std::string text(const char *format, ...) {
    char buf[1024];
    va_list a;
    va_start(a, format);
    vsnprintf(buf, sizeof buf, format, a);
    va_end(a);
    return buf;
}

static bool whole(const std::string &w, int *v) {
    const char *end = w.data() + w.size();
    const auto [stop, error] = std::from_chars(w.data() + (w[0] == '+' ? 1 : 0), end, *v);
    return error == std::errc() && stop == end;
}

bool real(const std::string &w, double *v) {
    char *end;
    *v = strtod(w.c_str(), &end);
    return !w.empty() && !*end && std::isfinite(*v);
}

bool need_whole(Session &s, const std::string &w, int *v) {
    if (whole(w, v)) return true;
    s.error("Invalid argument '" + w + "', must be integer");
    return false;
}

bool need_real(Session &s, const std::string &w, double *v) {
    if (real(w, v)) return true;
    s.error("Invalid argument '" + w + "', must be floating point");
    return false;
}

bool need_on_off(Session &s, const std::string &w, bool *v) {
    if (on_off(w, v)) return true;
    s.error("Invalid argument '" + w + "', must be {on,off}");
    return false;
}

bool need_word(Session &s, const std::string &w, const std::vector<std::string> &words, int *index) {
    std::string u = upper(w), list;
    for (size_t i = 0; i < words.size(); i++) {
        if (upper(words[i]) == u) {
            *index = static_cast<int>(i);
            return true;
        }
        list += (i ? "," : "") + words[i];
    }
    s.error("Invalid argument '" + w + "', must be {" + list + "}");
    return false;
}

bool need_joint(Session &s, Server &v, const std::string &w, int low, int *j) {
    if (!need_whole(s, w, j)) return false;
    if (*j >= low && *j < v.joints()) return true;
    s.error(text("Invalid joint '%d', valid range [%d,%d]", *j, low, v.joints() - 1));
    return false;
}

bool need_spindle(Session &s, Server &v, const std::string &w, int *n) {
    if (!need_whole(s, w, n)) return false;
    if (*n >= -1 && *n < v.spindles()) return true;
    s.error(text("Invalid spindle '%d', valid range [-1,%d]", *n, v.spindles() - 1));
    return false;
}

bool need_axis(Session &s, const std::string &w, int *a) {
    int n;
    if (whole(w, &n) && n >= 0 && n < EMCMOT_MAX_AXIS) {
        *a = n;
        return true;
    }
    const char *p = w.size() == 1 ? strchr(AXES, toupper(static_cast<unsigned char>(w[0]))) : nullptr;
    if (p && *p) {
        *a = static_cast<int>(p - AXES);
        return true;
    }
    s.error("Invalid axis '" + w + "', must be one of XYZABCUVW");
    return false;
}

} // namespace rsh
