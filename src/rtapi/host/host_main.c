/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * host_main.c - rtapi_app: client and daemon in one program.
 *
 * In:     one command on the command line
 * Out:    exit status; the daemon keeps running modules
 * Thread: the command thread; realtime tasks are in host_task.c
 * Method: an abstract socket is the lock: who binds it becomes the daemon (in a
 *         forked child), everybody else is a client. One request per connection,
 *         served one after the other.
 *         Request: u16 size of all, u16 number of words, then u16 length + bytes
 *         for each. Reply: u16 size of all, i32 result, u16 length + text.
 */
#include "host.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/auxv.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>
#include "kerf_clock.h"
#include "kerf_instance.h"

#define MESSAGE_MAX 65535
#define CONNECT_LIMIT_MS 3000
#define EXIT_LIMIT_MS 5000
#define PING_LIMIT_S 5
#define PATH_LIMIT (sizeof((struct sockaddr_un *)0)->sun_path - 2)

/* ---- Socket ------------------------------------------------------------- */

static struct sockaddr_un address = {.sun_family = AF_UNIX};

static void address_init(void)
{
    char base[PATH_MAX], path[PATH_MAX];
    const char *env = getenv("RTAPI_FIFO_PATH"), *home = getenv("HOME");
    if (env) {
        snprintf(base, sizeof base, "%s", env);
    } else if (home) {
        snprintf(base, sizeof base, "%s/.rtapi_fifo", home);
    } else {
        fprintf(stderr, "rtapi_app: RTAPI_FIFO_PATH and HOME are unset.  rtapi fifo creation is unsafe.\n");
        exit(1);
    }
    int n = kerf_instance_path(path, sizeof path, base);
    if (n < 0 || (size_t)n > PATH_LIMIT) {
        fprintf(stderr, "rtapi_app: rtapi fifo path is too long (arch limit %zd): %s\n", (ssize_t)PATH_LIMIT, path);
        exit(1);
    }
    memcpy(address.sun_path + 1, path, (size_t)n);
}

static int new_socket(void)
{
    int fd = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (fd < 0) {
        fprintf(stderr, "rtapi_app: socket: %s\n", strerror(errno));
        exit(1);
    }
    return fd;
}

/* A listening socket, or -1 when there is a daemon. */
static int become_master(void)
{
    int fd = new_socket();
    if (bind(fd, (struct sockaddr *)&address, sizeof address) == 0 && listen(fd, 10) == 0) {
        return fd;
    }
    if (errno != EADDRINUSE) {
        fprintf(stderr, "bind %s: %s\n", address.sun_path + 1, strerror(errno));
        exit(1);
    }
    close(fd);
    return -1;
}

/* A connection, or -1 when nobody listens. */
static int try_connect(void)
{
    int fd = new_socket();
    if (connect(fd, (struct sockaddr *)&address, sizeof address) == 0) {
        return fd;
    }
    int err = errno;
    close(fd);
    if (err != ECONNREFUSED && err != EAGAIN) {
        fprintf(stderr, "connect %s: %s\n", address.sun_path + 1, strerror(err));
        exit(1);
    }
    return -1;
}

static bool send_all(int fd, const void *data, size_t size)
{
    for (const char *p = data; size > 0;) {
        ssize_t n = send(fd, p, size, MSG_NOSIGNAL);
        if (n < 0 && errno == EINTR) {
            continue;
        }
        if (n <= 0) {
            return false;
        }
        p += n;
        size -= (size_t)n;
    }
    return true;
}

/* Bytes received: less than size at the end of the connection or a time-out. */
static size_t recv_all(int fd, void *data, size_t size)
{
    size_t got = 0;
    while (got < size) {
        ssize_t n = recv(fd, (char *)data + got, size - got, 0);
        if (n < 0 && errno == EINTR) {
            continue;
        }
        if (n <= 0) {
            break;
        }
        got += (size_t)n;
    }
    return got;
}

static void put16(unsigned char *p, size_t v)
{
    p[0] = (unsigned char)v;
    p[1] = (unsigned char)(v >> 8);
}

static size_t get16(const unsigned char *p)
{
    return p[0] | (size_t)p[1] << 8;
}

/* Is there a process that is no zombie? */
static bool process_runs(pid_t pid)
{
    char path[32], text[512];
    snprintf(path, sizeof path, "/proc/%d/stat", (int)pid);
    FILE *f = fopen(path, "re");
    if (!f) {
        return false;
    }
    char *p = fgets(text, sizeof text, f) ? strrchr(text, ')') : NULL;
    fclose(f);
    return p && p[2] != 'Z' && p[2] != 'X';
}

/* ---- Client ------------------------------------------------------------- */

static bool send_words(int fd, int argc, char **argv)
{
    size_t size = 4;
    for (int i = 0; i < argc; i++) {
        size += 2 + strlen(argv[i]);
    }
    if (size > MESSAGE_MAX) {
        fprintf(stderr, "rtapi_app: send_args: args too big, size = %li!\n", (long)size);
        return false;
    }
    unsigned char *message = malloc(size), *p = message + 4;
    if (!message) {
        return false;
    }
    put16(message, size);
    put16(message + 2, (size_t)argc);
    for (int i = 0; i < argc; i++) {
        size_t len = strlen(argv[i]);
        put16(p, len);
        memcpy(p + 2, argv[i], len);
        p += 2 + len;
    }
    bool ok = send_all(fd, message, size);
    free(message);
    return ok;
}

static bool recv_reply(int fd, int32_t *result)
{
    unsigned char head[2], body[MESSAGE_MAX];
    size_t got = recv_all(fd, head, 2);
    if (got < 2) {
        fprintf(stderr, "rtapi_app: recv_result 1 failed, recv only %zu of 2 bytes\n", got);
        return false;
    }
    size_t size = get16(head);
    size = size >= 8 ? size - 2 : 6;
    got = recv_all(fd, body, size);
    if (got < size || get16(body + 4) > size - 6) {
        fprintf(stderr, "rtapi_app: recv_result 2 failed, recv only %zu of %zu bytes\n", got, size);
        return false;
    }
    memcpy(result, body, 4);
    size_t text = get16(body + 4);
    if (text > 0) {
        printf("%.*s\n", (int)text, body + 6);
    }
    return true;
}

/* Waits until the daemon is gone, so that what it used is free. The kernel closes
 * the connection after it detached the memory; the process id goes soon after. */
static void wait_for_end(int fd)
{
    char byte;
    struct ucred peer = {0};
    socklen_t size = sizeof peer;
    getsockopt(fd, SOL_SOCKET, SO_PEERCRED, &peer, &size);
    while (recv(fd, &byte, 1, 0) > 0) {
    }
    for (int i = 0; peer.pid > 0 && i < EXIT_LIMIT_MS && process_runs(peer.pid); i++) {
        struct timespec pause = {0, 1000000};
        nanosleep(&pause, NULL);
    }
    if (peer.pid > 0 && process_runs(peer.pid)) {
        fprintf(stderr, "ERROR: rtapi_app failed to die\n");
    }
}

#define NO_ANSWER 2  /* status: the daemon is there but does not answer within the limit */
#define NO_DAEMON -1 /* it ended before it answered (only told for `start`) */

/* limit_s: how long to wait for the answer, 0 = as long as it takes. */
static int client(int fd, int argc, char **argv, int limit_s, bool start)
{
    int32_t result;
    struct timeval limit = {limit_s, 0};
    setsockopt(fd, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
    if (!send_words(fd, argc, argv)) {
        close(fd);
        if (start) {
            return NO_DAEMON;
        }
        fprintf(stderr, "rtapi_app: failed to write to master\n");
        return 255;
    }
    struct pollfd answer = {fd, POLLIN, 0};
    if (limit_s > 0 && poll(&answer, 1, limit_s * 1000) == 0) {
        return NO_ANSWER;
    }
    char byte;
    if (start && recv(fd, &byte, 1, MSG_PEEK) <= 0) {
        close(fd);
        return NO_DAEMON;
    }
    if (!recv_reply(fd, &result)) {
        fprintf(stderr, "rtapi_app: failed to read from master\n");
        return 255;
    }
    if (argc == 1 && strcmp(argv[0], "exit") == 0) {
        wait_for_end(fd);
    }
    close(fd);
    return result & 0xff;
}

/* ---- Daemon ------------------------------------------------------------- */

static int set_debug(const char *text)
{
    char *end;
    long level = strtol(text, &end, 10);
    if (end == text) {
        rtapi_print_msg(RTAPI_MSG_ERR, "Debug level is not a number\n");
        return -EINVAL;
    }
    if (level < 0 || level > 5) {
        rtapi_print_msg(RTAPI_MSG_ERR, "Debug level must be >=0 and <= 5\n");
        return -EINVAL;
    }
    return rtapi_set_msg_level((int)level);
}

/* The shared memory that only HAL and RTAPI themselves use must not outlive the
 * daemon unless others are attached. */
static void shut_down(void)
{
    host_unload_all();
    host_tasks_end();
    host_messages_flush();
    fflush(NULL);
}

static int command(int argc, char **argv, bool *end)
{
    const char *name = argc > 0 ? argv[0] : "";
    if (argc == 0) {
        return 0;
    }
    if (argc == 1 && strcmp(name, "start") == 0) {
        fprintf(stderr, "rtapi_app: start received while running\n");
        return 0;
    }
    if (argc == 1 && strcmp(name, "ping") == 0) {
        return 0;
    }
    if (argc == 1 && strcmp(name, "exit") == 0) {
        shut_down();
        *end = true;
        return 0;
    }
    if (argc >= 2 && strcmp(name, "load") == 0) {
        return host_load(argc - 1, argv + 1);
    }
    if (argc == 2 && strcmp(name, "unload") == 0) {
        return host_unload(argv[1]);
    }
    if ((argc == 3 || argc == 4) && strcmp(name, "newinst") == 0) {
        return host_newinst(argv[1], argv[2], argc == 4 ? argv[3] : "");
    }
    if (argc == 2 && strcmp(name, "debug") == 0) {
        return set_debug(argv[1]);
    }
    fprintf(stderr, "rtapi_app: unrecognized command starting with %s\n", name);
    return -1;
}

/* Divides a request into words (NULL-terminated array; words point into text,
 * which is one allocation). false: malformed. */
static bool parse_request(const unsigned char *body, size_t size, int *argc, char ***argv)
{
    size_t count = get16(body), pos = 2;
    char **words = calloc(count + 1, sizeof *words);
    char *text = malloc(size + count + 1);
    *argv = words;
    if (!words || !text) {
        free(text);
        return false;
    }
    words[0] = text; /* so that the caller can free it also for no words */
    for (size_t i = 0; i < count; i++) {
        size_t len = pos + 2 <= size ? get16(body + pos) : size;
        if (pos + 2 + len > size) {
            return false;
        }
        words[i] = text;
        memcpy(text, body + pos + 2, len);
        text[len] = 0;
        text += len + 1;
        pos += 2 + len;
    }
    *argc = (int)count;
    return pos == size;
}

/* Serves one connection. true: go on. */
static bool serve(int fd)
{
    unsigned char head[2], body[MESSAGE_MAX], reply[8];
    struct timeval limit = {10, 0};
    int argc = 0;
    char **argv = NULL;
    bool end = false;
    setsockopt(fd, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
    size_t size = recv_all(fd, head, 2) == 2 ? get16(head) : 0;
    if (size < 4 || recv_all(fd, body, size - 2) != size - 2 || !parse_request(body, size - 2, &argc, &argv)) {
        fprintf(stderr, "rtapi_app: failed to read from slave\n");
    } else {
        int32_t result = command(argc, argv, &end);
        put16(reply, sizeof reply);
        memcpy(reply + 2, &result, 4);
        put16(reply + 6, 0);
        fflush(stdout);
        send_all(fd, reply, sizeof reply);
    }
    if (argv) {
        free(argv[0]);
        free(argv);
    }
    if (!end) {
        close(fd); /* at the end the kernel closes it last: see wait_for_end() */
    }
    return !end;
}

/* Segments of this instance that killed processes left, also those that an older
 * registry does not name. */
static int remove_stale(void)
{
    static const int keys[] = {0x48414c32 /* HAL */, (int)0x90280a48 /* RTAPI */};
    return rtapi_shmem_remove_stale(keys, sizeof keys / sizeof *keys);
}

static void print_banner(const struct rtapi_backend_ops *backend)
{
    rtapi_print_msg(RTAPI_MSG_ERR, "Note: Using %s\n", backend->banner);
    rtapi_realtime_type_t type = kerf_clock_is_virtual() ? REALTIME_TYPE_NONE : host_realtime_type();
    if (type == REALTIME_TYPE_UNKNOWN || type == REALTIME_TYPE_PREEMPT_DYNAMIC) {
        rtapi_print_msg(RTAPI_MSG_ERR,
                        "Note: SCHED_FIFO available but kernel is not PREEMPT_RT.  Latency may be unbounded; "
                        "install a PREEMPT_RT kernel for hard realtime guarantees.\n");
    }
}

static void daemon_main(int listener)
{
    char hal_lib[] = "hal_lib", *load[] = {hal_lib, NULL};
    setsid();
    listen(listener, 10); /* again: clients see the process that listened last as their peer */
    unsetenv(KERF_CLOCK_SLOT_ENV); /* that place belongs to whoever started us */
    host_messages_init();
    const struct rtapi_backend_ops *backend = host_backend_choose();
    bool realtime = backend->warn_late;
    int signals = host_signals_init(realtime);
    host_io_setup();
    if (realtime) {
        host_realtime_setup();
        host_realtime_advice();
    }
    host_messages_start();
    int removed = remove_stale();
    if (removed > 0) {
        rtapi_print_msg(RTAPI_MSG_ERR,
                        "Note: removed %d shared memory segments of processes that were killed\n",
                        removed);
    }
    host_load(1, load);
    print_banner(backend);
    struct pollfd fds[2] = {{listener, POLLIN, 0}, {signals, POLLIN, 0}};
    for (bool going = true; going;) {
        if (poll(fds, 2, -1) < 0 && errno != EINTR) {
            break;
        }
        if (host_signal_received()) {
            shut_down();
            exit(128 + host_signal_received());
        }
        if (fds[0].revents) {
            int fd = accept4(listener, NULL, NULL, SOCK_CLOEXEC);
            going = fd < 0 || serve(fd);
        }
    }
    exit(0);
}

static void start_daemon(int listener)
{
    fflush(NULL);
    pid_t pid = fork();
    if (pid < 0) {
        fprintf(stderr, "rtapi_app: fork: %s\n", strerror(errno));
        exit(1);
    }
    if (pid == 0) {
        daemon_main(listener);
    }
    close(listener);
}

/* ---- Start -------------------------------------------------------------- */

/* A link to the setuid file elsewhere would make another folder's modules ours. */
static void refuse_links(void)
{
    struct stat self;
    if (getauxval(AT_SECURE) && (stat("/proc/self/exe", &self) != 0 || self.st_nlink != 1)) {
        fprintf(stderr, "rtapi_app: has special rights and more than one name: refusing to run\n");
        exit(1);
    }
}

static int check_rt(void)
{
    rtapi_realtime_type_t type = host_realtime_type();
    host_realtime_report();
    printf("%s\n", host_realtime_name(type));
    return type > REALTIME_TYPE_NONE ? 0 : 1;
}

/* For `realtime stop`: ends the daemon if there is one, then removes what earlier
 * ones may have left. Only this instance's keys, only segments nobody uses. */
static int stop_and_clean(void)
{
    char word[] = "exit", *words[] = {word};
    int fd = try_connect();
    if (fd >= 0) {
        struct ucred peer = {0};
        socklen_t size = sizeof peer;
        getsockopt(fd, SOL_SOCKET, SO_PEERCRED, &peer, &size);
        if (client(fd, 1, words, EXIT_LIMIT_MS / 1000, false) == NO_ANSWER) {
            fprintf(stderr, "ERROR: rtapi_app failed to die: killing process %d\n", (int)peer.pid);
            kill(peer.pid, SIGKILL);
            wait_for_end(fd);
        }
    } else {
        fprintf(stderr, "rtapi_app: exit received while not running\n");
    }
    remove_stale();
    return 0;
}

static int64_t wall_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return t.tv_sec * 1000LL + t.tv_nsec / 1000000;
}

/* One command as a client, after becoming the parent of a daemon if there is none.
 * Exit status or NO_DAEMON. */
static int run(int words, char **word)
{
    bool start = words == 1 && strcmp(word[0], "start") == 0;
    int fd = try_connect();
    if (fd < 0 && words == 1 && strcmp(word[0], "ping") == 0) {
        return 1;
    }
    if (fd < 0 && words == 1 && strcmp(word[0], "exit") == 0) {
        fprintf(stderr, "rtapi_app: exit received while not running\n");
        return 0;
    }
    /* Between the end of one daemon and the start of the next nobody listens. */
    int64_t end_ms = wall_ms() + CONNECT_LIMIT_MS;
    while (fd < 0) {
        int listener = become_master();
        if (listener >= 0) {
            int status = host_privileges_init();
            if (status != 0) {
                return status;
            }
            if (!start) {
                fprintf(stderr,
                        "WARNING: Deprecated: No active realtime environment found. Use \"realtime start\" to start "
                        "one.\n"
                        "  A realtime environment is started automatically.\n"
                        "  If this appears while using halcmd: Use halrun instead.\n"
                        "  halcmd should only be used with an already running realtime environment.\n"
                        "  halrun creates a realtime environment and tears it down at exit.\n");
            }
            start_daemon(listener);
            if (start) {
                static char ping[] = "ping";
                static char *as_ping[] = {ping, NULL};
                word = as_ping;
            }
        }
        fd = try_connect();
        if (fd < 0) {
            if (wall_ms() > end_ms) {
                fprintf(stderr, "Waited 3 seconds for master.  giving up.\n");
                return 1;
            }
            struct timespec pause = {0, 100000 + (wall_ms() * 7919 + getpid()) % 2000000};
            nanosleep(&pause, NULL);
        }
    }
    bool ping = words == 1 && strcmp(word[0], "ping") == 0;
    return client(fd, words, word, ping && !start ? PING_LIMIT_S : 0, start);
}

int main(int argc, char **argv)
{
    refuse_links();
    if (argc == 2 && strcmp(argv[1], "check_rt") == 0) {
        return check_rt();
    }
    address_init();
    if (argc == 2 && strcmp(argv[1], "stop-and-clean") == 0) {
        return stop_and_clean();
    }
    /* A daemon that is just being killed may still take the connection of `start`. */
    for (int tries = 0;; tries++) {
        int status = run(argc - 1, argv + 1);
        if (status != NO_DAEMON || tries >= 100) {
            return status & 0xff;
        }
    }
}
