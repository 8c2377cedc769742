/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * host_rt.c - what this machine and this process may do in real time.
 *
 * In:     scheduler, capabilities, kernel version, environment
 * Out:    realtime type, CPU for tasks; locked memory; signal handling
 * Thread: [init], the command thread
 */
#include "host.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <malloc.h>
#include <pwd.h>
#include <sched.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/fsuid.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/utsname.h>
#include <unistd.h>
#include <linux/capability.h>
#if defined(__x86_64__) || defined(__i386__)
#include <sys/io.h>
#endif
#include "kerf_clock.h"

#define HEAP_PREFAULT (32UL << 20)

/* ---- Capabilities ------------------------------------------------------- */

struct cap_sets {
    struct __user_cap_header_struct head;
    struct __user_cap_data_struct data[2];
};

static bool caps_get(struct cap_sets *c)
{
    c->head = (struct __user_cap_header_struct){_LINUX_CAPABILITY_VERSION_3, 0};
    return syscall(SYS_capget, &c->head, c->data) == 0;
}

static const char *cap_word(int cap)
{
    struct cap_sets c;
    return !caps_get(&c) ? "unknown" : c.data[cap / 32].effective >> (cap % 32) & 1 ? "yes" : "no";
}

/* Children of drivers (a firewall tool) inherit CAP_NET_ADMIN if we have it. */
static void cap_net_admin_to_children(void)
{
    struct cap_sets c;
    unsigned bit = 1U << CAP_NET_ADMIN;
    if (!caps_get(&c) || !(c.data[0].permitted & bit)) {
        return;
    }
    c.data[0].inheritable |= bit;
    if (syscall(SYS_capset, &c.head, c.data) == 0) {
        prctl(PR_CAP_AMBIENT, PR_CAP_AMBIENT_RAISE, CAP_NET_ADMIN, 0, 0);
    }
}

/* ---- Users -------------------------------------------------------------- */

static uid_t real_uid, effective_uid;

int host_privileges_init(void)
{
    real_uid = getuid();
    effective_uid = geteuid();
    const char *fallback = getenv("RTAPI_UID");
    if (real_uid == 0 && fallback && *fallback) {
        long uid = strtol(fallback, NULL, 10);
        if (uid <= 0) {
            fprintf(stderr,
                    "Refusing to run as root without fallback UID specified\n"
                    "RTAPI_UID=%s is not the number of an ordinary user. Unset it to run as root.\n",
                    fallback);
            return 1;
        }
        if (setresuid((uid_t)uid, 0, 0) != 0) {
            fprintf(stderr, "rtapi_app: setresuid(%ld, 0, 0): %s\n", uid, strerror(errno));
            return 1;
        }
        real_uid = (uid_t)uid;
        fprintf(stderr, "Running with fallback_uid.  getuid()=%d geteuid()=%d\n", (int)getuid(), (int)geteuid());
    }
    if (effective_uid == 0) {
        setfsuid(real_uid);
    }
    rtapi_shmem_policy.privileged = effective_uid == 0;
    rtapi_shmem_policy.owner = real_uid;
    rtapi_shmem_policy.root_begin = host_root_begin;
    rtapi_shmem_policy.root_end = host_root_end;
    cap_net_admin_to_children();
    return 0;
}

static __thread int root_depth;

void host_root_begin(void)
{
    if (root_depth++ == 0 && effective_uid == 0 && real_uid != 0) {
        setfsuid(0);
    }
}

void host_root_end(void)
{
    if (--root_depth == 0 && effective_uid == 0 && real_uid != 0) {
        setfsuid(real_uid);
    }
}

/* ---- Realtime type ------------------------------------------------------ */

const char *host_realtime_name(rtapi_realtime_type_t type)
{
    static const char *const names[] = {"No realtime", "Unknown (SCHED_FIFO)", "Preempt Dynamic", "Preempt RT",
                                        "RTAI",        "LXRT",                 "Xenomai",         "Xenomai EVL"};
    return type >= 0 && (size_t)type < sizeof names / sizeof *names ? names[type] : "Uninitialized";
}

/* [init] LINUXCNC_FORCE_REALTIME: an integer, 0 or none: no. Another word is no, and said so. */
static bool find_forced(void)
{
    const char *env = getenv("LINUXCNC_FORCE_REALTIME");
    char *end;
    long value = env ? strtol(env, &end, 10) : 0;
    if (env && (end == env || *end) && *env) {
        fprintf(stderr, "LINUXCNC_FORCE_REALTIME=%s is not an integer: set it to 1 to force realtime; %s\n", env,
                value ? "taken as 1" : "ignored");
    }
    return value != 0;
}

/* May this thread become SCHED_FIFO? Tries it and goes back. 0 or an errno. */
static int probe_fifo(void)
{
    struct sched_param old, fifo = {.sched_priority = sched_get_priority_min(SCHED_FIFO)};
    int policy = sched_getscheduler(0);
    if (policy < 0 || sched_getparam(0, &old) < 0 || sched_setscheduler(0, SCHED_FIFO, &fifo) < 0) {
        return errno;
    }
    sched_setscheduler(0, policy, &old);
    return 0;
}

static rtapi_realtime_type_t find_type(void)
{
    struct utsname kernel;
    const bool forced = find_forced();
    if (!forced) {
        int err = probe_fifo();
        if (err) {
            fprintf(stderr,
                    "Note: realtime scheduling unavailable (sched_setscheduler SCHED_FIFO: %s).\n"
                    "  Process capabilities: cap_sys_nice=%s cap_ipc_lock=%s.\n"
                    "  Falling back to POSIX non-realtime.\n"
                    "  Fix: 'sudo make setcap' (preferred) or 'sudo make setuid' on rtapi_app.\n"
                    "  Override (testing only): set LINUXCNC_FORCE_REALTIME=1.\n",
                    strerror(err), cap_word(CAP_SYS_NICE), cap_word(CAP_IPC_LOCK));
            return REALTIME_TYPE_NONE;
        }
    }
#ifdef KERF_EVL
    if (host_evl_usable()) {
        return REALTIME_TYPE_XENOMAI_EVL;
    }
#endif
    if (uname(&kernel) == 0) {
        if (strcasestr(kernel.version, "PREEMPT RT") || strcasestr(kernel.version, "PREEMPT_RT")) {
            return REALTIME_TYPE_PREEMPT_RT;
        }
        if (forced) {
            if (strcasestr(kernel.version, "PREEMPT_DYNAMIC") || strcasestr(kernel.version, "PREEMPT DYNAMIC")) {
                return REALTIME_TYPE_PREEMPT_DYNAMIC;
            }
            fprintf(stderr, "rtapi_get_realtime_type: Realtime type unknown but SCHED_FIFO available\n");
            return REALTIME_TYPE_UNKNOWN;
        }
    }
    fprintf(stderr, "Note: realtime scheduling unavailable.\n"
                    "  Falling back to POSIX non-realtime.\n"
                    "  Override (testing only): set LINUXCNC_FORCE_REALTIME=1.\n");
    return REALTIME_TYPE_NONE;
}

rtapi_realtime_type_t host_realtime_type(void)
{
    static rtapi_realtime_type_t found = REALTIME_TYPE_UNINITIALIZED;
    if (found == REALTIME_TYPE_UNINITIALIZED) {
        found = kerf_clock_is_virtual() ? REALTIME_TYPE_NONE : find_type();
    }
    return found;
}

rtapi_realtime_type_t rtapi_get_realtime_type(void)
{
    return host_realtime_type();
}

int rtapi_is_realtime(void)
{
    return host_realtime_type() > REALTIME_TYPE_NONE;
}

/* First line of a small file without its end; "" when it cannot be read. */
static void read_line(const char *path, char *buf, size_t size)
{
    FILE *f = fopen(path, "re");
    if (!f || !fgets(buf, (int)size, f)) {
        buf[0] = 0;
    }
    buf[strcspn(buf, "\n")] = 0;
    if (f) {
        fclose(f);
    }
}

/* A file of the kernel's about its CPUs. Tests put a folder in its place, which a program with more rights than its
 * user does not look at. */
static void read_cpu_file(const char *name, char *buf, size_t size)
{
    char path[PATH_MAX];
    const char *top = secure_getenv("KERF_SYSFS");
    snprintf(path, sizeof path, "%s/devices/system/cpu/%s", top ? top : "/sys", name);
    read_line(path, buf, size);
}

void host_realtime_report(void)
{
    struct utsname kernel;
    struct rlimit memlock;
    char isolated[128], governor[64], sysrt[16], runtime[32], lockdown[128];
    read_cpu_file("isolated", isolated, sizeof isolated);
    read_cpu_file("cpu0/cpufreq/scaling_governor", governor, sizeof governor);
    read_line("/sys/kernel/realtime", sysrt, sizeof sysrt);
    read_line("/proc/sys/kernel/sched_rt_runtime_us", runtime, sizeof runtime);
    read_line("/sys/kernel/security/lockdown", lockdown, sizeof lockdown);
    if (uname(&kernel) == 0) {
        fprintf(stderr, "kernel: %s %s%s\n", kernel.release, kernel.version,
                sysrt[0] == '1' ? " (/sys/kernel/realtime = 1)" : "");
    }
    int err = probe_fifo();
    fprintf(stderr, "SCHED_FIFO: %s\n", err ? strerror(err) : "available");
    if (runtime[0] && strcmp(runtime, "-1") != 0) {
        fprintf(stderr, "realtime throttling: %s us of each second (sysctl kernel.sched_rt_runtime_us)\n", runtime);
    }
    getrlimit(RLIMIT_MEMLOCK, &memlock);
    if (strcmp(cap_word(CAP_IPC_LOCK), "yes") == 0 || memlock.rlim_max == RLIM_INFINITY) {
        fprintf(stderr, "memory lock: unlimited\n");
    } else {
        fprintf(stderr, "memory lock: at most %llu KiB (needs cap_ipc_lock or a higher RLIMIT_MEMLOCK)\n",
                (unsigned long long)memlock.rlim_max >> 10);
    }
    fprintf(stderr, "isolated CPUs: %s of %ld\n", isolated[0] ? isolated : "none", sysconf(_SC_NPROCESSORS_ONLN));
    if (governor[0]) {
        fprintf(stderr, "CPU frequency governor: %s\n", governor);
    }
    if (lockdown[0] && !strstr(lockdown, "[none]")) {
        fprintf(stderr, "kernel lockdown: %s (I/O ports are not accessible)\n", lockdown);
    }
    host_realtime_advice();
}

/* ---- CPU ---------------------------------------------------------------- */

/* Is n in a list like "1,4-6"? */
static bool in_list(const char *list, int n)
{
    for (const char *p = list; *p; p += *p == ',') {
        char *end;
        long first = strtol(p, &end, 10), last = *end == '-' ? strtol(end + 1, &end, 10) : first;
        if (end == p) {
            return false;
        }
        if (n >= first && n <= last) {
            return true;
        }
        p = end;
    }
    return false;
}

/* Highest number in a list like "1,4-6"; -1 for an empty one. */
static int highest_cpu(const char *list)
{
    int best = -1;
    for (const char *p = list; *p;) {
        if (*p >= '0' && *p <= '9') {
            char *end;
            long n = strtol(p, &end, 10);
            best = n > best ? (int)n : best;
            p = end;
        } else {
            p++;
        }
    }
    return best;
}

int host_cpu(void)
{
    char list[256];
    if (sysconf(_SC_NPROCESSORS_ONLN) <= 1) {
        return -1;
    }
    const char *env = getenv("RTAPI_CPU_NUMBER");
    if (env && *env) {
        char *end;
        long n = strtol(env, &end, 10);
        if (*end || n < -1 || n >= sysconf(_SC_NPROCESSORS_CONF)) {
            rtapi_print_msg(RTAPI_MSG_ERR, "RTAPI_CPU_NUMBER=%s is not a CPU of this machine (0 to %ld, -1 for any)\n",
                            env, sysconf(_SC_NPROCESSORS_CONF) - 1);
            return -1;
        }
        return (int)n;
    }
    read_cpu_file("isolated", list, sizeof list);
    int cpu = highest_cpu(list);
    if (cpu < 0) {
        rtapi_print_msg(RTAPI_MSG_ERR,
                        "No isolated CPU's found, expect some latency or set RTAPI_CPU_NUMBER to select CPU\n");
    }
    return cpu;
}

void host_realtime_advice(void)
{
    char isolated[256], governor[64], name[64];
    const char *env = getenv("RTAPI_CPU_NUMBER");
    long cpus = sysconf(_SC_NPROCESSORS_ONLN);
    read_cpu_file("isolated", isolated, sizeof isolated);
    int cpu = env && *env ? atoi(env) : highest_cpu(isolated);
    for (int n = 0; n < cpus; n++) {
        if (cpu >= 0 && n != cpu) {
            continue;
        }
        snprintf(name, sizeof name, "cpu%d/cpufreq/scaling_governor", n);
        read_cpu_file(name, governor, sizeof governor);
        if (governor[0] && strcmp(governor, "performance") != 0) {
            fprintf(stderr,
                    "Note: CPU %d changes its speed under way (frequency governor '%s'), which makes realtime late\n"
                    "  Fix: sudo cpupower frequency-set -g performance (Debian: package linux-cpupower), at every start\n",
                    n, governor);
            break;
        }
    }
    if (cpus > 1 && !in_list(isolated, cpu)) {
        char which[32] = "no CPU is";
        if (cpu >= 0) {
            snprintf(which, sizeof which, "CPU %d is not", cpu);
        }
        fprintf(stderr,
                "Note: %s kept free of other work for realtime\n"
                "  Fix: add isolcpus=%d to the kernel's command line: GRUB_CMDLINE_LINUX in /etc/default/grub, then\n"
                "  Fix: sudo update-grub; on a Raspberry Pi in cmdline.txt of the boot partition\n",
                which, cpu >= 0 ? cpu : (int)cpus - 1);
    }
}

/* ---- Memory, limits, latency -------------------------------------------- */

static int io_errno = ENOSYS;

int host_io_errno(void)
{
    return io_errno;
}

static void limit_unlimited(int which)
{
    struct rlimit infinite = {RLIM_INFINITY, RLIM_INFINITY};
    setrlimit(which, &infinite);
}

static void heap_prefault(void)
{
    mallopt(M_TRIM_THRESHOLD, -1);
    mallopt(M_MMAP_MAX, 0);
    volatile char *heap = malloc(HEAP_PREFAULT);
    if (heap) {
        for (size_t i = 0; i < HEAP_PREFAULT; i += 4096) {
            heap[i] = 0;
        }
        free((void *)heap);
    }
}

void host_io_setup(void)
{
#if defined(__x86_64__) || defined(__i386__)
    host_root_begin();
    io_errno = iopl(3) == 0 ? 0 : errno; /* inherited by threads; told when a driver asks */
    host_root_end();
#endif
}

void host_realtime_setup(void)
{
    struct rlimit memlock;
    host_root_begin();
    limit_unlimited(RLIMIT_RTPRIO);
    limit_unlimited(RLIMIT_CORE);
    prctl(PR_SET_DUMPABLE, 1);
    if (getrlimit(RLIMIT_MEMLOCK, &memlock) == 0) {
        memlock.rlim_cur = memlock.rlim_max;
        setrlimit(RLIMIT_MEMLOCK, &memlock);
    }
    if (mlockall(MCL_CURRENT | MCL_FUTURE) < 0) {
        rtapi_print_msg(RTAPI_MSG_WARN, "mlockall failed: %s. Realtime latency may suffer.\n", strerror(errno));
    } else {
        rtapi_shmem_policy.lock = true;
    }
    heap_prefault();
    int fd = open("/dev/cpu_dma_latency", O_WRONLY | O_CLOEXEC);
    int32_t zero_us = 0;
    if (fd >= 0 && write(fd, &zero_us, sizeof zero_us) != sizeof zero_us) {
        close(fd); /* while open the CPU stays out of deep sleep */
    }
    host_root_end();
}

/* ---- Signals ------------------------------------------------------------ */

static int signal_pipe[2] = {-1, -1};
static volatile sig_atomic_t signal_seen;

static void say(const char *a, const char *b, const char *c)
{
    ssize_t n = write(2, a, strlen(a));
    n += write(2, b, strlen(b));
    n += write(2, c, strlen(c));
    (void)n;
}

static const char *signal_name(int sig)
{
    return sig == SIGSEGV ? "SIGSEGV" : sig == SIGILL ? "SIGILL" : sig == SIGFPE ? "SIGFPE"
         : sig == SIGBUS ? "SIGBUS" : sig == SIGXCPU ? "SIGXCPU" : sig == SIGTERM ? "SIGTERM" : "SIGINT";
}

static void on_fatal(int sig)
{
    signal(sig, SIG_DFL);
    say("rtapi_app: ", signal_name(sig), " - aborting\n");
    if (sig == SIGSEGV && io_errno != 0) {
        say("rtapi_app: (this process has no I/O port privilege: it is not root, CAP_SYS_RAWIO is "
            "missing, or secure boot is on)\n",
            "", "");
    }
    abort();
}

static void on_end(int sig)
{
    if (signal_seen) {
        _exit(128 + sig); /* asked twice: the orderly way is stuck */
    }
    signal_seen = sig;
    say("rtapi_app: ", signal_name(sig), " - shutting down\n");
    ssize_t n = write(signal_pipe[1], "", 1);
    (void)n;
}

int host_signals_init(bool realtime)
{
    struct sigaction end = {.sa_handler = on_end}, fatal = {.sa_handler = on_fatal};
    if (pipe2(signal_pipe, O_CLOEXEC | O_NONBLOCK) < 0) {
        return -errno;
    }
    sigaction(SIGTERM, &end, NULL);
    sigaction(SIGINT, &end, NULL);
    signal(SIGPIPE, SIG_IGN);
    if (realtime) {
        signal(SIGTSTP, SIG_IGN);
        const int fatals[] = {SIGSEGV, SIGILL, SIGFPE, SIGBUS, SIGXCPU};
        for (size_t i = 0; i < sizeof fatals / sizeof *fatals; i++) {
            sigaction(fatals[i], &fatal, NULL);
        }
    }
    return signal_pipe[0];
}

int host_signal_received(void)
{
    return signal_seen;
}
