/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * fuzz_parsers.cc - any bytes given to what reads text or messages of others, but halcmd
 * (utils/halcmd/fuzz.cc): nothing may crash.
 *
 * The first byte chooses: s a line of halstreamer, t a line of halrmt's client, i an INI file.
 * `make fuzz` makes a libFuzzer program of it (clang); objects/test/parsers-fuzz FILE... runs
 * the files of a corpus (tests/fuzz/parsers).
 */
#include "../../emc/ini/inifile.cc"
#include "../utils/halrmt/server.hh"
#include "hal.h"
#include "rtapi.h"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <strings.h>
#include <sys/mman.h>
#include <unistd.h>

extern "C" void fuzz_stream_line(const char *line);

namespace
{

/// One file in memory, filled anew for each input.
void read_ini(const std::string &text)
{
    static const int fd = memfd_create("ini", 0);
    static const std::string path = "/proc/self/fd/" + std::to_string(fd);
    if (ftruncate(fd, 0) != 0 || pwrite(fd, text.data(), text.size(), 0) < 0) return;
    linuxcnc::IniFile::Content content;
    linuxcnc::Parser(content).parse_file(path);
}

/// Commands of halrmt that reach files and programs, or end it.
bool leaves_hal(const std::string &line)
{
    static const char *const words[] = {"load", "unload", "save", "inifile", "ini", "shutdown"};
    for (const char *word : words)
        for (size_t at = 0; at < line.size(); at++)
            if (!strncasecmp(line.c_str() + at, word, strlen(word))) return true;
    return false;
}

void serve_line(const std::string &line)
{
    static halcmd::Level level = halcmd::Level::None;
    static halcmd::TerminalChannels channels(level);
    static halrmt::Server server{halrmt::Settings()}; // gives HAL back at the end of the program
    static halrmt::Connection client;
    if (!server.session.channels) {
        rtapi_set_msg_level(RTAPI_MSG_NONE);
        server.session.channels = &channels;
        server.session.anonymous = true;
        if (server.session.attach() != 0) abort();
    }
    if (leaves_hal(line)) return;
    client.linked = client.enabled = true;
    halrmt::execute(server, client, line);
    client.output.clear();
    client.closing = false;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size < 1 || size > 8192) return 0;
    std::string text(reinterpret_cast<const char *>(data) + 1, size - 1);
    const std::string line = text.substr(0, std::min(text.find('\0'), text.find('\n')));
    switch (data[0]) {
    case 's': fuzz_stream_line(line.c_str()); break;
    case 't': serve_line(line); break;
    case 'i': read_ini(text); break;
    }
    return 0;
}
