/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * main.cc - the program halrmt: its options.
 */
#include "server.hh"

#include "hal.h"

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <getopt.h>

static void on_signal(int) { halrmt::ended = 1; }

static int usage()
{
    puts("Usage: halrmt [options]\n"
         "HAL over TCP: telnet to it, or speak its line protocol from a program.\n"
         "  -p, --port N        port (5006)\n"
         "  -n, --name S        name of the server in HELLO ACK (EMCNETSVR)\n"
         "  -w, --connectpw S   password of HELLO (EMC)\n"
         "  -e, --enablepw S    password of SET ENABLE (EMCTOO)\n"
         "  -s, --sessions N    clients at most; 0: any number (0)\n"
         "  -i, --ini FILE      INI file (environment INI_FILE_NAME)\n"
         "  -q, --quiet         no log on standard output\n"
         "  -4, --ipv4          listen for IPv4 only\n"
         "  -h, --help          this text");
    return 1;
}

/// A whole number within bounds; false, with a message, otherwise.
static bool number(const char *text, const char *what, long min, long max, int &value)
{
    char *end;
    errno = 0;
    long n = strtol(text, &end, 10);
    if (errno || *end || end == text || n < min || n > max) {
        fprintf(stderr, "halrmt: invalid %s '%s': must be %ld to %ld\n", what, text, min, max);
        return false;
    }
    value = static_cast<int>(n);
    return true;
}

int main(int argc, char **argv)
{
    static const option longs[] = {{"port", 1, nullptr, 'p'},     {"name", 1, nullptr, 'n'},
                                   {"connectpw", 1, nullptr, 'w'}, {"enablepw", 1, nullptr, 'e'},
                                   {"sessions", 1, nullptr, 's'},  {"ini", 1, nullptr, 'i'},
                                   {"quiet", 0, nullptr, 'q'},     {"ipv4", 0, nullptr, '4'},
                                   {"help", 0, nullptr, 'h'},      {nullptr, 0, nullptr, 0}};
    halrmt::Settings s;
    if (const char *file = getenv("INI_FILE_NAME")) s.ini_file = file;
    for (int c; (c = getopt_long(argc, argv, "p:n:w:e:s:i:q4h", longs, nullptr)) != -1;) {
        switch (c) {
        case 'p':
            if (!number(optarg, "port", 1, 65534, s.port)) return 1;
            break;
        case 's':
            if (!number(optarg, "number of sessions", 0, 10000, s.sessions)) return 1;
            break;
        case 'n': s.name = optarg; break;
        case 'w': s.connect_password = optarg; break;
        case 'e': s.enable_password = optarg; break;
        case 'i': s.ini_file = optarg; break;
        case 'q': s.quiet = true; break;
        case '4': s.ipv4_only = true; break;
        default: return usage();
        }
    }
    if (optind < argc) return usage();
    if (s.enable_password == "OFF") {
        fputs("halrmt: the enable password must not be OFF: SET ENABLE OFF drops the right\n", stderr);
        return 1;
    }
    struct sigaction act = {};
    act.sa_handler = on_signal;
    sigaction(SIGINT, &act, nullptr);
    sigaction(SIGTERM, &act, nullptr);
    signal(SIGPIPE, SIG_IGN);

    halrmt::Server server(s);
    halcmd::TerminalChannels channels(server.session.level);
    server.session.channels = &channels;
    server.session.anonymous = true;
    server.session.place = {"halrmt", 0};
    if (int r = server.session.attach()) {
        fprintf(stderr, "halrmt: cannot use HAL: %s\n", hal_strerror(r));
        return 1;
    }
    return server.run();
}
