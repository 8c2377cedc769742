// SPDX-License-Identifier: GPL-2.0-or-later
//
// jog_owners.hh - which process holds which continuous jog: one that has ended can not release
// its key any more. [task]
#ifndef KERF_JOG_OWNERS_HH
#define KERF_JOG_OWNERS_HH

#include <sys/types.h>

#include <map>
#include <utility>
#include <vector>

#include "process_watch.hh"

class JogOwners {
public:
    using Jog = std::pair<int, int>; // joint (axis) number; 1 joint, 0 axis
    // Process pid has started this jog, whoever held it before. 0: nobody knows.
    void started(Jog jog, pid_t pid);
    void ended(Jog jog) { owners_.erase(jog); }
    void clear() { owners_.clear(); }
    bool any() const { return !owners_.empty(); }
    // The jogs whose process has ended; they are forgotten.
    std::vector<Jog> orphans();
private:
    std::map<Jog, ProcessWatch> owners_;
};

#endif
