// SPDX-License-Identifier: GPL-2.0-or-later
//
// main.cc - linuxcncrsh: a text protocol over TCP for driving the controller.
#include <getopt.h>
#include <signal.h>

#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "kerf_clock.h"
#include "session.hh"

static volatile int stop = 0;
static void on_signal(int) { stop = 1; }

static void usage(FILE *to) {
    fprintf(to,
            "Usage: linuxcncrsh [options] [-- -ini FILE]\n"
            "  -h, --help            this text\n"
            "  -p, --port N          TCP port (5007)\n"
            "  -n, --name NAME       server name (EMCNETSVR)\n"
            "  -w, --connectpw PW    password of HELLO (EMC)\n"
            "  -e, --enablepw PW     password of SET ENABLE (EMCTOO)\n"
            "  -s, --sessions N      connections at a time, 0: any number (0)\n"
            "  -d, --path LIST       where OPEN and LOAD_TOOL_TABLE look, separated by ':'\n"
            "  -q, --quiet           no information on standard output\n"
            "  -4, --ipv4            no IPv6\n"
            "  -b, --bind ADDRESS    where to listen: an address of this computer, or '*' for all of them\n"
            "                        (default: only programs of this computer are let in); see docs/nml.md\n");
}

// The number of an option; false with a message when it is none from low to high.
static bool number_of(const char *what, const char *text, long low, long high, int *value) {
    char *end;
    long v = strtol(text, &end, 10);
    if (*text && !*end && v >= low && v <= high) {
        *value = static_cast<int>(v);
        return true;
    }
    fprintf(stderr, "linuxcncrsh: %s '%s' must be a number from %ld to %ld\n", what, text, low, high);
    return false;
}

int main(int argc, char **argv) {
    rsh::Options o;
    if (const char *home = getenv("HOME")) o.path = std::string(home) + "/nc_files";
    static const option longs[] = {
        {"help", 0, nullptr, 'h'},      {"port", 1, nullptr, 'p'},     {"name", 1, nullptr, 'n'},
        {"connectpw", 1, nullptr, 'w'}, {"enablepw", 1, nullptr, 'e'}, {"sessions", 1, nullptr, 's'},
        {"path", 1, nullptr, 'd'},      {"quiet", 0, nullptr, 'q'},    {"ipv4", 0, nullptr, '4'},
        {"bind", 1, nullptr, 'b'},      {nullptr, 0, nullptr, 0}};
    int c;
    while ((c = getopt_long(argc, argv, "+hp:n:w:e:s:d:q4b:", longs, nullptr)) != -1) {
        switch (c) {
        case 'h': usage(stdout); return 0;
        case 'p':
            if (!number_of("port", optarg, 1, 65534, &o.port)) return 1;
            break;
        case 'n': o.name = optarg; break;
        case 'w': o.connect_password = optarg; break;
        case 'e':
            o.enable_password = optarg;
            for (const char *p = optarg; *p; p++)
                if (isspace(static_cast<unsigned char>(*p)) || iscntrl(static_cast<unsigned char>(*p))) {
                    fprintf(stderr, "linuxcncrsh: the password of SET ENABLE must not contain blanks\n");
                    return 1;
                }
            if (strcasecmp(optarg, "OFF") == 0) {
                fprintf(stderr, "linuxcncrsh: the password of SET ENABLE must not be OFF\n");
                return 1;
            }
            break;
        case 's':
            if (!number_of("sessions", optarg, 0, 1000000, &o.sessions)) return 1;
            break;
        case 'd': o.path = optarg; break;
        case 'q': o.quiet = true; break;
        case '4': o.ipv4 = true; break;
        case 'b': o.bind = optarg; break;
        default: usage(stderr); return 1;
        }
    }
    for (int i = optind; i < argc; i++)
        if (strcmp(argv[i], "-ini") == 0 && i + 1 < argc) o.ini_file = argv[++i];
    struct sigaction act = {};
    act.sa_handler = on_signal;
    sigaction(SIGINT, &act, nullptr);
    sigaction(SIGTERM, &act, nullptr);
    signal(SIGPIPE, SIG_IGN);
    kerf_clock_join("linuxcncrsh", KERF_CLOCK_PRIO_USER);
    rsh::Server server(o);
    bool good = server.start();
    if (good) server.run(&stop);
    return good ? 0 : 1;
}
