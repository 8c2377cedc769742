// SPDX-License-Identifier: GPL-2.0-or-later
//
// process_watch.hh - what has become of a process? A reused process id is another process. [task]
#ifndef KERF_PROCESS_WATCH_HH
#define KERF_PROCESS_WATCH_HH

#include <fcntl.h>
#include <sys/types.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <utility>

class ProcessWatch {
public:
    explicit ProcessWatch(pid_t pid = 0) : fd_(pid > 0 ? open_stat(pid) : -1) {}
    ~ProcessWatch() {
        if (fd_ >= 0) close(fd_);
    }
    ProcessWatch(ProcessWatch &&other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
    ProcessWatch &operator=(ProcessWatch &&other) noexcept {
        std::swap(fd_, other.fd_);
        return *this;
    }
    bool good() const { return fd_ >= 0; } // there was such a process
    // Its first thread at least: the others of one that was killed may take a while.
    bool ended() const {
        const char s = state();
        return s == 'Z' || s == 'X' || s == 'x' || s == 0;
    }
    // By a signal, or by a debugger.
    bool stopped() const {
        const char s = state();
        return s == 'T' || s == 't';
    }
private:
    static int open_stat(pid_t pid) {
        char name[32];
        snprintf(name, sizeof name, "/proc/%d/stat", static_cast<int>(pid));
        return open(name, O_RDONLY | O_CLOEXEC);
    }
    // The letter of proc(5); 0: it has gone, ' ': nothing is watched.
    char state() const {
        if (fd_ < 0) return ' ';
        char text[256];
        const ssize_t n = pread(fd_, text, sizeof text - 1, 0); // the open file stays that of this process
        if (n <= 0) return 0;
        text[n] = 0;
        const char *name_end = strrchr(text, ')');
        return name_end && name_end[1] ? name_end[2] : 0;
    }
    int fd_;
};

#endif
