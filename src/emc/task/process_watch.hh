// SPDX-License-Identifier: GPL-2.0-or-later
//
// process_watch.hh - has a process ended? A reused process id is another process. [task]
#ifndef KERF_PROCESS_WATCH_HH
#define KERF_PROCESS_WATCH_HH

#include <poll.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <unistd.h>

#include <utility>

class ProcessWatch {
public:
    explicit ProcessWatch(pid_t pid = 0) : fd_(pid > 0 ? static_cast<int>(syscall(SYS_pidfd_open, pid, 0)) : -1) {}
    ~ProcessWatch() {
        if (fd_ >= 0) close(fd_);
    }
    ProcessWatch(ProcessWatch &&other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
    ProcessWatch &operator=(ProcessWatch &&other) noexcept {
        std::swap(fd_, other.fd_);
        return *this;
    }
    bool good() const { return fd_ >= 0; } // there was such a process
    bool ended() const {
        pollfd p{fd_, POLLIN, 0}; // readable: the process has ended
        return fd_ >= 0 && poll(&p, 1, 0) > 0;
    }
private:
    int fd_;
};

#endif
