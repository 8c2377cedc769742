/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * kerf_instance.c - shared names of this instance.
 *
 * In:     KERF_INSTANCE of the environment
 * Out:    keys, paths, a lock that dies with its holder
 * Thread: [init] the first call; afterwards [any] except the lock
 */
#include "kerf_instance.h"

#include <errno.h>
#include <pthread.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <time.h>
#include <unistd.h>

static char instance_name[KERF_INSTANCE_LEN + 1];
static pthread_once_t instance_once = PTHREAD_ONCE_INIT;

/* FNV-1a, 64 bit: a public-domain hash with good spread on short texts. */
static uint64_t hash_bytes(uint64_t hash, const void *data, size_t len)
{
    const unsigned char *p = data;
    while (len--) {
        hash = (hash ^ *p++) * 0x100000001b3ULL;
    }
    return hash;
}
#define HASH_START 0xcbf29ce484222325ULL

static void instance_read(void)
{
    const char *env = getenv("KERF_INSTANCE");
    if (!env) {
        return;
    }
    size_t len = strlen(env);
    snprintf(instance_name, sizeof instance_name, "%s", env);
    for (char *p = instance_name; *p; p++) {
        int plain = (*p >= 'a' && *p <= 'z') || (*p >= 'A' && *p <= 'Z') || (*p >= '0' && *p <= '9');
        if (!plain && !strchr("_-.", *p)) {
            *p = '_';
        }
    }
    if (len > KERF_INSTANCE_LEN) {
        char tail[18];
        snprintf(tail, sizeof tail, "-%016llx", (unsigned long long)hash_bytes(HASH_START, env, len));
        memcpy(instance_name + KERF_INSTANCE_LEN - 17, tail, 18);
    }
}

const char *kerf_instance(void)
{
    pthread_once(&instance_once, instance_read);
    return instance_name;
}

int kerf_instance_key(int key)
{
    const char *name = kerf_instance();
    if (!*name || key == 0) {
        return key;
    }
    int32_t k = key;
    uint64_t hash = hash_bytes(hash_bytes(HASH_START, &k, sizeof k), name, strlen(name));
    hash ^= hash >> 32;
    int result = (int)(hash & 0x7fffffff);
    return result ? result : 1;
}

int kerf_instance_path(char *buf, size_t size, const char *base)
{
    const char *name = kerf_instance();
    int n = snprintf(buf, size, *name ? "%s.%s" : "%s", base, name);
    return n >= 0 && (size_t)n < size ? n : -ENAMETOOLONG;
}

int kerf_instance_lock(const char *what)
{
    struct sockaddr_un addr = {.sun_family = AF_UNIX};
    int n = snprintf(addr.sun_path + 1, sizeof addr.sun_path - 1, "kerf-lock/%s/%s", what, kerf_instance());
    if (n < 0 || (size_t)n >= sizeof addr.sun_path - 1) {
        return -ENAMETOOLONG;
    }
    socklen_t len = (socklen_t)(offsetof(struct sockaddr_un, sun_path) + 1 + (size_t)n);
    int fd = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    if (fd < 0) {
        return -errno;
    }
    /* The holder needs microseconds. 10 s: it is stopped or the machine is stuck. */
    struct timespec pause = {0, 50000};
    for (int tries = 0; tries < 200000; tries++) {
        if (bind(fd, (struct sockaddr *)&addr, len) == 0) {
            return fd;
        }
        if (errno != EADDRINUSE) {
            break;
        }
        nanosleep(&pause, NULL);
    }
    int err = errno;
    close(fd);
    return -err;
}

void kerf_instance_unlock(int handle)
{
    if (handle >= 0) {
        close(handle);
    }
}
