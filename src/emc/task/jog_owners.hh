// SPDX-License-Identifier: GPL-2.0-or-later
//
// jog_owners.hh - which process holds which continuous jog: one that has ended, or does not get on, can not
// release its key any more. [task]
#ifndef KERF_JOG_OWNERS_HH
#define KERF_JOG_OWNERS_HH

#include <sys/types.h>

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "process_watch.hh"

class JogOwners {
public:
    using Jog = std::pair<int, int>; // joint (axis) number; 1 joint, 0 axis
    struct Orphan {
        Jog jog;
        const char *why; // of its process
    };
    // Process pid has started this jog, whoever held it before. 0: nobody knows.
    void started(Jog jog, pid_t pid);
    void ended(Jog jog) { owners_.erase(jog); }
    // A heartbeat of this jog, if it is one: the next one has to come soon. now: ns of the clock.
    void held(Jog jog, int64_t now);
    void clear() { owners_.clear(); }
    bool any() const { return !owners_.empty(); }
    // The jogs whose process has ended, is stopped, or is late with a heartbeat; they are forgotten.
    std::vector<Orphan> orphans(int64_t now);
private:
    struct Owner {
        ProcessWatch process;
        int64_t due = 0; // of the next heartbeat; 0: none is expected
    };
    std::map<Jog, Owner> owners_;
};

#endif
