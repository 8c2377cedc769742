// SPDX-License-Identifier: GPL-2.0-or-later
//
// jog_owners.cc - see jog_owners.hh.
#include "jog_owners.hh"

static constexpr int64_t HEARTBEAT_NS = 250'000'000; // FP-061

void JogOwners::started(Jog jog, pid_t pid) {
    ended(jog);
    ProcessWatch process(pid);
    if (process.good()) owners_.emplace(jog, Owner{std::move(process)});
}

void JogOwners::held(Jog jog, int64_t now) {
    if (auto it = owners_.find(jog); it != owners_.end()) it->second.due = now + HEARTBEAT_NS;
}

std::vector<JogOwners::Orphan> JogOwners::orphans(int64_t now) {
    std::vector<Orphan> found;
    for (const auto &[jog, owner] : owners_) {
        if (owner.process.ended()) found.push_back({jog, "has ended"});
        else if (owner.process.stopped() || (owner.due != 0 && now > owner.due))
            found.push_back({jog, "does not get on"});
    }
    for (const Orphan &o : found) ended(o.jog);
    return found;
}
