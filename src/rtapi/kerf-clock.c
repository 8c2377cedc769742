/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * kerf-clock.c - the clock for shell scripts.
 *
 *   kerf-clock now | is-virtual | sleep SECONDS | run COMMAND...
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>
#include "kerf_clock.h"

static int run(char **command)
{
    char place[KERF_CLOCK_SLOT_LEN];
    kerf_clock_join(command[0], KERF_CLOCK_PRIO_TEST);
    kerf_clock_lend(place, sizeof place);
    pid_t pid = fork();
    if (pid == 0) {
        if (*place) setenv(KERF_CLOCK_SLOT_ENV, place, 1);
        execvp(command[0], command);
        perror(command[0]);
        _exit(127);
    }
    int status = 0;
    if (pid < 0 || kerf_clock_waitpid(pid, &status, 0) < 0) return 1;
    kerf_clock_leave();
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

int main(int argc, char **argv)
{
    if (argc == 2 && !strcmp(argv[1], "now")) {
        printf("%.9f\n", (double)kerf_clock_now_ns() * 1e-9);
        return 0;
    }
    if (argc == 2 && !strcmp(argv[1], "is-virtual")) return kerf_clock_is_virtual() ? 0 : 1;
    if (argc == 3 && !strcmp(argv[1], "sleep")) {
        if (getenv(KERF_CLOCK_SLOT_ENV)) kerf_clock_join("kerf-clock", KERF_CLOCK_PRIO_TEST);
        kerf_clock_sleep_ns((int64_t)(atof(argv[2]) * 1e9));
        kerf_clock_leave();
        return 0;
    }
    if (argc >= 3 && !strcmp(argv[1], "run")) return run(argv + 2);
    fprintf(stderr, "Usage: kerf-clock now | is-virtual | sleep SECONDS | run COMMAND...\n");
    return 1;
}
