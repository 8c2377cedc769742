// SPDX-License-Identifier: GPL-2.0-or-later
//
// jog_owners.cc - see jog_owners.hh.
#include "jog_owners.hh"

#include <poll.h>
#include <sys/syscall.h>
#include <unistd.h>

void JogOwners::clear() {
    for (const auto &o : owners_) close(o.second);
    owners_.clear();
}

void JogOwners::started(Jog jog, pid_t pid) {
    ended(jog);
    const int fd = pid > 0 ? static_cast<int>(syscall(SYS_pidfd_open, pid, 0)) : -1;
    if (fd >= 0) owners_[jog] = fd;
}

void JogOwners::ended(Jog jog) {
    auto it = owners_.find(jog);
    if (it == owners_.end()) return;
    close(it->second);
    owners_.erase(it);
}

std::vector<JogOwners::Jog> JogOwners::orphans() {
    std::vector<Jog> gone;
    for (const auto &o : owners_) {
        pollfd p{o.second, POLLIN, 0}; // readable: the process has ended
        if (poll(&p, 1, 0) > 0) gone.push_back(o.first);
    }
    for (Jog j : gone) ended(j);
    return gone;
}
