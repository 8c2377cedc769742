// SPDX-License-Identifier: GPL-2.0-or-later
//
// dry_run.hh - what a program sets up to one of its lines: the program is interpreted up to
// there with a machine that exists only on paper.
//
// In:     the machine's status, canon and interpreter as they are now; program and line
// Out:    the state at that line; an interpreter that stands before it
// Thread: [task]; nothing is sent to motion or I/O, no file is written
#ifndef KERF_DRY_RUN_HH
#define KERF_DRY_RUN_HH

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "interp.hh"
#include "interp_list.hh"
#include "messages.hh"
#include "offsets_now.hh"
#include "task_canon.hh"

class DryRun {
public:
    // Where the machine stands now, and its canon and interpreter.
    DryRun(const EMC_STAT &stat, const AxisLimits &limits, const CanonSettings &settings);
    TaskCanon &canon() { return *canon_; }

    // interp: made for canon(), initialised. false: see error().
    bool begin(std::unique_ptr<Interp> interp, const TaskCanon &live_canon, const Interp &live_interp,
               const std::string &program, int line);

    // Told of each order in turn before it takes effect on paper; null: the interpreter waits for all before.
    std::function<void(const InterpList::Entry *)> watch;

    enum class Result { more, reached, ended, failed };
    // Interprets at most `lines` lines.
    Result step(int lines);

    // After `reached`:
    int line() const { return interp_->line(); }         // the first one that will run: read, not executed
    const EmcPose &position() const { return stat_->motion.traj.position; }
    double highest_z() const { return highest_z_; }      // machine units, of all moves before
    int tool() const { return stat_->io.tool.toolInSpindle; }
    int prepared() const;                                // tool number that a T word has called for, -1 none
    double feed() const { return feed_; }                // machine units a second, of the last feed move; 0 none
    const EMC_STAT &stat() const { return *stat_; }
    // Orders that put the modes of motion and the status in place; those that start something.
    const std::vector<AnyMessage> &tool_table() const { return tool_table_; }
    std::vector<AnyMessage> modes() const;
    std::vector<AnyMessage> starts() const;              // spindles and coolant that are on
    const std::vector<std::string> &notes() const { return notes_; } // what can not be restored

    const std::string &error() const { return error_; }
    const Interp &interp() const { return *interp_; }
    // The interpreter and its canon, which then works for the machine itself.
    void hand_over(EMC_STAT &stat, InterpList &list, std::unique_ptr<TaskCanon> *canon,
                   std::unique_ptr<Interp> *interp);

private:
    void digest();
    void digest_one(const NMLmsg &m);
    void note(const std::string &text);
    template <class T> static const T &as(const NMLmsg &m) { return static_cast<const T &>(m); }

    std::unique_ptr<EMC_STAT> stat_;
    InterpList list_;
    std::unique_ptr<TaskCanon> canon_;
    std::unique_ptr<Interp> interp_;
    int wanted_line_ = 0;
    double highest_z_ = 0, feed_ = 0;
    std::map<std::pair<NMLTYPE, int>, AnyMessage> last_; // the last order of each kind (and spindle)
    std::vector<AnyMessage> tool_table_;
    std::vector<std::string> notes_;
    OffsetsNow offsets_;
    std::string error_;
};

#endif
