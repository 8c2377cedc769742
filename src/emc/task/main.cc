// SPDX-License-Identifier: GPL-2.0-or-later
//
// main.cc - milltask: `milltask -ini FILE`.
#include <signal.h>
#include <unistd.h>

#include <clocale>
#include <cstdio>

#include "emc_args.hh"
#include "kerf_clock.h"
#include "task.hh"

static volatile int stop = 0;

static void on_signal(int) { stop = 1; }

int main(int argc, char **argv) {
    setlocale(LC_ALL, "");
    setlocale(LC_NUMERIC, "C");
    EmcArgs args(argc, argv);
    struct sigaction act = {};
    act.sa_handler = on_signal;
    sigaction(SIGINT, &act, nullptr);
    sigaction(SIGTERM, &act, nullptr);
    if (struct sigaction hup; sigaction(SIGHUP, nullptr, &hup) == 0 && hup.sa_handler != SIG_IGN) // a terminal that is closed ends the machine in order
        sigaction(SIGHUP, &act, nullptr);
    signal(SIGPIPE, SIG_IGN);
    kerf_clock_join("milltask", KERF_CLOCK_PRIO_TASK);
    int result = 1;
    {
        Task task(args.ini_file);
        if (task.start()) {
            task.run(&stop);
            task.shutdown();
            result = 0;
        }
    }
    kerf_clock_leave();
    return result;
}
