// SPDX-License-Identifier: GPL-2.0-or-later
//
// run_time.hh - how long the orders of a program take: the planner of motion runs on paper, as
// fast as the computer can, with the limits that the machine has.
//
// In:     orders of the interpreter (DryRun::watch)
// Out:    seconds, and when each move begins
// Units:  machine units, degrees, seconds, rpm
// Thread: [task]; one at a time in a process: the planner has one set of callbacks
#ifndef KERF_RUN_TIME_HH
#define KERF_RUN_TIME_HH

#include <functional>
#include <memory>
#include <string>

#include "inifile.hh"
#include "interp_list.hh"
#include "messages.hh"
#include "task_canon.hh"

// Limits of the axes as the INI file has them, less what external offsets keep for themselves.
AxisLimits axis_limits(const linuxcnc::IniFile &ini);

struct Rates {
    double feed = 1, rapid = 1, spindle = 1; // overrides
    double max_velocity = 1e99;              // machine units a second
    double tool_change_s = 0;                // what a tool change takes beside its moves
    double s_per_rpm = 0;                    // of a spindle's change of speed
    double user_code_s = 0;                  // a program of an M1xx code
};

// What a program waits for beside its moves, counted.
struct Waits {
    int tool_changes = 0, spindle_starts = 0, user_codes = 0;
    int inputs = 0, stops = 0;               // M66 with a wait; M0, M1, M60: no time is known
};

class RunTime {
public:
    RunTime(const EMC_STAT &stat, const linuxcnc::IniFile &ini, const Rates &rates);
    ~RunTime();
    // A move of a source line begins; number counts moves.
    std::function<void(int line, long number, double seconds)> on_move;

    // The next order; null: all before it are done now. Nothing more counts after failed().
    void take(const InterpList::Entry *order);
    // To the end of what was given.
    void drain();
    double seconds() const { return seconds_; }
    const Waits &waits() const { return waits_; }
    // From now on seconds, moves and waits count.
    void restart();
    // Why the time is not known further; empty: it is.
    const std::string &failed() const { return failed_; }

private:
    struct Planner;
    void move(int line, const NMLmsg &m);
    int take_at_speed(int type);
    void spindle(int which, double speed, double factor, double xoffset);
    void cycle();
    void stop_and_wait(double seconds);
    template <class T> static const T &as(const NMLmsg &m) { return static_cast<const T &>(m); }

    std::unique_ptr<Planner> planner_;
    Rates rates_;
    Waits waits_;
    double seconds_ = 0, task_cycle_ = 0.001;
    long number_ = 0, shown_ = 0;
    int last_wait_ = 1; // whether a spindle's order lets the next feed wait
    int mist_ = 0, flood_ = 0, spindles_ = 1, pending_type_ = 0;
    std::string failed_;
};

#endif
