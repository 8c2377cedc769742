/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * toolstore.cc - the tool records in a memory map that processes share.
 *
 * Thread: [task]; the lock in the header is waited for at most 10 s, then taken over; from a dead process at once
 * Source: tools sheet, section 3
 */
#include "tooldata.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <string>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace
{

struct Map {
    unsigned long mutex;
    unsigned last_index;
    int is_random_toolchanger;
    CANON_TOOL_TABLE tools[CANON_POCKETS_MAX];
};

struct Store {
    Map *map = nullptr;
    bool creator = false;
    std::string name;
    CANON_TOOL_TABLE *toolcurrent = nullptr;
} store;

std::string map_name()
{
    if (!store.name.empty()) return store.name;
    const char *home = secure_getenv("HOME");
    std::string path = home ? std::string(home) : std::string("/tmp");
    path += "/.tool.mmap";
    const char *instance = getenv("KERF_INSTANCE");
    if (instance && *instance) path += std::string(".") + instance;
    return path;
}

bool gone(unsigned long owner)
{
    return owner > 1 && kill(pid_t(owner), 0) != 0 && errno == ESRCH;
}

// The mutex holds the process id of its owner. One that died gives it up at once.
bool lock()
{
    const unsigned long me = static_cast<unsigned long>(getpid());
    for (int tries = 0; tries < 10000; ++tries) {
        unsigned long owner = 0;
        if (__atomic_compare_exchange_n(&store.map->mutex, &owner, me, false, __ATOMIC_ACQUIRE, __ATOMIC_RELAXED))
            return true;
        if (gone(owner) &&
            __atomic_compare_exchange_n(&store.map->mutex, &owner, me, false, __ATOMIC_ACQUIRE, __ATOMIC_RELAXED))
            return true;
        const struct timespec pause = {0, 1000000}; // wall clock: another process holds the lock
        nanosleep(&pause, nullptr);
    }
    fprintf(stderr, "tool data: a process held the lock for 10 s; it is taken over\n");
    __atomic_store_n(&store.map->mutex, 0ul, __ATOMIC_RELEASE);
    return false;
}

void unlock() { __atomic_store_n(&store.map->mutex, 0ul, __ATOMIC_RELEASE); }

int attach(int fd)
{
    void *p = mmap(nullptr, sizeof(Map), PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
    ::close(fd);
    if (p == MAP_FAILED) {
        perror("tool data: mmap");
        return -1;
    }
    store.map = static_cast<Map *>(p);
    return 0;
}

} // namespace

CANON_TOOL_TABLE tooldata_entry_init(void)
{
    CANON_TOOL_TABLE t;
    memset(&t, 0, sizeof t);
    t.toolno = t.pocketno = -1;
    return t;
}

void tool_mmap_set_fname(const char *path) { store.name = path; }

int tool_mmap_creator(CANON_TOOL_TABLE *toolcurrent, int random_toolchanger)
{
    if (store.map) tool_mmap_close();
    const std::string path = map_name();
    int fd = open(path.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0600);
    if (fd < 0) {
        fprintf(stderr, "tool_mmap_creator(): %s: %s\n", path.c_str(), strerror(errno));
        return -1;
    }
    if (ftruncate(fd, sizeof(Map)) != 0) {
        fprintf(stderr, "tool_mmap_creator(): %s: %s\n", path.c_str(), strerror(errno));
        ::close(fd);
        return -1;
    }
    if (attach(fd) != 0) return -1;
    store.creator = true;
    store.toolcurrent = toolcurrent;
    tooldata_init(random_toolchanger);
    return 0;
}

int tool_mmap_user(void)
{
    if (store.map) return 0;
    const std::string path = map_name();
    int fd = open(path.c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC);
    if (fd < 0) return -1;
    struct stat st;
    if (fstat(fd, &st) != 0 || size_t(st.st_size) < sizeof(Map)) {
        ::close(fd);
        return -1;
    }
    return attach(fd);
}

void tool_mmap_close(void)
{
    if (!store.map) return;
    munmap(store.map, sizeof(Map));
    store.map = nullptr;
    if (store.creator) unlink(map_name().c_str());
    store.creator = false;
    store.toolcurrent = nullptr;
}

int tool_mmap_is_attached(void) { return store.map != nullptr; }
int tool_mmap_is_random_toolchanger(void) { return store.map ? store.map->is_random_toolchanger : 0; }

void tooldata_init(int random_toolchanger)
{
    if (!store.map) return;
    store.map->is_random_toolchanger = random_toolchanger;
    tooldata_reset();
}

void tooldata_reset(void)
{
    if (!store.map) return;
    lock();
    for (auto &t : store.map->tools) t = tooldata_entry_init();
    store.map->last_index = 0;
    unlock();
}

int tooldata_last_index_get(void) { return store.map ? int(store.map->last_index) : 0; }

void tooldata_last_index_set(int idx)
{
    if (store.map && idx >= 0 && idx < CANON_POCKETS_MAX) store.map->last_index = unsigned(idx);
}

toolidx_t tooldata_put(CANON_TOOL_TABLE rec, int idx)
{
    if (!store.map || idx < 0 || idx >= CANON_POCKETS_MAX) return IDX_FAIL;
    if (!lock()) return IDX_FAIL;
    toolidx_t result = IDX_OK;
    if (unsigned(idx) > store.map->last_index) {
        store.map->last_index = unsigned(idx);
        result = IDX_NEW;
    }
    store.map->tools[idx] = rec;
    unlock();
    if (idx == 0 && store.toolcurrent) *store.toolcurrent = rec;
    return result;
}

toolidx_t tooldata_get(CANON_TOOL_TABLE *rec, int idx)
{
    if (!store.map || idx < 0 || idx >= CANON_POCKETS_MAX) return IDX_FAIL;
    const bool locked = lock();
    *rec = store.map->tools[idx];
    if (locked) unlock();
    return IDX_OK;
}

int tooldata_find_index_for_tool(int toolno)
{
    if (!store.map || toolno == -1) return -1;
    if (toolno == 0 && !store.map->is_random_toolchanger) return 0;
    const int last = tooldata_last_index_get();
    for (int i = 1; i <= last; ++i)
        if (store.map->tools[i].toolno == toolno) return i;
    return store.map->tools[0].toolno == toolno ? 0 : -1;
}
