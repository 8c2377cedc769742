// SPDX-License-Identifier: GPL-2.0-or-later
//
// fault_stop.hh - what a joint's fault does to the spindles, and whether the machine may leave a limit switch
// by itself. [task]
//
// In:  [TASK] LIMIT_SWITCH_SPINDLE, AMP_FAULT_SPINDLE, FOLLOWING_ERROR_SPINDLE, LIMIT_SWITCH_RETRACT; feedback
//      of the joints
// Out: when the spindles go off
#ifndef KERF_FAULT_STOP_HH
#define KERF_FAULT_STOP_HH

#include <cstdint>
#include <vector>

#include "emc_nml.hh"
#include "inifile.hh"

class FaultStop {
public:
    enum class Retract { OPERATOR, AUTO, NO }; // who overrides a limit switch: the operator, turning on, nobody

    // Once, at start. False: a value is none of the words; it was printed.
    bool load(const linuxcnc::IniFile &ini);
    Retract retract() const { return retract_; }

    // The spindles turn on until the joints stand; causes: EMCMOT_STOP_*. False: they are to go off at once.
    bool begin(int causes, const EMC_MOTION_STAT &motion, int64_t now_ns);
    bool waiting() const { return due_ != 0; }
    void end() { due_ = 0; }
    // While waiting, every cycle. True once: all joints stand, or REST_MOST_S have gone by.
    bool over(const EMC_MOTION_STAT &motion, const double *max_velocity, int64_t now_ns);
private:
    void look(const EMC_MOTION_STAT &motion);
    int at_rest_ = 0; // causes that wait
    Retract retract_ = Retract::OPERATOR;
    int64_t due_ = 0;
    uint64_t looked_ = 0;
    std::vector<double> position_;
};

#endif
