/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * clock_test.c - drives the clock from several processes; objects/test/clock-test.
 *
 *   clock-test players SEED STEPS   three processes sleep random times and write what
 *                                   they see; the text depends on SEED only
 *   clock-test kill RUNNING|WAITING one of three is killed in that state; the others go on
 *   clock-test signal               a signal ends a wait early, in turn
 *   clock-test hang                 a participant that hangs is named; time goes on after
 *   clock-test unclaimed            a reserved place whose child never joins is given up
 *   clock-test lend                 a child sleeps in its parent's place, grandchildren too
 *   clock-test background           a borrower that outlives its lender's wait
 *   clock-test threads N STEPS      N threads; no two ever run at once
 *   clock-test pace                 prints virtual seconds per wall second of its own run
 *   clock-test speed [PROCESSES]    waits per second
 */
#include <errno.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>
#include "kerf_clock.h"

#define MS 1000000LL

/* Shared by all processes of a test. */
struct board {
    _Atomic int running, worst, stop, stuck;
    _Atomic long turns;
};
static struct board *board;
static int64_t start_ns;

static double wall_s(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double seen_ms(void)
{
    return (double)(kerf_clock_now_ns() - start_ns) * 1e-6;
}

static void say(const char *who, const char *what)
{
    printf("%10.3f %s %s\n", seen_ms(), who, what);
    fflush(stdout);
}

static void die(const char *what)
{
    fprintf(stderr, "clock-test: %s\n", what);
    exit(1);
}

/* A child with a place of its own that runs body(arg) and ends. */
static pid_t player(const char *name, int prio, void (*body)(const char *name, long arg), long arg)
{
    char place[KERF_CLOCK_SLOT_LEN];
    if (kerf_clock_reserve(place, sizeof place, name, prio) < 0) {
        die("no place");
    }
    pid_t pid = fork();
    if (pid == 0) {
        setenv(KERF_CLOCK_SLOT_ENV, place, 1);
        kerf_clock_join(name, prio);
        body(name, arg);
        exit(0);
    }
    kerf_clock_reserved_for(place, pid);
    return pid;
}

static void end_all(void)
{
    while (kerf_clock_waitpid(-1, NULL, 0) > 0 || errno == EINTR) {
    }
}

/* ---- Cases -------------------------------------------------------------- */

static unsigned long next_random(unsigned long *state)
{
    *state = *state * 6364136223846793005UL + 1442695040888963407UL;
    return *state >> 33;
}

static int player_steps;

static void random_sleeper(const char *name, long seed)
{
    unsigned long state = (unsigned long)seed;
    char text[64];
    for (int i = 0; i < player_steps; i++) {
        if (atomic_fetch_add(&board->running, 1) != 0) {
            atomic_store(&board->worst, 1);
        }
        long turn = atomic_fetch_add(&board->turns, 1);
        snprintf(text, sizeof text, "step %d turn %ld", i, turn);
        say(name, text);
        /* Some wall time, so that the order would show if two ran at once. */
        for (unsigned long n = next_random(&state) % 4000; n > 0; n--) {
            atomic_signal_fence(memory_order_seq_cst);
        }
        atomic_fetch_sub(&board->running, 1);
        kerf_clock_sleep_ns((int64_t)(next_random(&state) % 4) * MS); /* many equal times */
    }
}

static int players(long seed, int steps)
{
    player_steps = steps;
    player("anna", 500, random_sleeper, seed);
    player("bert", 500, random_sleeper, seed + 1);
    player("carl", 400, random_sleeper, seed + 2);
    end_all();
    say("all", atomic_load(&board->worst) ? "TWO RAN AT ONCE" : "done");
    return 0;
}

static void ticker(const char *name, long count)
{
    for (long i = 0; i < count; i++) {
        kerf_clock_sleep_ns(10 * MS);
    }
    say(name, "ticked to the end");
}

static void victim_running(const char *name, long arg)
{
    (void)name, (void)arg;
    kerf_clock_sleep_ns(25 * MS);
    say(name, "is killed while it runs");
    raise(SIGKILL);
}

static void victim_waiting(const char *name, long arg)
{
    (void)name, (void)arg;
    kerf_clock_sleep_ns(1000 * MS);
    say(name, "LIVES");
}

static int killed(bool running)
{
    player("ticker", 500, ticker, 20);
    pid_t pid = player("victim", 500, running ? victim_running : victim_waiting, 0);
    kerf_clock_sleep_ns(50 * MS);
    if (!running) {
        kill(pid, SIGKILL);
        usleep(50000); /* wall time: it is gone before time goes on */
        say("parent", "killed the one who waits");
    }
    end_all();
    kerf_clock_sleep_ns(2000 * MS);
    say("parent", "done");
    return 0;
}

static void on_signal(int sig)
{
    (void)sig;
}

static void signalled(const char *name, long arg)
{
    (void)arg;
    struct sigaction action = {.sa_handler = on_signal};
    sigaction(SIGUSR1, &action, NULL);
    int result = kerf_clock_sleep_ns(100000 * MS);
    say(name, result == -EINTR ? "was woken by a signal" : "SLEPT ON");
}

static int signal_case(void)
{
    pid_t pid = player("sleeper", 500, signalled, 0);
    kerf_clock_sleep_ns(50 * MS);
    usleep(50000); /* wall time, while virtual time stands: the child falls asleep ... */
    kill(pid, SIGUSR1);
    say("parent", "sent a signal");
    usleep(50000); /* ... and gets the signal */
    end_all();
    say("parent", "done");
    return 0;
}

static void hanger(const char *name, long arg)
{
    (void)arg;
    say(name, "hangs");
    while (!atomic_load(&board->stop)) {
        struct timespec t = {0, 10000000};
        nanosleep(&t, NULL);
    }
    say(name, "goes on");
}

static void *release_later(void *arg)
{
    (void)arg;
    struct timespec t = {1, 500000000};
    nanosleep(&t, NULL);
    atomic_store(&board->stop, 1);
    return NULL;
}

static int hang(void)
{
    pthread_t thread;
    pthread_create(&thread, NULL, release_later, NULL);
    player("hanger", 500, hanger, 0);
    kerf_clock_sleep_ns(50 * MS);
    pthread_join(thread, NULL);
    end_all();
    say("parent", "done");
    return 0;
}

static int unclaimed(void)
{
    char place[KERF_CLOCK_SLOT_LEN];
    kerf_clock_reserve(place, sizeof place, "stranger", 500);
    pid_t pid = fork();
    if (pid == 0) {
        execlp("sleep", "sleep", "60", (char *)NULL);
        _exit(127);
    }
    kerf_clock_reserved_for(place, pid);
    kerf_clock_sleep_ns(50 * MS);
    say("parent", "goes on without the stranger");
    kill(pid, SIGKILL);
    waitpid(pid, NULL, 0);
    return 0;
}

/* A child in our place: sleeps, lends it on, sleeps again. */
static void borrower(int depth)
{
    char name[24], place[KERF_CLOCK_SLOT_LEN];
    snprintf(name, sizeof name, "depth-%d", depth);
    kerf_clock_join(name, 500);
    kerf_clock_sleep_ns(10 * MS);
    say(name, "slept 10 ms");
    if (depth < 3) {
        kerf_clock_lend(place, sizeof place);
        pid_t pid = fork();
        if (pid == 0) {
            setenv(KERF_CLOCK_SLOT_ENV, place, 1);
            borrower(depth + 1);
            exit(0);
        }
        kerf_clock_waitpid(pid, NULL, 0);
    } else {
        raise(SIGKILL); /* the deepest dies with the place in its hands */
    }
    say(name, "has its place again");
}

static int lend(void)
{
    char place[KERF_CLOCK_SLOT_LEN];
    player("ticker", 500, ticker, 3);
    for (int round = 0; round < 2; round++) {
        kerf_clock_lend(place, sizeof place);
        pid_t pid = fork();
        if (pid == 0) {
            setenv(KERF_CLOCK_SLOT_ENV, place, 1);
            borrower(1);
            exit(0);
        }
        kerf_clock_waitpid(pid, NULL, 0);
        say("parent", "has its place again");
    }
    end_all();
    return 0;
}

static int background(void)
{
    char place[KERF_CLOCK_SLOT_LEN];
    kerf_clock_lend(place, sizeof place);
    pid_t pid = fork();
    if (pid == 0) {
        setenv(KERF_CLOCK_SLOT_ENV, place, 1);
        if (fork() > 0) {
            usleep(50000); /* wall time: the grandchild is in the place when we end */
            _exit(0);
        }
        kerf_clock_join("grandchild", 500);
        kerf_clock_sleep_ns(30 * MS);
        say("grandchild", "slept 30 ms");
        exit(0);
    }
    kerf_clock_waitpid(pid, NULL, 0);
    kerf_clock_sleep_ns(100 * MS);
    say("parent", "done");
    return 0;
}

static int thread_steps;

static void *thread_body(void *arg)
{
    unsigned long state = (unsigned long)(size_t)arg * 77;
    kerf_clock_join("thread", 500);
    for (int i = 0; i < thread_steps; i++) {
        if (atomic_fetch_add(&board->running, 1) != 0) {
            atomic_store(&board->worst, 1);
        }
        atomic_fetch_add(&board->turns, 1);
        atomic_fetch_sub(&board->running, 1);
        kerf_clock_sleep_ns((int64_t)(next_random(&state) % 3) * MS);
    }
    return NULL; /* without leaving: the end of the thread does it */
}

static int threads(int count, int steps)
{
    pthread_t id[64];
    thread_steps = steps;
    for (int i = 0; i < count && i < 64; i++) {
        pthread_create(&id[i], NULL, thread_body, (void *)(size_t)(i + 1));
    }
    kerf_clock_suspend();
    for (int i = 0; i < count && i < 64; i++) {
        pthread_join(id[i], NULL);
    }
    kerf_clock_resume();
    printf("%ld turns, %s\n", atomic_load(&board->turns),
           atomic_load(&board->worst) ? "TWO RAN AT ONCE" : "one at a time");
    return 0;
}

static int pace(void)
{
    double wall = wall_s();
    int64_t now = kerf_clock_now_ns();
    for (int i = 0; i < 1000; i++) {
        kerf_clock_sleep_ns(20 * MS);
    }
    printf("%.1f\n", (double)(kerf_clock_now_ns() - now) * 1e-9 / (wall_s() - wall));
    return 0;
}

static void speed_player(const char *name, long count)
{
    (void)name;
    while (count-- > 0) {
        kerf_clock_sleep_ns(MS);
    }
}

static int speed(int processes)
{
    long count = processes > 1 ? 200000 : 20000000;
    for (int i = 1; i < processes; i++) {
        player("player", 500, speed_player, count);
    }
    kerf_clock_sleep_ns(0);
    double wall = wall_s();
    speed_player("", count);
    printf("%d processes: %.0f waits/s\n", processes, (double)count * processes / (wall_s() - wall));
    end_all();
    return 0;
}

int main(int argc, char **argv)
{
    const char *what = argc > 1 ? argv[1] : "";
    if (!kerf_clock_is_virtual()) {
        die("needs KERF_CLOCK=virtual");
    }
    board = mmap(NULL, sizeof *board, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (board == MAP_FAILED || kerf_clock_join("clock-test", KERF_CLOCK_PRIO_TEST) < 0) {
        die("cannot start");
    }
    start_ns = kerf_clock_now_ns();
    if (!strcmp(what, "players") && argc == 4) return players(atol(argv[2]), atoi(argv[3]));
    if (!strcmp(what, "kill") && argc == 3) return killed(!strcmp(argv[2], "RUNNING"));
    if (!strcmp(what, "signal")) return signal_case();
    if (!strcmp(what, "hang")) return hang();
    if (!strcmp(what, "unclaimed")) return unclaimed();
    if (!strcmp(what, "lend")) return lend();
    if (!strcmp(what, "background")) return background();
    if (!strcmp(what, "threads") && argc == 4) return threads(atoi(argv[2]), atoi(argv[3]));
    if (!strcmp(what, "pace")) return pace();
    if (!strcmp(what, "speed")) return speed(argc > 2 ? atoi(argv[2]) : 1);
    die("unknown case");
    return 1;
}
