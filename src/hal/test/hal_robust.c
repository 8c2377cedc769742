/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hal_robust.c - HAL and processes that die or get in each other's way.
 *
 *   hal-robust stores STRIDE       processes die before every STRIDE-th store to memory
 *                                  of each changing call
 *   hal-robust kills N SEED        kills N processes at random moments
 *   hal-robust together P N SEED   P processes make N changes each at once
 *   hal-robust threads P N SEED    the same while threads run functions of a module that
 *                                  the test in tests/hal brings
 *   hal-robust hang                frees the lock of a stopped process
 *   hal-robust beat PIN            a counting s64 pin goes on while a stopped process holds
 *                                  the lock
 *   hal-robust check               looks at the database; prints the memory in use (KiB)
 *                                  and the process id of the realtime host
 *   hal-robust reap                components of a dead process
 *
 * Contains the library, so that the database itself can be looked at. Exit status
 * 0 and a line of summary, or 1.
 */
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>
#include "hal_check.h"
#include "hal_priv.h"
#include "stores.h"

static int failures;
#define CHECK(condition, ...)              \
    do {                                   \
        if (!(condition)) {                \
            failures++;                    \
            fprintf(stderr, "FAILED: ");   \
            fprintf(stderr, __VA_ARGS__);  \
            fputc('\n', stderr);           \
        }                                  \
    } while (0)

/* ---- What the processes work on ------------------------------------------------------ */

struct memory {
    hal_float_t *f[16];
    hal_s32_t *s[16];
    hal_bit_t par[4];
};

/* The pins of component name; its id. */
static int make_small(const char *name, struct memory **m)
{
    int id = hal_init(name);
    if (id < 0) {
        return id;
    }
    *m = hal_malloc(sizeof **m);
    hal_pin_float_newf(HAL_OUT, &(*m)->f[0], id, "%s.f0", name);
    hal_pin_s32_newf(HAL_IN, &(*m)->s[0], id, "%s.s0", name);
    hal_param_bit_newf(HAL_RW, &(*m)->par[0], id, "%s.par0", name);
    return id;
}

static int make_comp(const char *name, struct memory **m)
{
    int id = hal_init(name);
    if (id < 0) {
        return id;
    }
    *m = hal_malloc(sizeof **m);
    for (int i = 0; i < 16; i++) {
        hal_pin_float_newf(i % 3 == 0 ? HAL_OUT : i % 3 == 1 ? HAL_IN : HAL_IO, &(*m)->f[i], id, "%s.f%d", name, i);
        hal_pin_s32_newf(i % 2 ? HAL_IN : HAL_OUT, &(*m)->s[i], id, "%s.s%d", name, i);
    }
    for (int i = 0; i < 4; i++) {
        hal_param_bit_newf(HAL_RW, &(*m)->par[i], id, "%s.par%d", name, i);
    }
    return id;
}

static unsigned next_random(unsigned *state)
{
    *state = *state * 1664525u + 1013904223u;
    return *state >> 8;
}

/* One random change; comp may be any component's name. */
static void change(const char *comp, unsigned *seed)
{
    char pin[HAL_NAME_LEN + 1], sig[HAL_NAME_LEN + 1];
    unsigned r = next_random(seed);
    bool real = next_random(seed) % 2;
    snprintf(pin, sizeof pin, "%s.%c%u", comp, real ? 'f' : 's', next_random(seed) % 16);
    snprintf(sig, sizeof sig, "sig-%c%u", real ? 'f' : 's', next_random(seed) % 24);
    switch (r % 8) {
    case 0: hal_signal_new(sig, real ? HAL_FLOAT : HAL_S32); break;
    case 1: hal_signal_delete(sig); break;
    case 2:
    case 3:
    case 4: hal_link(pin, sig); break;
    case 5: hal_unlink(pin); break;
    case 6: {
        char alias[HAL_NAME_LEN + 1];
        snprintf(alias, sizeof alias, "alias-%s-%u", comp, next_random(seed) % 8);
        hal_pin_alias(pin, next_random(seed) % 2 ? alias : NULL);
        break;
    }
    case 7: {
        hal_query_t q = {.name = pin};
        hal_get_p(&q, NULL, NULL);
        break;
    }
    }
}

static void quiet(msg_level_t level, const char *fmt, va_list ap)
{
    (void)level;
    (void)fmt;
    (void)ap;
}

/* ---- Death at each store ----------------------------------------------------------- */

static int victim_id;
static struct memory *victim_memory;

static void step_comp(void)
{
    int id = make_small("stepped", &victim_memory);
    hal_ready(id);
}
static void step_exit(void) { hal_exit(victim_id); }
static void step_link(void) { hal_link("victim.f1", "shared"); }
static void step_unlink(void) { hal_unlink("victim.f4"); }
static void step_signal(void) { hal_signal_new("stepped-signal", HAL_FLOAT); }
static void step_delete(void) { hal_signal_delete("shared"); }
static void step_alias(void) { hal_pin_alias("victim.f2", "stepped-alias"); }
static void step_unalias(void) { hal_pin_alias("victim.f7", NULL); }
static void step_realias(void) { hal_pin_alias("victim.f7", "stepped-alias"); }

static const struct {
    const char *name;
    void (*run)(void);
} steps[] = {
    {"hal_link", step_link},         {"hal_unlink", step_unlink},   {"hal_signal_new", step_signal},
    {"hal_signal_delete", step_delete}, {"hal_pin_alias", step_alias}, {"hal_pin_alias(NULL)", step_unalias},
    {"hal_pin_alias again", step_realias}, {"hal_exit", step_exit}, {"hal_init and pins", step_comp},
};

static void set_up_victim(bool small)
{
    victim_id = small ? make_small("victim", &victim_memory) : make_comp("victim", &victim_memory);
    hal_ready(victim_id);
    hal_signal_new("shared", HAL_FLOAT);
    if (small) {
        hal_link("victim.f0", "shared");
        hal_pin_alias("victim.s0", "old-alias");
        return;
    }
    hal_link("victim.f0", "shared");
    hal_link("victim.f4", "shared");
    hal_pin_alias("victim.f7", "old-alias");
}

/* Runs one call and dies in it before its count-th store to memory. True: the call
 * was over before that. */
static bool kill_before(int which, long count)
{
    pid_t pid = fork();
    if (pid == 0) {
        set_up_victim(steps[which].run == step_exit);
        stores_left = count;
        steps[which].run();
        stores_left = 0;
        kill(getpid(), SIGTERM); /* dead as well, but after the call */
        pause();
    }
    int status;
    waitpid(pid, &status, 0);
    CHECK(WIFSIGNALED(status), "%s, store %ld: the process ended with 0x%x", steps[which].name, count, status);
    return !(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
}

/* The others go on: nothing of the dead is left, everything works. */
static void look_after_death(const char *what, long count)
{
    CHECK(hal_comp_by_name("victim", NULL) == -ENOENT && hal_comp_by_name("stepped", NULL) == -ENOENT,
          "%s, store %ld: the dead component is still there", what, count);
    CHECK(hal_check() == 0, "%s, store %ld: the database is damaged", what, count);
    hal_signal_delete("shared");
    hal_signal_delete("stepped-signal");
    CHECK(hal_check() == 0, "%s, store %ld: the database is damaged afterwards", what, count);
}

static void run_stores(long stride)
{
    long total = 0;
    for (size_t w = 0; w < sizeof steps / sizeof *steps; w++) {
        int before = failures;
        long count = 1;
        for (bool over = false; !over && failures < before + 20; count += stride) {
            over = kill_before((int)w, count);
            look_after_death(steps[w].name, count);
            total++;
        }
        CHECK(count > 2 * stride, "%s: no stores seen", steps[w].name);
    }
    printf("%s: processes died before %s store of each changing call\n", failures ? "bad" : "good",
           stride == 1 ? "every" : "many a");
    fprintf(stderr, "%ld deaths, %u repairs\n", total, hal_data->repairs);
}

/* ---- Death at random moments ----------------------------------------------------------------- */

static void worker(int number, unsigned seed, long changes)
{
    char name[32];
    struct memory *m;
    rtapi_set_msg_handler(quiet);
    snprintf(name, sizeof name, "worker%d", number);
    int id = make_comp(name, &m);
    if (id < 0) {
        _exit(id == -EEXIST ? 2 : 1);
    }
    hal_ready(id);
    for (long i = 0; changes < 0 || i < changes; i++) {
        char other[32];
        snprintf(other, sizeof other, "worker%u", next_random(&seed) % 4);
        change(next_random(&seed) % 4 ? name : other, &seed);
        for (int k = 0; k < 16; k += 3) {
            *m->f[k] = (double)i;
        }
        if (i % 64 == 63) {
            hal_exit(id);
            id = make_comp(name, &m);
            hal_ready(id);
        }
    }
    hal_exit(id);
    hal_lib_exit();
    _exit(0);
}

static pid_t spawn(int number, unsigned seed, long changes)
{
    fflush(stdout);
    pid_t pid = fork();
    if (pid == 0) {
        worker(number, seed, changes);
    }
    return pid;
}

static void run_kills(int n, unsigned seed)
{
    enum { WORKERS = 4 };
    pid_t pids[WORKERS];
    int bad = 0;
    rtapi_set_msg_handler(quiet);
    for (int i = 0; i < WORKERS; i++) {
        pids[i] = spawn(i, seed + (unsigned)i, -1);
    }
    for (int k = 0; k < n; k++) {
        struct timespec pause = {0, (long)(next_random(&seed) % 4000) * 1000};
        int status, victim = (int)(next_random(&seed) % WORKERS);
        nanosleep(&pause, NULL);
        kill(pids[victim], SIGKILL);
        waitpid(pids[victim], &status, 0);
        bad += !(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
        pids[victim] = spawn(victim, seed, -1);
        if (k % 16 == 0) {
            CHECK(hal_check() == 0, "kill %d (seed %u): the database is damaged", k, seed);
        }
    }
    for (int i = 0; i < WORKERS; i++) {
        kill(pids[i], SIGKILL);
        waitpid(pids[i], NULL, 0);
    }
    CHECK(bad == 0, "%d workers ended by themselves", bad);
    CHECK(hal_comp_by_name("worker0", NULL) == -ENOENT && hal_comp_by_name("worker1", NULL) == -ENOENT &&
              hal_comp_by_name("worker2", NULL) == -ENOENT && hal_comp_by_name("worker3", NULL) == -ENOENT,
          "a dead component is still there");
    CHECK(hal_check() == 0, "the database is damaged");
    printf("%s: %d processes killed at random moments\n", failures ? "bad" : "good", n);
    fprintf(stderr, "%u repairs\n", hal_data->repairs);
}

/* ---- All at once -------------------------------------------------------------------------------- */

static void run_together(int processes, long changes, unsigned seed)
{
    pid_t pids[64];
    processes = processes > 64 ? 64 : processes;
    rtapi_set_msg_handler(quiet);
    for (int i = 0; i < processes; i++) {
        pids[i] = spawn(i, seed + (unsigned)i * 7919u, changes);
    }
    for (int i = 0; i < processes; i++) {
        int status;
        waitpid(pids[i], &status, 0);
        CHECK(WIFEXITED(status) && WEXITSTATUS(status) == 0, "worker %d ended with status 0x%x", i, status);
    }
    CHECK(hal_check() == 0, "the database is damaged");
    hal_statistics_t st;
    hal_statistics(&st);
    CHECK(st.npins == 0 && st.nparams == 0 && st.naliases == 0, "left: %d pins, %d parameters, %d aliases", st.npins,
          st.nparams, st.naliases);
    CHECK(st.mem_total - st.mem_free < 8 << 20, "%ld bytes are in use", st.mem_total - st.mem_free);
    CHECK(hal_data->repairs == 0, "%u repairs without a death", hal_data->repairs);
    printf("%s: %d processes made changes at once\n", failures ? "bad" : "good", processes);
}

/* ---- Under running threads --------------------------------------------------------------------------- */

enum { FUNCTS = 16 };

static bool halves_differ(const char *sig)
{
    hal_query_t q = {.name = sig};
    return hal_get_s(&q, NULL, NULL) == 0 && (int32_t)(q.sig.value.s >> 32) != (int32_t)q.sig.value.s;
}

static void thread_change(unsigned *seed)
{
    char funct[32], pin[48], sig[32];
    unsigned i = next_random(seed) % FUNCTS;
    const char *thread = next_random(seed) % 2 ? "fast" : "slow";
    snprintf(funct, sizeof funct, "stress.%u", i);
    snprintf(pin, sizeof pin, "stress.%u.%s", i, next_random(seed) % 2 ? "out" : "in");
    snprintf(sig, sizeof sig, "sig%u", next_random(seed) % 8);
    switch (next_random(seed) % 10) {
    case 0:
    case 1: hal_add_funct_to_thread(funct, thread, next_random(seed) % 2 ? 1 : -1); break;
    case 2:
    case 3: hal_del_funct_from_thread(funct, thread); break;
    case 4: hal_signal_new(sig, HAL_S64); break;
    case 5: hal_signal_delete(sig); break;
    case 6:
    case 7: hal_link(pin, sig); break;
    case 8: hal_unlink(pin); break;
    case 9: CHECK(!halves_differ(sig), "signal '%s' is torn", sig); break;
    }
}

static int count_users(hal_query_t *q, void *arg)
{
    (void)arg;
    CHECK(q->funct.users <= 1, "function '%s' runs %d times", q->name, q->funct.users);
    return 0;
}

static void run_threads(int processes, long changes, unsigned seed)
{
    pid_t pids[16];
    rtapi_set_msg_handler(quiet);
    processes = processes > 16 ? 16 : processes;
    for (int i = 0; i < processes; i++) {
        fflush(stdout);
        if ((pids[i] = fork()) == 0) {
            unsigned mine = seed + (unsigned)i * 7919u;
            for (long n = 0; n < changes; n++) {
                thread_change(&mine);
            }
            _exit(failures != 0);
        }
    }
    for (int i = 0; i < processes; i++) {
        int status;
        waitpid(pids[i], &status, 0);
        CHECK(WIFEXITED(status) && WEXITSTATUS(status) == 0, "process %d ended with 0x%x", i, status);
    }
    hal_list_funct(&(hal_query_t){0}, count_users, NULL);
    for (int i = 0; i < FUNCTS; i++) {
        char name[48];
        snprintf(name, sizeof name, "stress.%d.errors", i);
        hal_query_t q = {.name = name};
        CHECK(hal_get_p(&q, NULL, NULL) == 0 && q.pp.value.s == 0, "%s: %lld", name, (long long)q.pp.value.s);
    }
    CHECK(hal_check() == 0, "the database is damaged");
    for (int i = 0; i < 8; i++) {
        char name[16];
        snprintf(name, sizeof name, "sig%d", i);
        hal_signal_delete(name);
    }
    printf("%s: %d processes made changes under running threads\n", failures ? "bad" : "good", processes);
}

/* ---- A process that hangs -------------------------------------------------------------------------- */

static int hang_here(hal_query_t *q, void *arg)
{
    (void)q;
    (void)arg;
    raise(SIGSTOP);
    return 0;
}

static void run_hang(void)
{
    int status;
    hal_signal_new("s", HAL_BIT);
    pid_t pid = fork();
    if (pid == 0) {
        struct memory *m;
        hal_ready(make_comp("hanging", &m));
        hal_query_t q = {.name = "s"};
        hal_get_s(&q, hang_here, NULL);
        _exit(hal_signal_new("after", HAL_BIT) == 0 && hal_signal_delete("after") == 0 ? 0 : 1);
    }
    waitpid(pid, &status, WUNTRACED);
    CHECK(WIFSTOPPED(status), "the process does not hang");
    CHECK(hal_mutex_force_release() == 0, "release refused");
    CHECK(hal_signal_new("t", HAL_BIT) == 0 && hal_signal_delete("t") == 0, "no change possible after the release");
    kill(pid, SIGCONT);
    waitpid(pid, &status, 0);
    CHECK(WIFEXITED(status) && WEXITSTATUS(status) == 0, "the process that hung ended with 0x%x", status);
    CHECK(hal_mutex_force_release() == 0, "release of a free lock refused");
    CHECK(hal_check() == 0, "the database is damaged");
    hal_signal_delete("s");
    printf("%s: the lock of a process that hangs can be freed\n", failures ? "bad" : "good");
}

/* ---- Realtime and the lock ------------------------------------------------------------------------------ */

static void run_beat(const char *pin)
{
    hal_query_t q = {.name = pin};
    if (hal_getref_p(&q) < 0 || q.pp.type != HAL_S64) {
        CHECK(0, "no s64 pin '%s'", pin);
        return;
    }
    int status;
    hal_signal_new("beat-test", HAL_BIT);
    pid_t pid = fork();
    if (pid == 0) {
        hal_query_t held = {.name = "beat-test"};
        hal_get_s(&held, hang_here, NULL);
        _exit(0);
    }
    waitpid(pid, &status, WUNTRACED);
    CHECK(WIFSTOPPED(status), "the process does not hang");
    rtapi_s64 before = hal_get_sint(q.pp.ref.s), now = before;
    for (int ms = 0; ms < 10000 && now < before + 100; ms++) {
        struct timespec pause = {0, 1000000};
        nanosleep(&pause, NULL);
        now = hal_get_sint(q.pp.ref.s);
    }
    CHECK(now >= before + 100, "the thread made %lld cycles", (long long)(now - before));
    kill(pid, SIGKILL);
    waitpid(pid, &status, 0);
    CHECK(hal_signal_delete("beat-test") == 0, "the lock is lost");
    printf("%s: the thread goes on while a client holds the lock\n", failures ? "bad" : "good");
}

/* ---- What is said about the dead --------------------------------------------------------------------- */

static char said[4096];

static void listen_(msg_level_t level, const char *fmt, va_list ap)
{
    size_t n = strlen(said);
    (void)level;
    vsnprintf(said + n, sizeof said - n, fmt, ap);
}

static void run_reap(void)
{
    int status, to[2];
    char byte = 0;
    pid_t pid;
    hal_signal_new("kept", HAL_FLOAT);
    if (pipe(to) < 0 || (pid = fork()) < 0) {
        exit(1);
    }
    if (pid == 0) {
        struct memory *m;
        hal_ready(make_comp("dead", &m));
        *m->f[0] = 12.5;
        hal_link("dead.f0", "kept");
        if (write(to[1], &byte, 1) != 1) {
            _exit(1);
        }
        pause();
    }
    if (read(to[0], &byte, 1) != 1) {
        exit(1);
    }
    CHECK(hal_comp_by_name("dead", NULL) == 0, "the component is not there");
    kill(pid, SIGKILL);
    struct timespec wait = {0, 1000000};
    siginfo_t info;
    waitid(P_PID, (id_t)pid, &info, WEXITED | WNOWAIT); /* a zombie is dead as well */
    nanosleep(&wait, NULL);
    rtapi_set_msg_handler(listen_);
    CHECK(hal_comp_by_name("dead", NULL) == -ENOENT, "the dead component is still there");
    rtapi_set_msg_handler(NULL);
    char *number = strstr(said, "process ");
    if (number) {
        CHECK(atoi(number + 8) == pid, "the message names another process: %s", said);
        memset(number + 8, 'P', strspn(number + 8, "0123456789"));
        char *p = number + 9;
        size_t digits = strspn(p, "P");
        memmove(p, p + digits, strlen(p + digits) + 1);
    }
    fputs(said, stdout);
    waitpid(pid, &status, 0);
    hal_query_t q = {.name = "kept"};
    CHECK(hal_get_s(&q, NULL, NULL) == 0 && q.sig.value.r == 12.5 && q.sig.writers == 0, "the signal lost its value");
    hal_signal_delete("kept");
    CHECK(hal_check() == 0, "the database is damaged");
    printf("%s: the signal keeps its value and is free\n", failures ? "bad" : "good");
}

int main(int argc, char **argv)
{
    const char *what = argc > 1 ? argv[1] : "";
    if (hal_lib_init() < 0) {
        return 1;
    }
    if (strcmp(what, "stores") == 0) {
        rtapi_set_msg_handler(quiet);
        run_stores(argc > 2 ? atol(argv[2]) : 1);
    } else if (strcmp(what, "kills") == 0) {
        run_kills(argc > 2 ? atoi(argv[2]) : 200, argc > 3 ? (unsigned)atol(argv[3]) : 1);
    } else if (strcmp(what, "together") == 0) {
        run_together(argc > 2 ? atoi(argv[2]) : 4, argc > 3 ? atol(argv[3]) : 10000,
                     argc > 4 ? (unsigned)atol(argv[4]) : 1);
    } else if (strcmp(what, "threads") == 0) {
        run_threads(argc > 2 ? atoi(argv[2]) : 4, argc > 3 ? atol(argv[3]) : 10000,
                    argc > 4 ? (unsigned)atol(argv[4]) : 1);
    } else if (strcmp(what, "hang") == 0) {
        run_hang();
    } else if (strcmp(what, "beat") == 0) {
        run_beat(argc > 2 ? argv[2] : "");
    } else if (strcmp(what, "check") == 0) {
        hal_statistics_t st;
        hal_statistics(&st);
        CHECK(hal_check() == 0, "the database is damaged");
        printf("%ld %d\n", (st.mem_total - st.mem_free) >> 10, hal_data->host.pid);
    } else if (strcmp(what, "reap") == 0) {
        run_reap();
    } else {
        fprintf(stderr, "hal-robust stores|kills|together|threads|hang|beat|check|reap ...\n");
        failures++;
    }
    hal_lib_exit();
    return failures != 0;
}
