// SPDX-License-Identifier: GPL-2.0-or-later
//
// fault_stop.cc - see fault_stop.hh.
#include "fault_stop.hh"

#include <cmath>
#include <string>

#include "ini_settings.hh"
#include "motion.h"
#include "rcs_print.hh"

namespace {

constexpr double REST_MOST_S = 2.0, // a machine that does not come to rest
    LOOK_S = 0.01,                  // between two looks at the feedback
    REST_SPEED = 0.005;             // of a joint's greatest velocity: at rest

int64_t ns(double s) { return static_cast<int64_t>(s * 1e9); }

} // namespace

bool FaultStop::load(const linuxcnc::IniFile &ini) {
    struct { const char *name; int cause, standard; } const faults[] = {
        {"LIMIT_SWITCH_SPINDLE", EMCMOT_STOP_LIMIT, 0},
        {"AMP_FAULT_SPINDLE", EMCMOT_STOP_AMPLIFIER, 0},
        {"FOLLOWING_ERROR_SPINDLE", EMCMOT_STOP_FOLLOWING, 1},
    };
    bool good = true;
    for (const auto &f : faults) {
        const int word = word_of(ini, "TASK", f.name, f.standard, {"OFF", "REST"});
        good = good && word >= 0;
        if (word == 1) at_rest_ |= f.cause;
    }
    const int word = word_of(ini, "TASK", "LIMIT_SWITCH_RETRACT", 0, {"OPERATOR", "AUTO", "NO"});
    retract_ = static_cast<Retract>(word < 0 ? 0 : word);
    return good && word >= 0;
}

void FaultStop::look(const EMC_MOTION_STAT &motion) {
    position_.resize(static_cast<size_t>(motion.traj.joints));
    for (size_t j = 0; j < position_.size(); j++) position_[j] = motion.joint[j].input;
    looked_ = motion.heartbeat;
}

bool FaultStop::begin(int causes, const EMC_MOTION_STAT &motion, int64_t now_ns) {
    if (causes == 0 || (causes & ~at_rest_) != 0) return false;
    if (waiting()) return true;
    due_ = now_ns + ns(REST_MOST_S);
    look(motion);
    return true;
}

bool FaultStop::over(const EMC_MOTION_STAT &motion, const double *max_velocity, int64_t now_ns) {
    bool rest = now_ns >= due_;
    // By motion's own count: the status may be older than now.
    const double seconds = static_cast<double>(motion.heartbeat - looked_) * motion.traj.cycleTime;
    if (!rest && seconds >= LOOK_S) {
        rest = true;
        for (size_t j = 0; j < position_.size(); j++)
            rest = rest && std::fabs(motion.joint[j].input - position_[j]) <= REST_SPEED * max_velocity[j] * seconds;
        look(motion);
    }
    if (rest) end();
    return rest;
}
