/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * fuzz.cc - any bytes as a .hal file: nothing may crash, and what comes out keeps its promises.
 *
 * `make fuzz` makes a libFuzzer program of it (clang); objects/test/halcmd-fuzz FILE... runs
 * the files of a corpus (tests/fuzz/halcmd).
 * With KERF_FUZZ_HAL=1 the commands are also given to HAL (an instance of its own is
 * advised), but those that start or end programs or touch files.
 */
#include "commands.hh"
#include "complete.hh"
#include "format.hh"
#include "session.hh"

#include "rtapi.h"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

using namespace halcmd;

namespace
{

/// Swallows texts; counts them.
class Silence : public Channels
{
  public:
    size_t errors = 0, letters = 0;
    void error(const Place &, const std::string &text) override
    {
        errors++;
        letters += text.size();
    }
    void warning(const Place &, const std::string &text) override { letters += text.size(); }
    void info(const Place &, const std::string &text) override { letters += text.size(); }
    void print(const Place &, const std::string &text) override { letters += text.size(); }
    void output(const std::string &text) override { letters += text.size(); }
    void console(const std::string &text) override { letters += text.size(); }
};

[[noreturn]] void broken(const char *promise)
{
    fprintf(stderr, "broken promise: %s\n", promise);
    abort();
}

void promise(bool kept, const char *what)
{
    if (!kept) broken(what);
}

Lookup lookup()
{
    Lookup l;
    l.env = [](const std::string &name) -> std::optional<std::string> {
        return name == "A" ? std::optional<std::string>("x y 'z'") : name == "B" ? std::optional<std::string>("$A[S]V")
                                                                                : std::nullopt;
    };
    l.ini = [](const std::string &section, const std::string &name) -> std::optional<std::string> {
        return section == "S" && name == "V" ? std::optional<std::string>("1 2 3") : std::nullopt;
    };
    return l;
}

/// The stages of a line, one by one.
void parse(std::string line, std::vector<std::string> &tokens)
{
    tokens.clear();
    std::string text;
    bool dos = false;
    if (!strip_comment(line).empty()) return;
    if (!substitute(line, lookup(), text).empty()) return;
    promise(text.size() <= MAX_SUBSTITUTED, "substituted text is short enough");
    if (!tokenize(text, tokens, dos).empty()) {
        tokens.clear();
        return;
    }
    promise(tokens.size() <= MAX_TOKENS, "no more tokens than allowed");
    size_t letters = 0;
    for (auto &t : tokens) {
        promise(!t.empty(), "tokens are not empty");
        letters += t.size();
        for (auto type : {HAL_BIT, HAL_FLOAT, HAL_S32, HAL_U32, HAL_S64, HAL_U64, HAL_PORT}) {
            hal_query_value_u v = {};
            if (parse_value(type, t, v) != 0) continue;
            hal_query_value_u again = {};
            promise(parse_value(type, value_packed(type, v), again) == 0, "a printed value can be read");
            if (type != HAL_FLOAT && type != HAL_BIT) promise(again.u == v.u, "a printed integer is itself");
            promise(value_wide(type, v).size() >= 20, "wide values fill their column");
        }
        matches({t}, "and2.0.in0");
        promise(matches({t}, t.c_str()), "a name matches its own beginning");
    }
    promise(letters <= text.size(), "tokens come from the line");
}

/// Commands that do not leave HAL.
bool harmless(const std::vector<std::string> &tokens)
{
    static const char *const others[] = {"loadrt", "loadusr", "unload", "unloadrt", "unloadusr",
                                         "waitusr", "debug",  "source"};
    if (tokens.empty()) return false;
    for (const char *name : others)
        if (tokens[0] == name) return false;
    if (tokens[0] == "save") return tokens.size() < 3;
    if (tokens[0] == "graph") return tokens.size() < 2;
    return true;
}

Session *with_hal(Channels &channels)
{
    static Session *session;
    static bool asked;
    if (!asked) {
        asked = true;
        if (getenv("KERF_FUZZ_HAL")) {
            rtapi_set_msg_level(RTAPI_MSG_NONE);
            static Session s; // gives HAL back at the end of the program
            s.channels = &channels;
            promise(s.attach() == 0, "HAL can be used");
            session = &s;
            for (const char *c : {"newsig a bit", "newsig b float", "newsig c s32"}) {
                std::vector<std::string> tokens;
                parse(c, tokens);
                s.run(tokens);
            }
        }
    }
    if (session) session->channels = &channels;
    return session;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size > 16384) return 0;
    Silence silence;
    Session *session = with_hal(silence);
    Joiner joiner;
    std::vector<std::string> tokens;
    std::string line;
    const std::string all(reinterpret_cast<const char *>(data), size);
    for (size_t at = 0; at < all.size();) {
        size_t end = std::min(all.find('\n', at), all.size());
        if (joiner.add(std::string_view(all).substr(at, end - at), line)) {
            promise(line.size() <= MAX_JOINED, "joined lines have a bound");
            parse(line, tokens);
            if (!tokens.empty()) {
                const Command *c = find_command(tokens[0]);
                promise(!c || tokens[0] == c->name, "a command is found by its whole name");
            }
            if (session) {
                if (harmless(tokens)) session->run(tokens);
                bool files;
                complete_line(line, files);
            }
        }
        at = end + 1;
    }
    return 0;
}
