/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * remap_ini.cc - [RS274NGC]REMAP lines and the start of the Python plugin.
 *
 * In:     the INI file
 * Out:    s.remaps, s.python
 * Thread: [task]
 * Source: remap sheet, sections 1 and 2
 */
#include <cstdarg>
#include <cstdlib>

#include <dlfcn.h>

#include "python_link.hh"
#include "remap.hh"
#include "stages.hh"

namespace ngc
{
namespace
{

enum { MAX_TOKENS = 19 };

/// One REMAP line under way.
struct Line {
    Setup &s;
    const std::string &text;
    int number;
    bool bad = false;

    void say(const char *format, ...) __attribute__((format(printf, 2, 3)))
    {
        char buf[1024];
        va_list args;
        va_start(args, format);
        vsnprintf(buf, sizeof buf, format, args);
        va_end(args);
        s.canon.operator_error(buf);
    }
    void fail(const char *format, ...) __attribute__((format(printf, 2, 3)))
    {
        char head[512];
        va_list args;
        va_start(args, format);
        vsnprintf(head, sizeof head, format, args);
        va_end(args);
        say("%s%d:REMAP = %s", head, number, text.c_str());
        bad = true;
    }
};

std::string upper(std::string text)
{
    for (char &c : text)
        if (c >= 'a' && c <= 'z') c = char(c - 32);
    return text;
}

bool argspec_ok(Line &line, const std::string &spec)
{
    for (char c : spec) {
        const bool letter = (c >= 'A' && c <= 'Z' && c != 'O') || (c >= 'a' && c <= 'z' && c != 'o');
        if (letter || c == '>' || c == '^' || c == '@') continue;
        line.fail("argspec: illegal word '%c' - ", c);
        return false;
    }
    return true;
}

// Any beginning of the keyword counts as the keyword.
bool is_option(const std::string &key, const char *keyword) {
    return strncasecmp(keyword, key.c_str(), key.size()) == 0;
}

void take_option(Line &line, Remap &r, const std::string &token, bool *group_given)
{
    Setup &s = line.s;
    const size_t equal = token.find('=');
    if (equal == token.npos) return line.fail("option '%s' - missing '=<value>: ", token.c_str());
    const std::string key = token.substr(0, equal), value = token.substr(equal + 1);
    if (value.empty()) return line.fail("option '%s' - zero length value: ", token.c_str());
    const bool python = s.python != nullptr;
    if (is_option(key, "modalgroup")) {
        r.modal_group = atoi(value.c_str());
        *group_given = true;
    } else if (is_option(key, "argspec")) {
        if (argspec_ok(line, value)) r.argspec = value;
    } else if (is_option(key, "prolog")) {
        if (!python) return line.fail("Python plugin required for prolog=, but not available: ");
        r.prolog = value;
    } else if (is_option(key, "epilog")) {
        if (!python) return line.fail("Python plugin required for epilog=, but not available: ");
        r.epilog = value;
    } else if (is_option(key, "ngc")) {
        if (!r.python.empty()) return line.fail("can't remap to an ngc file and a Python function: -  ");
        if (find_sub_file(s, value).empty()) {
            line.say("INTERP_REMAP: NGC file not found: ngc=%s\nREMAP INI Line:%d = %s\n", value.c_str(), line.number,
                     line.text.c_str());
            line.bad = true;
            return;
        }
        r.ngc = value;
    } else if (is_option(key, "python")) {
        if (!r.ngc.empty()) return line.fail("can't remap to an ngc file and a Python function: -  ");
        if (!python) {
            line.say("iNTERP_REMAP: Python plugin required for python=, but not available:\nREMAP INI line:%d = %s\n",
                     line.number, line.text.c_str());
            line.bad = true;
            return;
        }
        if (!s.python->callable("remap", value))
            return line.fail("'%s' is not a Python callable function - ", value.c_str());
        r.python = value;
    } else {
        line.say("unrecognized option '%s' in  %d:REMAP = %s", key.c_str(), line.number, line.text.c_str());
    }
}

// T, S or F
void define_letter(Line &line, RemapTable &table, const Remap &r, const Remap *&slot, bool group_given)
{
    (void)table;
    if (r.name.size() != 1) {
        line.say("%d: %c remap - only single letter code allowed", line.number, r.letter);
        line.bad = true;
        return;
    }
    if (group_given) {
        line.say("%d: %c remap - modal group setting ignored - fixed sequencing", line.number, r.letter);
        line.bad = true;
        return;
    }
    slot = &r;
}

void define_m(Line &line, RemapTable &table, Remap &r, bool group_given)
{
    char *end;
    const long code = strtol(r.name.c_str() + 1, &end, 10);
    if (end == r.name.c_str() + 1)
        return line.fail("parsing M-code: expecting integer like 'M420', got '%s' : ", r.name.c_str());
    if (!group_given) {
        line.say("warning: code '%s' : no modalgroup=<int> given, using default group %d : %d:REMAP = %s",
                 r.name.c_str(), int(MM_USER), line.number, line.text.c_str());
        r.modal_group = MM_USER;
    }
    if (r.modal_group < MM_STOP || r.modal_group > MM_USER)
        return line.fail("error: code '%s' : invalid modalgroup=<int> given (currently valid: 4..10) : ",
                         r.name.c_str());
    r.code = int(code);
    table.by_m[r.code] = &r;
}

void define_g(Line &line, RemapTable &table, Remap &r, bool group_given)
{
    int whole = 0, part = 0;
    const int fields = sscanf(r.name.c_str() + 1, "%d.%d", &whole, &part);
    if (fields < 1) return line.fail("code '%s' : can't parse G-code : ", r.name.c_str());
    if (!group_given) {
        line.say("warning: code '%s' : no modalgroup=<int> given, using default group %d : %d:REMAP = %s",
                 r.name.c_str(), int(GM_MOTION), line.number, line.text.c_str());
        r.modal_group = GM_MOTION;
    }
    if (r.modal_group != GM_MOTION)
        return line.fail("error: code '%s' : invalid modalgroup=<int> given  : ", r.name.c_str());
    r.code = r.motion_code = whole * 10 + part;
    table.by_g[r.code] = &r;
}

bool take_line_of_ini(Setup &s, RemapTable &table, const std::string &value, int number)
{
    Line line{s, value, number};
    std::vector<std::string> tokens;
    const std::string data = value.substr(0, value.find('#'));
    for (const std::string &token : linuxcnc::IniFile::split(" \t", data)) {
        if (token.empty()) continue;
        if (tokens.size() == MAX_TOKENS) break;
        tokens.push_back(token);
    }
    if (tokens.empty()) return true;
    auto r = std::make_unique<Remap>();
    r->name = tokens[0];
    r->letter = upper(tokens[0])[0];
    bool group_given = false;
    for (size_t i = 1; i < tokens.size(); ++i) take_option(line, *r, tokens[i], &group_given);
    if (line.bad) return false;
    for (const auto &known : table.all)
        if (upper(known->name) == upper(r->name)) {
            line.fail("code '%s' already remapped : ", r->name.c_str());
            return false;
        }
    if (r->ngc.empty() && r->python.empty()) {
        line.fail("code '%s' - no remap function given, use either 'python=<function>' or 'ngc=<basename>' : ",
                  r->name.c_str());
        return false;
    }
    switch (r->letter) {
    case 'T': define_letter(line, table, *r, table.t, group_given); break;
    case 'S': define_letter(line, table, *r, table.s, group_given); break;
    case 'F': define_letter(line, table, *r, table.f, group_given); break;
    case 'M': define_m(line, table, *r, group_given); break;
    case 'G': define_g(line, table, *r, group_given); break;
    default:
        line.say("REMAP BUG=%s", value.c_str());
        return true;
    }
    if (line.bad) return false;
    table.all.push_back(std::move(r));
    return true;
}

} // namespace

int load_remaps(Setup &s)
{
    s.remaps.reset();
    if (!s.have_ini) return INTERP_OK;
    const std::vector<std::string> lines = s.ini.findStringAll("REMAP", "RS274NGC");
    if (lines.empty()) return INTERP_OK;
    auto table = std::make_unique<RemapTable>();
    s.error.clear();
    bool good = true;
    for (size_t i = 0; i < lines.size(); ++i) {
        const auto place = s.ini.lineOf("REMAP", "RS274NGC", int(i) + 1);
        good = take_line_of_ini(s, *table, lines[i], place ? place->second : 0) && good;
    }
    s.remaps = std::move(table);
    return good ? INTERP_OK : INTERP_ERROR;
}

int load_python(Setup &s, Interp *self)
{
    if (!s.have_ini || !s.ini.isSet("TOPLEVEL", "PYTHON")) return INTERP_OK;
    if (!s.python) {
        void *library = dlopen("libpyplugin.so.0", RTLD_NOW | RTLD_GLOBAL);
        auto make = library ? reinterpret_cast<make_python_link_t>(dlsym(library, "kerf_make_python_link")) : nullptr;
        if (!make) {
            s.canon.operator_error((std::string("Python plugin: ") + dlerror()).c_str());
            return INTERP_OK;
        }
        s.python.reset(make(s, self));
    }
    const int status = s.python->configure(s);
    if (status < 0) {
        char text[80];
        snprintf(text, sizeof text, "Python plugin configure() failed, status = %d", status);
        s.canon.operator_error(text);
        s.python.reset();
    }
    return INTERP_OK;
}

} // namespace ngc
