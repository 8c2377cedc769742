// SPDX-License-Identifier: GPL-2.0-or-later
//
// rate_limit.hh - how often one client of a server is served: requests above it wait their turn. [task]
#ifndef KERF_RATE_LIMIT_HH
#define KERF_RATE_LIMIT_HH

#include <algorithm>
#include <cstdint>

namespace nml {

// PER_SECOND requests a second; AT_ONCE after a rest.
class RateLimit {
public:
    static constexpr int64_t PER_SECOND = 1000, AT_ONCE = 200;
    // One more request at this time (ns of any steady clock)? True: it is counted.
    bool take(int64_t now) {
        due_ = std::max(due_, now - AT_ONCE * INTERVAL_NS);
        if (due_ > now) return false;
        due_ += INTERVAL_NS;
        return true;
    }
    int64_t next_ns() const { return due_; } // when take() will be true

private:
    static constexpr int64_t INTERVAL_NS = 1'000'000'000 / PER_SECOND;
    int64_t due_ = -AT_ONCE * INTERVAL_NS;
};

} // namespace nml
#endif
