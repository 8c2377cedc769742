/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * failing_writes.c - preloaded into a test: calls that change files below a folder are counted,
 * and the one with a given number does not succeed. failing_writes(FOLDER, NUMBER, ERROR) is
 * called by the test: NUMBER from 1, 0 never; ERROR an errno, or 0: the process dies there, a
 * write with half of its bytes. It returns how many calls there were since the last time.
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static char folder[PATH_MAX];
static int wanted, error, count;

int failing_writes(const char *below, int number, int with)
{
    const int before = count;
    snprintf(folder, sizeof folder, "%s", below);
    wanted = number;
    error = with;
    count = 0;
    return before;
}

/* A program of its own has them as FAILING_WRITES=FOLDER:NUMBER:ERROR. */
__attribute__((constructor)) static void from_environment(void)
{
    char below[PATH_MAX];
    int number, with;
    const char *text = getenv("FAILING_WRITES");
    if (text && sscanf(text, "%[^:]:%d:%d", below, &number, &with) == 3) failing_writes(below, number, with);
}

static int below(const char *path) { return folder[0] && path && strncmp(path, folder, strlen(folder)) == 0; }

static int fd_below(int fd)
{
    char link[40], path[PATH_MAX];
    snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
    const ssize_t n = readlink(link, path, sizeof path - 1);
    if (n <= 0) return 0;
    path[n] = 0;
    return below(path);
}

/* True: this call fails. It may not come back. */
static int fails(void)
{
    if (++count != wanted) return 0;
    if (!error) raise(SIGKILL);
    errno = error;
    return 1;
}

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

static int opens(const char *path, int flags) { return (flags & (O_WRONLY | O_RDWR | O_CREAT)) && below(path) && fails(); }

#define OPEN(name)                                             \
    int name(const char *path, int flags, ...)                 \
    {                                                          \
        va_list rest;                                          \
        va_start(rest, flags);                                 \
        const mode_t mode = (flags & O_CREAT) ? va_arg(rest, mode_t) : 0; \
        va_end(rest);                                          \
        return opens(path, flags) ? -1 : REAL(name)(path, flags, mode); \
    }
OPEN(open)
OPEN(open64)

#define OPENAT(name)                                           \
    int name(int dir, const char *path, int flags, ...)        \
    {                                                          \
        va_list rest;                                          \
        va_start(rest, flags);                                 \
        const mode_t mode = (flags & O_CREAT) ? va_arg(rest, mode_t) : 0; \
        va_end(rest);                                          \
        return opens(path, flags) ? -1 : REAL(name)(dir, path, flags, mode); \
    }
OPENAT(openat)
OPENAT(openat64)

#define FOPEN(name)                                            \
    FILE *name(const char *path, const char *mode)             \
    {                                                          \
        return !strchr("wa", mode[0]) || !opens(path, O_WRONLY) ? REAL(name)(path, mode) : NULL; \
    }
FOPEN(fopen)
FOPEN(fopen64)

ssize_t write(int fd, const void *from, size_t n)
{
    if (!fd_below(fd)) return REAL(write)(fd, from, n);
    if (count + 1 == wanted && !error) (void)!REAL(write)(fd, from, n / 2);
    return fails() ? -1 : REAL(write)(fd, from, n);
}

int fsync(int fd) { return fd_below(fd) && fails() ? -1 : REAL(fsync)(fd); }
int fdatasync(int fd) { return fd_below(fd) && fails() ? -1 : REAL(fdatasync)(fd); }
int ftruncate(int fd, off_t n) { return fd_below(fd) && fails() ? -1 : REAL(ftruncate)(fd, n); }
int fchmod(int fd, mode_t mode) { return fd_below(fd) && fails() ? -1 : REAL(fchmod)(fd, mode); }
int unlink(const char *path) { return below(path) && fails() ? -1 : REAL(unlink)(path); }
int rename(const char *from, const char *to) { return below(to) && fails() ? -1 : REAL(rename)(from, to); }
int link(const char *from, const char *to) { return below(to) && fails() ? -1 : REAL(link)(from, to); }
int renameat(int a, const char *from, int b, const char *to)
{
    return below(to) && fails() ? -1 : REAL(renameat)(a, from, b, to);
}
