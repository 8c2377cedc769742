/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * kerf-clock.c - the clock for shell scripts; see docs/virtual-time.md.
 *
 * Out:    exit status of the command run, else 0; 1 = wrong use
 */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>
#include "kerf_clock.h"

static const char usage[] =
    "Usage: kerf-clock now             the time in seconds\n"
    "       kerf-clock is-virtual      exit status 0 in virtual time, else 1\n"
    "       kerf-clock sleep SECONDS\n"
    "       kerf-clock run COMMAND...  COMMAND and what it starts run in one place: time stands\n"
    "                                  except while one of them sleeps by the clock\n"
    "       kerf-clock reserve NAME    prints a place for a command in the background:\n"
    "                                    place=$(kerf-clock reserve NAME)\n"
    "                                    KERF_CLOCK_SLOT=$place COMMAND... &\n"
    "       kerf-clock wait PID        until that process is gone\n"
    "       kerf-clock status          the clock and its participants\n";

/* Starts command with KERF_CLOCK_SLOT=place (unset when empty). */
static pid_t start(char **command, const char *place)
{
    fflush(stdout);
    pid_t pid = fork();
    if (pid != 0) {
        return pid;
    }
    if (*place) {
        setenv(KERF_CLOCK_SLOT_ENV, place, 1);
    } else {
        unsetenv(KERF_CLOCK_SLOT_ENV);
    }
    execvp(command[0], command);
    fprintf(stderr, "kerf-clock: %s: %s\n", command[0], strerror(errno));
    _exit(127);
}

static int run(char **command)
{
    char place[KERF_CLOCK_SLOT_LEN];
    int status = 0;
    kerf_clock_join(command[0], KERF_CLOCK_PRIO_TEST);
    kerf_clock_lend(place, sizeof place);
    pid_t pid = start(command, place);
    if (pid < 0) {
        perror("kerf-clock: fork");
        return 1;
    }
    while (kerf_clock_waitpid(pid, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/* The place is kept for the shell that asked, until a child of it claims it. */
static int reserve(const char *name)
{
    char place[KERF_CLOCK_SLOT_LEN];
    kerf_clock_join("kerf-clock reserve", KERF_CLOCK_PRIO_TEST);
    if (kerf_clock_reserve(place, sizeof place, name, KERF_CLOCK_PRIO_USER) < 0) {
        fprintf(stderr, "kerf-clock: too many participants\n");
        return 1;
    }
    kerf_clock_reserved_for(place, getppid());
    printf("%s\n", place);
    return 0;
}

static int gone(void *arg)
{
    char path[32], text[512];
    snprintf(path, sizeof path, "/proc/%d/stat", *(int *)arg);
    FILE *f = fopen(path, "re");
    if (!f) {
        return 1;
    }
    char *p = fgets(text, sizeof text, f) ? strrchr(text, ')') : NULL;
    fclose(f);
    return !p || p[2] == 'Z' || p[2] == 'X';
}

int main(int argc, char **argv)
{
    const char *what = argc > 1 ? argv[1] : "";
    char *end = NULL;
    if (argc == 2 && !strcmp(what, "now")) {
        printf("%.9f\n", (double)kerf_clock_now_ns() * 1e-9);
    } else if (argc == 2 && !strcmp(what, "is-virtual")) {
        return kerf_clock_is_virtual() ? 0 : 1;
    } else if (argc == 2 && !strcmp(what, "status")) {
        kerf_clock_print(stdout);
    } else if (argc == 3 && !strcmp(what, "sleep")) {
        double seconds = strtod(argv[2], &end);
        if (*end || !(seconds >= 0 && seconds < 1e9)) {
            fprintf(stderr, "kerf-clock: %s is not a time in seconds\n", argv[2]);
            return 1;
        }
        kerf_clock_join("kerf-clock sleep", KERF_CLOCK_PRIO_USER); /* time stands until we are gone */
        kerf_clock_sleep_ns((int64_t)(seconds * 1e9 + 0.5));
    } else if (argc == 3 && !strcmp(what, "wait")) {
        int pid = (int)strtol(argv[2], &end, 10);
        if (*end || pid <= 0) {
            fprintf(stderr, "kerf-clock: %s is not a process id\n", argv[2]);
            return 1;
        }
        kerf_clock_join("kerf-clock wait", KERF_CLOCK_PRIO_TEST);
        kerf_clock_wait(gone, &pid, 1000000, -1);
    } else if (argc >= 3 && !strcmp(what, "run")) {
        return run(argv + 2);
    } else if (argc == 3 && !strcmp(what, "reserve")) {
        return reserve(argv[2]);
    } else {
        fputs(usage, argc == 2 && !strcmp(what, "-h") ? stdout : stderr);
        return argc == 2 && !strcmp(what, "-h") ? 0 : 1;
    }
    return 0;
}
