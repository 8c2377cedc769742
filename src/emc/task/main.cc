// SPDX-License-Identifier: GPL-2.0-or-later
//
// main.cc - milltask: `milltask -ini FILE`.
#include <signal.h>
#include <unistd.h>

#include <clocale>
#include <cstdio>
#include <cstdlib>

#include <fcntl.h>
#include <sys/wait.h>

#include "emc_args.hh"
#include "kerf_clock.h"
#include "rcs_print.hh"
#include "task.hh"

static volatile int stop = 0;

static void on_signal(int) { stop = 1; }

// kerf-safe-stop stands by to end motion when this process dies, whatever becomes of the others.
class Standby {
public:
    explicit Standby(const char *ini) {
        int pipe[2];
        if (pipe2(pipe, O_CLOEXEC) != 0) return;
        pid_ = fork();
        if (pid_ == 0) {
            setsid(); // what ends a terminal or a group of processes does not end it
            dup2(pipe[0], STDIN_FILENO);
            if (int null = open("/dev/null", O_WRONLY | O_CLOEXEC); null >= 0) {
                dup2(null, STDOUT_FILENO);
                dup2(null, STDERR_FILENO);
            }
            unsetenv("KERF_CLOCK_SLOT"); // it takes no part in virtual time
            execlp("kerf-safe-stop", "kerf-safe-stop", "-ini", ini, "--watch", nullptr);
            _exit(127);
        }
        close(pipe[0]);
        word_ = pipe[1];
        if (pid_ < 0) rcs_print_error("can't start kerf-safe-stop: motion goes on if task dies\n");
    }
    ~Standby() {
        if (word_ < 0) return;
        if (write(word_, "e", 1) == 1 && pid_ > 0) waitpid(pid_, nullptr, 0);
        close(word_);
    }
    Standby(const Standby &) = delete;
    Standby &operator=(const Standby &) = delete;
private:
    int word_ = -1;
    pid_t pid_ = -1;
};

int main(int argc, char **argv) {
    setlocale(LC_ALL, "");
    setlocale(LC_NUMERIC, "C");
    EmcArgs args(argc, argv);
    struct sigaction act = {};
    act.sa_handler = on_signal;
    sigaction(SIGINT, &act, nullptr);
    sigaction(SIGTERM, &act, nullptr);
    if (struct sigaction hup; sigaction(SIGHUP, nullptr, &hup) == 0 &&
                              hup.sa_handler != SIG_IGN) // a terminal that is closed ends the machine in order
        sigaction(SIGHUP, &act, nullptr);
    signal(SIGPIPE, SIG_IGN);
    const Standby standby(args.ini_file.c_str());
    kerf_clock_join("milltask", KERF_CLOCK_PRIO_TASK);
    int result = 1;
    {
        Task task(args.ini_file);
        if (task.start(&stop)) {
            task.run(&stop);
            task.shutdown();
            result = 0;
        }
    }
    kerf_clock_leave();
    return result;
}
