// SPDX-License-Identifier: GPL-2.0-or-later
//
// jog_owners.cc - see jog_owners.hh.
#include "jog_owners.hh"

void JogOwners::started(Jog jog, pid_t pid) {
    ended(jog);
    ProcessWatch owner(pid);
    if (owner.good()) owners_.emplace(jog, std::move(owner));
}

std::vector<JogOwners::Jog> JogOwners::orphans() {
    std::vector<Jog> gone;
    for (const auto &o : owners_)
        if (o.second.ended()) gone.push_back(o.first);
    for (Jog j : gone) ended(j);
    return gone;
}
