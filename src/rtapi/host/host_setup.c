/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * host_setup.c - realtime rights of the host: detection, memory locking, CPU, messages.
 * Thread: [init]; the message queue is written by [servo] and drained by a thread of its own.
 */
#include "host.h"

#include <errno.h>
#include <fcntl.h>
#include <malloc.h>
#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/utsname.h>
#include <time.h>
#include <unistd.h>
#include "kerf_clock.h"

#define HEAP_BYTES (32UL << 20)
#define QUEUE 128
#define TEXT 1020
#define DRAIN_NS 10000000

static const char *capability(int bit)
{
    static char line[128];
    FILE *f = fopen("/proc/self/status", "r");
    const char *answer = "unknown";
    while (f && fgets(line, sizeof line, f))
        if (!strncmp(line, "CapEff:", 7)) answer = strtoull(line + 7, NULL, 16) >> bit & 1 ? "yes" : "no";
    if (f) fclose(f);
    return answer;
}

rtapi_realtime_type_t host_realtime_type(void)
{
    static rtapi_realtime_type_t type = REALTIME_TYPE_UNINITIALIZED;
    if (type != REALTIME_TYPE_UNINITIALIZED) return type;
    if (kerf_clock_is_virtual()) return type = REALTIME_TYPE_NONE;
    const char *force = getenv("LINUXCNC_FORCE_REALTIME");
    int forced = force && atoi(force) != 0;
    if (!forced) {
        struct sched_param old, p = {.sched_priority = sched_get_priority_min(SCHED_FIFO)};
        int old_policy = sched_getscheduler(0);
        sched_getparam(0, &old);
        if (sched_setscheduler(0, SCHED_FIFO, &p) < 0) {
            int e = errno;
            fprintf(stderr,
                    "Note: realtime scheduling unavailable (sched_setscheduler SCHED_FIFO: %s).\n"
                    "  Process capabilities: cap_sys_nice=%s cap_ipc_lock=%s.\n"
                    "  Falling back to POSIX non-realtime.\n"
                    "  Fix: 'sudo make setcap' (preferred) or 'sudo make setuid' on rtapi_app.\n"
                    "  Override (testing only): set LINUXCNC_FORCE_REALTIME=1.\n",
                    strerror(e), capability(23), capability(14));
            return type = REALTIME_TYPE_NONE;
        }
        sched_setscheduler(0, old_policy, &old);
    }
    struct utsname u;
    uname(&u);
    if (strcasestr(u.version, "PREEMPT RT") || strcasestr(u.version, "PREEMPT_RT")) return type = REALTIME_TYPE_PREEMPT_RT;
    if (forced) {
        if (strstr(u.version, "PREEMPT_DYNAMIC") || strstr(u.version, "PREEMPT DYNAMIC"))
            return type = REALTIME_TYPE_PREEMPT_DYNAMIC;
        fprintf(stderr, "rtapi_get_realtime_type: Realtime type unknown but SCHED_FIFO available\n");
        return type = REALTIME_TYPE_UNKNOWN;
    }
    fprintf(stderr, "Note: realtime scheduling unavailable.\n  Falling back to POSIX non-realtime.\n"
                    "  Override (testing only): set LINUXCNC_FORCE_REALTIME=1.\n");
    return type = REALTIME_TYPE_NONE;
}

rtapi_realtime_type_t rtapi_get_realtime_type(void)
{
    return host_realtime_type();
}

int rtapi_is_realtime(void)
{
    return host_realtime_type() > REALTIME_TYPE_NONE;
}

int host_realtime_cpu(void)
{
    static int cpu = -2;
    if (cpu != -2) return cpu;
    cpu = -1;
    if (sysconf(_SC_NPROCESSORS_ONLN) <= 1 || kerf_clock_is_virtual()) return cpu;
    const char *env = getenv("RTAPI_CPU_NUMBER");
    if (env) return cpu = atoi(env);
    FILE *f = fopen("/sys/devices/system/cpu/isolated", "r");
    char list[256] = "";
    if (f) {
        if (!fgets(list, sizeof list, f)) list[0] = 0;
        fclose(f);
    }
    for (char *p = list; *p >= '0' && *p <= '9';) {
        cpu = (int)strtol(p, &p, 10);
        if (*p == '-') cpu = (int)strtol(p + 1, &p, 10);
        if (*p == ',') p++;
    }
    if (cpu < 0)
        rtapi_print_msg(RTAPI_MSG_ERR, "No isolated CPU's found, expect some latency or set RTAPI_CPU_NUMBER to select CPU\n");
    return cpu;
}

void host_setup(void)
{
    if (host_realtime_type() <= REALTIME_TYPE_NONE) return;
    struct rlimit all = {RLIM_INFINITY, RLIM_INFINITY};
    setrlimit(RLIMIT_RTPRIO, &all);
    struct rlimit locked;
    if (getrlimit(RLIMIT_MEMLOCK, &locked) == 0) {
        locked.rlim_cur = locked.rlim_max;
        setrlimit(RLIMIT_MEMLOCK, &locked);
    }
    if (mlockall(MCL_CURRENT | MCL_FUTURE) < 0)
        rtapi_print_msg(RTAPI_MSG_WARN, "mlockall failed: %s. Realtime latency may suffer.\n", strerror(errno));
    mallopt(M_TRIM_THRESHOLD, -1);
    mallopt(M_MMAP_MAX, 0);
    char *heap = malloc(HEAP_BYTES);
    if (heap) {
        for (size_t i = 0; i < HEAP_BYTES; i += 4096) ((volatile char *)heap)[i] = 0;
        free(heap);
    }
}

/* ---- messages: a bounded queue with sequence numbers, many writers and one reader ---- */

struct message {
    _Atomic unsigned long turn;
    int level;
    char text[TEXT];
};
static struct message queue[QUEUE];
static _Atomic unsigned long head;
static unsigned long tail;
static pthread_t main_thread;
static pthread_mutex_t drain_lock = PTHREAD_MUTEX_INITIALIZER;

static void drain(void)
{
    pthread_mutex_lock(&drain_lock);
    for (;;) {
        struct message *m = &queue[tail % QUEUE];
        if (atomic_load_explicit(&m->turn, memory_order_acquire) != tail + 1) break;
        FILE *to = m->level == RTAPI_MSG_ALL ? stdout : stderr;
        fputs(m->text, to);
        fflush(to);
        atomic_store_explicit(&m->turn, tail + QUEUE, memory_order_release);
        tail++;
    }
    pthread_mutex_unlock(&drain_lock);
}

static void *drain_loop(void *arg)
{
    (void)arg;
    pthread_setname_np(pthread_self(), "rtapi_app:mesg");
    for (;;) {
        struct timespec t = {0, DRAIN_NS};
        nanosleep(&t, NULL);
        drain();
    }
    return NULL;
}

void host_messages_start(void)
{
    for (unsigned long i = 0; i < QUEUE; i++) queue[i].turn = i;
    main_thread = pthread_self();
    pthread_t t;
    pthread_create(&t, NULL, drain_loop, NULL);
}

void host_messages_flush(void)
{
    drain();
}

void rtapi_default_msg_handler(msg_level_t level, const char *fmt, va_list ap)
{
    if (!main_thread || pthread_equal(pthread_self(), main_thread)) {
        FILE *to = level == RTAPI_MSG_ALL ? stdout : stderr;
        vfprintf(to, fmt, ap);
        fflush(to);
        return;
    }
    unsigned long at = atomic_load_explicit(&head, memory_order_relaxed);
    for (;;) {
        struct message *m = &queue[at % QUEUE];
        unsigned long turn = atomic_load_explicit(&m->turn, memory_order_acquire);
        if (turn == at) {
            if (!atomic_compare_exchange_weak(&head, &at, at + 1)) continue;
            m->level = (int)level;
            vsnprintf(m->text, TEXT, fmt, ap);
            atomic_store_explicit(&m->turn, at + 1, memory_order_release);
            return;
        }
        if (turn < at) return; /* full */
        at = atomic_load_explicit(&head, memory_order_relaxed);
    }
}

long rtapi_delay_max(void)
{
    return 10000;
}

void rtapi_delay(long ns)
{
    if (ns > 0) kerf_clock_sleep_ns(ns < 10000 ? ns : 10000);
}
