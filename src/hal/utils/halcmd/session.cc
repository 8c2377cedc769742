/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * session.cc - see session.hh.
 */
#include "session.hh"
#include "commands.hh"

#include "hal.h"
#include "inifile.hh"
#include "rtapi.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <strings.h>
#include <unistd.h>

namespace halcmd
{

/* ---- Texts ---- */

static void tell(FILE *to, const Place &place, const char *kind, const std::string &text)
{
    fflush(stdout); // keeps the order of both streams when they share a terminal
    fprintf(to, "%s:%d: %s%s", place.file.c_str(), place.line, kind, text.c_str());
    fflush(to);
}

void TerminalChannels::error(const Place &place, const std::string &text)
{
    tell(stderr, place, "", text + "\n");
}

void TerminalChannels::warning(const Place &place, const std::string &text)
{
    tell(stderr, place, "Warning: ", text + "\n");
}

void TerminalChannels::info(const Place &place, const std::string &text)
{
    if (level >= Level::Info) tell(stdout, place, "", text);
}

void TerminalChannels::print(const Place &place, const std::string &text)
{
    tell(stderr, place, "HALCMD MSG: ", text);
}

void TerminalChannels::output(const std::string &text) { fwrite(text.data(), 1, text.size(), stdout); }

void TerminalChannels::console(const std::string &text) { fwrite(text.data(), 1, text.size(), stdout); }

/* ---- HAL ---- */

Session::~Session() { leave(); }

int Session::attach()
{
    if (comp_id > 0) return 0;
    if (!mapped) {
        int r = hal_lib_init();
        if (r < 0) return r;
        mapped = true;
    }
    if (anonymous) return 0;
    int id = hal_init(strf("halcmd%d", static_cast<int>(getpid())).c_str());
    if (id < 0) return id;
    comp_id = id;
    return hal_ready(id);
}

void Session::detach()
{
    if (comp_id > 0) hal_exit(comp_id);
    comp_id = 0;
}

void Session::leave()
{
    detach();
    if (mapped) hal_lib_exit();
    mapped = false;
}

/* ---- Commands ---- */

Lookup Session::lookup() const
{
    Lookup l;
    l.env = [](const std::string &name) -> std::optional<std::string> {
        const char *value = getenv(name.c_str());
        return value ? std::optional<std::string>(value) : std::nullopt;
    };
    l.ini = [this](const std::string &section, const std::string &name) -> std::optional<std::string> {
        return ini ? ini->findString(name, section) : std::nullopt;
    };
    return l;
}

int Session::run_line(const std::string &line) { return run_logical(line, true); }

int Session::run_logical(std::string line, bool top_level)
{
    Args tokens;
    bool dos = false;
    std::string text, fault = line.find('\0') == std::string::npos ? strip_comment(line) : "Byte 0 in this line: the file is no text";
    if (fault.empty()) fault = substitute(line, lookup(), text);
    if (fault.empty()) fault = tokenize(text, tokens, dos);
    if (dos && !dos_warned) {
        warning("File contains DOS-style line endings.");
        dos_warned = true;
    }
    if (!fault.empty()) error(fault);
    if (echo && top_level) {
        fflush(stdout);
        fprintf(stderr, "(%d)<echo>: %s\n", place.line, line.c_str());
        fflush(stderr);
    }
    if (!fault.empty()) return -EINVAL;
    if (top_level && !tokens.empty() &&
        (!strcasecmp(tokens[0].c_str(), "quit") || !strcasecmp(tokens[0].c_str(), "exit"))) {
        quit_seen = true;
        return 0;
    }
    return run(tokens);
}

bool read_physical(FILE *in, std::string &line, int &number, bool &cut)
{
    int c = 0;
    cut = false;
    errno = 0;
    line.clear();
    while (line.size() < MAX_PHYSICAL && (c = getc(in)) != EOF && c != '\n') line += static_cast<char>(c);
    cut = line.size() == MAX_PHYSICAL;
    if (c == EOF && line.empty()) return false;
    if (++number == 1 && line.compare(0, 3, "\xEF\xBB\xBF") == 0) line.erase(0, 3);
    return true;
}

int Session::run_stream(FILE *in)
{
    Joiner joiner;
    std::string physical, line;
    bool cut;
    while (!stop && !quit_seen && read_physical(in, physical, place.line, cut)) {
        if (cut) warning(strf("line longer than %zu characters was split", MAX_PHYSICAL));
        if (!joiner.add(physical, line)) continue;
        int r = run_line(line);
        fflush(stdout);
        if (r != 0) {
            failures++;
            if (!keep_going) break;
        }
    }
    return failures ? -EINVAL : 0;
}

int Session::source(const std::string &path)
{
    FILE *in = source_depth < 64 ? fopen(path.c_str(), "re") : (errno = ELOOP, nullptr);
    if (!in) {
        fflush(stdout);
        fprintf(stderr, "Could not open hal file '%s': %s\n", path.c_str(), strerror(errno));
        if (place.file != Place().file) fprintf(stderr, "%s:%d: it is sourced here\n", place.file.c_str(), place.line);
        return -EINVAL;
    }
    Place outer = place;
    place = {path, 0};
    source_depth++;
    int r = 0;
    bool cut;
    std::string line;
    while (!stop && r == 0 && read_physical(in, line, place.line, cut)) {
        if (cut) warning(strf("line longer than %zu characters was split", MAX_PHYSICAL));
        r = run_logical(line, false);
    }
    source_depth--;
    place = outer;
    fclose(in);
    return r;
}

} // namespace halcmd
