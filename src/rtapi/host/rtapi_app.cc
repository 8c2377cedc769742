// SPDX-License-Identifier: GPL-2.0-or-later
//
// rtapi_app.cc - the userspace realtime host: loads modules and runs their threads.
// One binary is both client and daemon; whoever can bind the socket is the daemon.
//
// Thread: everything here is [init], in the daemon's main thread
// Source: runtime sheet, section 7

#include "host.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <map>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <string>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>
#include "kerf_clock.h"
#include "kerf_instance.h"
#include "kerf_paths.h"

namespace
{

using Words = std::vector<std::string>;

struct Module {
    void *handle;
    int order;
};
std::map<std::string, Module> modules;
int load_count;
std::string output; // text for the client of the present request
bool leaving;

// ---- parameters -------------------------------------------------------------------------

template <class T> T *symbol(void *handle, const std::string &name)
{
    return reinterpret_cast<T *>(dlsym(handle, name.c_str()));
}

bool convert(char type, const std::string &text, void *target, size_t index, const std::string &word)
{
    char *end;
    switch (type) {
    case 'i':
    case 'l': {
        long value = strtol(text.c_str(), &end, 0);
        if (*end) {
            rtapi_print_msg(RTAPI_MSG_ERR, "`%s' invalid for parameter `%s'\n", text.c_str(), word.c_str());
            return false;
        }
        if (type == 'i')
            static_cast<int *>(target)[index] = int(value);
        else
            static_cast<long *>(target)[index] = value;
        return true;
    }
    case 's': static_cast<char **>(target)[index] = strdup(text.c_str()); return true;
    }
    return false;
}

bool set_parameter(const std::string &module, void *handle, std::string word)
{
    std::string clean;
    for (char c : word)
        if (c != '"') clean += c;
    auto equals = clean.find('=');
    if (equals == clean.npos) {
        rtapi_print_msg(RTAPI_MSG_ERR, "Invalid parameter `%s'\n", clean.c_str());
        return false;
    }
    std::string name = clean.substr(0, equals), value = clean.substr(equals + 1);
    void **address = symbol<void *>(handle, "rtapi_info_address_" + name);
    if (!address) {
        rtapi_print_msg(RTAPI_MSG_ERR, "Unknown parameter `%s'\n", clean.c_str());
        return false;
    }
    const char **type = symbol<const char *>(handle, "rtapi_info_type_" + name);
    if (!type) {
        rtapi_print_msg(RTAPI_MSG_ERR, "Unknown parameter `%s' (type information missing)\n", clean.c_str());
        return false;
    }
    if (!strchr("ils", **type)) {
        rtapi_print_msg(RTAPI_MSG_ERR, "%s: Invalid type character `%c'\n", name.c_str(), **type);
        return false;
    }
    int *size = symbol<int>(handle, "rtapi_info_size_" + name);
    if (!size) return convert(**type, value, *address, 0, clean);
    size_t at = 0;
    for (int i = 0;; i++) {
        size_t comma = value.find(',', at);
        if (i >= *size) {
            rtapi_print_msg(RTAPI_MSG_ERR, "%s: can only take %d arguments\n", name.c_str(), *size);
            return false;
        }
        if (!convert(**type, value.substr(at, comma - at), *address, size_t(i), clean)) return false;
        if (comma == value.npos) return true;
        at = comma + 1;
    }
    (void)module;
}

// ---- modules ----------------------------------------------------------------------------

int load(const std::string &name, const Words &parameters)
{
    if (modules.count(name)) {
        rtapi_print_msg(RTAPI_MSG_ERR, "%s: already exists\n", name.c_str());
        return -1;
    }
    if (name.find('/') != name.npos || name.find("..") != name.npos) {
        rtapi_print_msg(RTAPI_MSG_ERR, "%s: Not allowed as module name. Slashes or with \"..\" (even /a..b/) are not allowed.\n",
                        name.c_str());
        return -1;
    }
    std::string path = std::string(kerf_path(KERF_PATH_RTLIB)) + "/" + name + ".so";
    void *handle = dlopen(path.c_str(), RTLD_GLOBAL | RTLD_NOW);
    if (!handle) {
        rtapi_print_msg(RTAPI_MSG_ERR, "%s: dlopen: %s\n", name.c_str(), dlerror());
        return -1;
    }
    auto start = symbol<int()>(handle, "rtapi_app_main");
    if (!start) {
        rtapi_print_msg(RTAPI_MSG_ERR, "%s: dlsym: %s\n", name.c_str(), dlerror());
        dlclose(handle);
        return -1;
    }
    if (!dlsym(handle, "rtapi_app_exit")) {
        rtapi_print_msg(RTAPI_MSG_ERR, "%s: component is missing rtapi_app_exit\n", name.c_str());
        dlclose(handle);
        return -1;
    }
    for (auto &word : parameters)
        if (!set_parameter(name, handle, word)) {
            dlclose(handle);
            return -1;
        }
    int result = start();
    if (result < 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "%s: rtapi_app_main: %s (%d)\n", name.c_str(), strerror(-result), result);
        dlclose(handle);
        return result;
    }
    modules[name] = {handle, load_count++};
    return 0;
}

int unload(const std::string &name)
{
    auto found = modules.find(name);
    if (found == modules.end()) {
        rtapi_print_msg(RTAPI_MSG_ERR, "%s: not loaded\n", name.c_str());
        return -1;
    }
    symbol<void()>(found->second.handle, "rtapi_app_exit")();
    dlclose(found->second.handle);
    modules.erase(found);
    return 0;
}

int set_level(const std::string &text)
{
    char *end;
    long level = strtol(text.c_str(), &end, 10);
    if (end == text.c_str()) {
        rtapi_print_msg(RTAPI_MSG_ERR, "Debug level is not a number\n");
        return -EINVAL;
    }
    if (level < 0 || level > 5) {
        rtapi_print_msg(RTAPI_MSG_ERR, "Debug level must be >=0 and <= 5\n");
        return -EINVAL;
    }
    return rtapi_set_msg_level(int(level));
}

const char *type_name(rtapi_realtime_type_t type)
{
    static const char *const names[] = {"Uninitialized", "No realtime", "Unknown (SCHED_FIFO)", "Preempt Dynamic", "Preempt RT",
                                        "RTAI", "LXRT", "Xenomai", "Xenomai EVL"};
    return names[int(type) + 1];
}

int handle(const Words &words)
{
    size_t n = words.size();
    const std::string command = n ? words[0] : "";
    if (n == 0) return 0;
    if (n == 1 && command == "start") {
        rtapi_print_msg(RTAPI_MSG_ERR, "rtapi_app: start received while running\n");
        return 0;
    }
    if (n == 1 && command == "ping") return 0;
    if (n == 1 && command == "exit") {
        leaving = true;
        return 0;
    }
    if (n == 1 && command == "check_rt") {
        output = type_name(host_realtime_type());
        return host_realtime_type() > REALTIME_TYPE_NONE ? 0 : 1;
    }
    if (n >= 2 && command == "load") return load(words[1], Words(words.begin() + 2, words.end()));
    if (n == 2 && command == "unload") return unload(words[1]);
    if (n == 2 && command == "debug") return set_level(words[1]);
    rtapi_print_msg(RTAPI_MSG_ERR, "rtapi_app: unrecognized command starting with %s\n", command.c_str());
    return -1;
}

// ---- the socket -------------------------------------------------------------------------

sockaddr_un address()
{
    sockaddr_un a = {};
    a.sun_family = AF_UNIX;
    std::string path;
    if (const char *given = getenv("RTAPI_FIFO_PATH"))
        path = given;
    else if (const char *home = getenv("HOME"))
        path = std::string(home) + "/.rtapi_fifo";
    else {
        fprintf(stderr, "rtapi_app: RTAPI_FIFO_PATH and HOME are unset.  rtapi fifo creation is unsafe.\n");
        exit(1);
    }
    if (*kerf_instance()) path += std::string(".") + kerf_instance();
    if (path.size() > sizeof a.sun_path - 2) {
        fprintf(stderr, "rtapi_app: rtapi fifo path is too long (arch limit %zd): %s\n", sizeof a.sun_path - 2, path.c_str());
        exit(1);
    }
    memcpy(a.sun_path + 1, path.data(), path.size());
    return a;
}

bool send_all(int fd, const std::string &data)
{
    for (size_t at = 0; at < data.size();) {
        ssize_t n = send(fd, data.data() + at, data.size() - at, MSG_NOSIGNAL);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) return false;
        at += size_t(n);
    }
    return true;
}

bool receive(int fd, char *to, size_t size)
{
    for (size_t at = 0; at < size;) {
        ssize_t n = recv(fd, to + at, size - at, 0);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) return false;
        at += size_t(n);
    }
    return true;
}

void put16(std::string &s, size_t v)
{
    s += char(v & 255);
    s += char(v >> 8 & 255);
}
size_t get16(const char *p)
{
    return size_t((unsigned char)p[0]) | size_t((unsigned char)p[1]) << 8;
}

bool read_request(int fd, Words &words)
{
    char head[2];
    if (!receive(fd, head, 2)) return false;
    size_t total = get16(head);
    if (total < 4) return false;
    std::string body(total - 2, 0);
    if (!receive(fd, body.data(), body.size())) return false;
    size_t count = get16(body.data()), at = 2;
    for (size_t i = 0; i < count; i++) {
        if (at + 2 > body.size()) return false;
        size_t len = get16(body.data() + at);
        at += 2;
        if (at + len > body.size()) return false;
        words.push_back(body.substr(at, len));
        at += len;
    }
    return true;
}

void serve(int listener)
{
    while (!leaving) {
        int fd = accept4(listener, nullptr, nullptr, SOCK_CLOEXEC);
        if (fd < 0) continue;
        timeval limit = {10, 0};
        setsockopt(fd, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
        Words words;
        if (read_request(fd, words)) {
            output.clear();
            int result = handle(words);
            fflush(stdout);
            std::string reply;
            put16(reply, 2 + 4 + 2 + output.size());
            for (int i = 0; i < 4; i++) reply += char(unsigned(result) >> (8 * i) & 255);
            put16(reply, output.size());
            reply += output;
            if (leaving) close(listener);
            send_all(fd, reply);
        } else {
            fprintf(stderr, "rtapi_app: failed to read from slave\n");
        }
        close(fd);
    }
}

int request(int fd, const Words &words)
{
    std::string body;
    put16(body, words.size());
    for (auto &w : words) {
        put16(body, w.size());
        body += w;
    }
    if (body.size() + 2 > 65535) {
        fprintf(stderr, "rtapi_app: send_args: args too big, size = %li!\nrtapi_app: failed to write to master\n",
                long(body.size() + 2));
        return 255;
    }
    std::string message;
    put16(message, body.size() + 2);
    char head[2];
    if (!send_all(fd, message + body) || !receive(fd, head, 2)) {
        fprintf(stderr, "rtapi_app: recv_result 1 failed, recv only 0 of 2 bytes\nrtapi_app: failed to read from master\n");
        return 255;
    }
    std::string reply(get16(head) - 2, 0);
    if (!receive(fd, reply.data(), reply.size()) || reply.size() < 6) return 255;
    int result = 0;
    for (int i = 0; i < 4; i++) result |= int((unsigned char)reply[size_t(i)]) << (8 * i);
    if (reply.size() > 6) printf("%s\n", reply.substr(6).c_str());
    return result & 0xff;
}

int as_client(const Words &words)
{
    sockaddr_un a = address();
    for (int tries = 0; tries < 300; tries++) {
        int fd = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
        if (connect(fd, reinterpret_cast<sockaddr *>(&a), sizeof a) == 0) {
            int result = request(fd, words);
            close(fd);
            return result;
        }
        int e = errno;
        close(fd);
        if (e != ECONNREFUSED && e != EAGAIN) {
            fprintf(stderr, "connect %s: %s\n", a.sun_path + 1, strerror(e));
            return 1;
        }
        usleep(10000);
    }
    fprintf(stderr, "Waited 3 seconds for master.  giving up.\n");
    return 1;
}

void daemon_main(int listener, const Words &first, int answer)
{
    setsid();
    unsetenv(KERF_CLOCK_SLOT_ENV); // that place belongs to whoever started us
    host_messages_start();
    rtapi_shmem_policy.lock = host_realtime_type() > REALTIME_TYPE_NONE;
    host_setup();
    load("hal_lib", {});
    rtapi_print_msg(RTAPI_MSG_ERR, "Note: Using %s\n",
                    host_realtime_type() > REALTIME_TYPE_NONE ? "POSIX realtime" : "POSIX non-realtime");
    int result = first.empty() || first[0] == "start" ? 0 : handle(first);
    fflush(stdout);
    if (write(answer, &result, sizeof result) < 0) perror("rtapi_app");
    close(answer);
    serve(listener);
    if (modules.count("hal_lib")) unload("hal_lib");
    host_messages_flush();
    fflush(nullptr);
    _exit(0);
}

// `realtime stop`: ends the daemon of this instance, waits for it, removes what is left of it.
int stop_and_clean()
{
    sockaddr_un a = address();
    int fd = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (connect(fd, reinterpret_cast<sockaddr *>(&a), sizeof a) == 0) {
        ucred peer = {};
        socklen_t size = sizeof peer;
        getsockopt(fd, SOL_SOCKET, SO_PEERCRED, &peer, &size);
        request(fd, {"exit"});
        for (int i = 0; i < 5000 && peer.pid > 0 && kill(peer.pid, 0) == 0; i++) usleep(1000);
        if (peer.pid > 0 && kill(peer.pid, 0) == 0) fprintf(stderr, "ERROR: rtapi_app failed to die\n");
    }
    close(fd);
    for (int key : {0x48414c32, int(0x90280A48), 0x48484c34, 0x4b434c4b}) rtapi_shmem_remove_stale(key);
    return 0;
}

} // namespace

int main(int argc, char **argv)
{
    Words words(argv + 1, argv + argc);
    if (words.size() == 1 && words[0] == "stop-and-clean") return stop_and_clean();
    if (getuid() == 0) {
        const char *fallback = getenv("RTAPI_UID");
        if (fallback && atoi(fallback) > 0) {
            if (setreuid(uid_t(atoi(fallback)), 0) < 0) perror("setreuid");
            fprintf(stderr, "Running with fallback_uid.  getuid()=%d geteuid()=%d\n", int(getuid()), int(geteuid()));
        }
    }
    sockaddr_un a = address();
    int listener = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (bind(listener, reinterpret_cast<sockaddr *>(&a), sizeof a) < 0) {
        if (errno != EADDRINUSE) {
            perror("rtapi_app: bind");
            return 1;
        }
        close(listener);
        return as_client(words);
    }
    bool one = words.size() == 1;
    if (one && words[0] == "ping") return 1;
    if (one && words[0] == "exit") {
        printf("rtapi_app: exit received while not running\n");
        return 0;
    }
    if (one && words[0] == "check_rt") {
        rtapi_realtime_type_t type = host_realtime_type();
        puts(type_name(type));
        return type > REALTIME_TYPE_NONE ? 0 : 1;
    }
    if (!(one && words[0] == "start"))
        fputs("WARNING: Deprecated: No active realtime environment found. Use \"realtime start\" to start one.\n"
              "  A realtime environment is started automatically.\n"
              "  If this appears while using halcmd: Use halrun instead.\n"
              "  halcmd should only be used with an already running realtime environment.\n"
              "  halrun creates a realtime environment and tears it down at exit.\n",
              stderr);
    listen(listener, 10);
    int answer[2];
    if (pipe2(answer, O_CLOEXEC) < 0) return 1;
    pid_t pid = fork();
    if (pid == 0) {
        close(answer[0]);
        daemon_main(listener, words, answer[1]);
    }
    close(listener);
    close(answer[1]);
    int result = 255;
    if (read(answer[0], &result, sizeof result) != sizeof result) result = 255;
    return result & 0xff;
}
