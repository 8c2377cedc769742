// SPDX-License-Identifier: GPL-2.0-or-later
//
// dry_run.cc - see dry_run.hh.
#include "dry_run.hh"

#include <algorithm>

constexpr size_t MAX_NOTES = 100; // more than anyone reads

DryRun::DryRun(const EMC_STAT &stat, const AxisLimits &limits, const CanonSettings &settings)
    : stat_(std::make_unique<EMC_STAT>(stat)) {
    canon_ = std::make_unique<TaskCanon>(*stat_, list_, limits, settings);
    canon_->source_line = [this] { return interp_ ? interp_->line() : 0; };
    highest_z_ = stat_->motion.traj.position.tran.z;
}

bool DryRun::begin(std::unique_ptr<Interp> interp, const TaskCanon &live_canon, const Interp &live_interp,
                   const std::string &program, int line) {
    interp_ = std::move(interp);
    canon_->take_state(live_canon);
    interp_->take_state(live_interp);
    list_.clear();
    wanted_line_ = line;
    interp_->get_offsets(offsets_.values);
    if (interp_->open(program.c_str()) == INTERP_OK) return true;
    error_ = interp_->error_text(INTERP_ERROR);
    return false;
}

void DryRun::note(const std::string &text) {
    if (notes_.size() < MAX_NOTES && std::find(notes_.begin(), notes_.end(), text) == notes_.end())
        notes_.push_back(text);
}

DryRun::Result DryRun::step(int lines) {
    for (; lines > 0; lines--) {
        int r = interp_->read();
        if (r == INTERP_OK && interp_->call_level() == 0 && interp_->line() >= wanted_line_) {
            canon_->FINISH();
            digest();
            interp_->get_offsets(offsets_.values);
            if (interp_->line() != wanted_line_)
                note("line " + std::to_string(wanted_line_) + " is not reached as such: the start is at line " +
                     std::to_string(interp_->line()));
            return Result::reached;
        }
        if (r == INTERP_OK) r = interp_->execute();
        if (r == INTERP_EXECUTE_FINISH) canon_->FINISH();
        digest();
        if (r == INTERP_EXECUTE_FINISH) {
            if (watch) watch(nullptr);
            interp_->synch();
            r = INTERP_OK;
        }
        if (r == INTERP_OK) continue;
        if (r > INTERP_MIN_ERROR) {
            error_ = std::string(interp_->error_text(r)) + " (line " + std::to_string(interp_->line()) + ")";
            return Result::failed;
        }
        canon_->FINISH();
        digest();
        error_ = "the program ends at line " + std::to_string(interp_->line());
        return Result::ended;
    }
    return Result::more;
}

void DryRun::digest() {
    while (!list_.empty()) {
        const InterpList::Entry order = list_.take();
        if (watch) watch(&order);
        digest_one(*order.message);
    }
}

void DryRun::digest_one(const NMLmsg &m) {
    EMC_STAT &s = *stat_;
    auto move_to = [&](const EmcPose &end) {
        s.motion.traj.position = s.motion.traj.actualPosition = end;
        highest_z_ = std::max(highest_z_, end.tran.z);
    };
    auto keep = [&](int which = 0) { last_[{m._type, which}] = AnyMessage(m); };
    switch (m._type) {
    case EMC_TRAJ_LINEAR_MOVE_TYPE:
        move_to(as<EMC_TRAJ_LINEAR_MOVE>(m).end);
        if (as<EMC_TRAJ_LINEAR_MOVE>(m).type == EMC_MOTION_TYPE_FEED) feed_ = as<EMC_TRAJ_LINEAR_MOVE>(m).vel;
        return;
    case EMC_TRAJ_CIRCULAR_MOVE_TYPE:
        move_to(as<EMC_TRAJ_CIRCULAR_MOVE>(m).end);
        feed_ = as<EMC_TRAJ_CIRCULAR_MOVE>(m).vel;
        return;
    case EMC_TRAJ_PROBE_TYPE:
        move_to(as<EMC_TRAJ_PROBE>(m).pos);
        s.motion.traj.probedPosition = as<EMC_TRAJ_PROBE>(m).pos;
        s.motion.traj.probe_tripped = 1;
        note("line " + std::to_string(interp_->line()) +
             " probes: its result is not known; the end of the move is taken");
        return;
    case EMC_AUX_INPUT_WAIT_TYPE:
        note("line " + std::to_string(interp_->line()) + " reads an input: its present value is taken");
        return;
    case EMC_SYSTEM_CMD_TYPE:
        note("line " + std::to_string(interp_->line()) + " runs " + as<EMC_SYSTEM_CMD>(m).string + ": it is not run");
        return;
    case EMC_MOTION_SET_DOUT_TYPE:
    case EMC_MOTION_SET_AOUT_TYPE:
        note("line " + std::to_string(interp_->line()) + " sets an output: it is not set");
        return;
    case EMC_SPINDLE_ON_TYPE:
    case EMC_SPINDLE_SPEED_TYPE:
    case EMC_SPINDLE_OFF_TYPE:
        {
            // The three begin alike as far as this goes: which spindle, at what speed.
            const int which = m._type == EMC_SPINDLE_ON_TYPE      ? as<EMC_SPINDLE_ON>(m).spindle
                              : m._type == EMC_SPINDLE_SPEED_TYPE ? as<EMC_SPINDLE_SPEED>(m).spindle
                                                                  : as<EMC_SPINDLE_OFF>(m).spindle;
            double speed = 0;
            EMC_SPINDLE_ON on;
            if (m._type == EMC_SPINDLE_ON_TYPE) on = as<EMC_SPINDLE_ON>(m);
            if (m._type == EMC_SPINDLE_SPEED_TYPE) {
                on.spindle = which;
                on.speed = as<EMC_SPINDLE_SPEED>(m).speed;
                on.factor = as<EMC_SPINDLE_SPEED>(m).factor;
                on.xoffset = as<EMC_SPINDLE_SPEED>(m).xoffset;
                on.wait_for_spindle_at_speed = 1;
            }
            speed = on.speed;
            for (int i = 0; i < s.motion.traj.spindles && i < EMCMOT_MAX_SPINDLES; i++) {
                if (which >= 0 && which != i) continue;
                s.motion.spindle[i].speed = speed;
                s.motion.spindle[i].enabled = speed != 0;
                s.motion.spindle[i].direction = speed > 0 ? 1 : speed < 0 ? -1 : 0;
                on.spindle = i;
                last_[{EMC_SPINDLE_ON_TYPE, i}] = AnyMessage(on);
            }
            return;
        }
    case EMC_COOLANT_MIST_ON_TYPE: s.io.coolant.mist = 1; return;
    case EMC_COOLANT_MIST_OFF_TYPE: s.io.coolant.mist = 0; return;
    case EMC_COOLANT_FLOOD_ON_TYPE: s.io.coolant.flood = 1; return;
    case EMC_COOLANT_FLOOD_OFF_TYPE: s.io.coolant.flood = 0; return;
    case EMC_TOOL_PREPARE_TYPE:
        s.io.tool.pocketPrepped = tooldata_find_index_for_tool(as<EMC_TOOL_PREPARE>(m).tool);
        return;
    case EMC_TOOL_LOAD_TYPE:
    case EMC_TOOL_SET_NUMBER_TYPE:
        {
            const int idx = m._type == EMC_TOOL_LOAD_TYPE ? s.io.tool.pocketPrepped : as<EMC_TOOL_SET_NUMBER>(m).tool;
            CANON_TOOL_TABLE t = tooldata_entry_init();
            if (idx < 0) return;
            tooldata_get(&t, idx);
            s.io.tool.toolInSpindle = idx == 0 && !tool_mmap_is_random_toolchanger() ? 0 : t.toolno;
            s.io.tool.pocketPrepped = -1;
            return;
        }
    case EMC_TOOL_SET_OFFSET_TYPE: tool_table_.emplace_back(m); return;
    case EMC_TRAJ_SET_G5X_TYPE:
        s.task.g5x_offset = as<EMC_TRAJ_SET_G5X>(m).origin;
        s.task.g5x_index = as<EMC_TRAJ_SET_G5X>(m).g5x_index;
        return keep();
    case EMC_TRAJ_SET_G92_TYPE: s.task.g92_offset = as<EMC_TRAJ_SET_G92>(m).origin; return keep();
    case EMC_TRAJ_SET_ROTATION_TYPE: s.task.rotation_xy = as<EMC_TRAJ_SET_ROTATION>(m).rotation; return keep();
    case EMC_TRAJ_SET_OFFSET_TYPE: s.task.toolOffset = as<EMC_TRAJ_SET_OFFSET>(m).offset; return keep();
    case EMC_TRAJ_SET_FO_ENABLE_TYPE:
        s.motion.traj.feed_override_enabled = as<EMC_TRAJ_SET_FO_ENABLE>(m).mode;
        return keep();
    case EMC_TRAJ_SET_FH_ENABLE_TYPE:
        s.motion.traj.feed_hold_enabled = as<EMC_TRAJ_SET_FH_ENABLE>(m).mode;
        return keep();
    case EMC_MOTION_ADAPTIVE_TYPE:
        s.motion.traj.adaptive_feed_enabled = as<EMC_MOTION_ADAPTIVE>(m).status;
        return keep();
    case EMC_TRAJ_SET_SO_ENABLE_TYPE: return keep(as<EMC_TRAJ_SET_SO_ENABLE>(m).spindle);
    case EMC_TRAJ_SET_TERM_COND_TYPE:
    case EMC_TRAJ_SET_SPINDLESYNC_TYPE: return keep();
    default: return; // dwells, stops, messages
    }
}

int DryRun::prepared() const {
    const int idx = stat_->io.tool.pocketPrepped;
    if (idx < 0) return -1;
    if (idx == 0 && !tool_mmap_is_random_toolchanger()) return 0;
    CANON_TOOL_TABLE t = tooldata_entry_init();
    tooldata_get(&t, idx);
    return t.toolno;
}

std::vector<AnyMessage> DryRun::modes() const {
    std::vector<AnyMessage> orders;
    for (const auto &[key, m] : last_)
        if (key.first != EMC_SPINDLE_ON_TYPE) orders.emplace_back(*m);
    orders.emplace_back(offsets_);
    return orders;
}

std::vector<AnyMessage> DryRun::starts() const {
    std::vector<AnyMessage> orders;
    for (const auto &[key, m] : last_)
        if (key.first == EMC_SPINDLE_ON_TYPE && as<EMC_SPINDLE_ON>(*m).speed != 0) orders.emplace_back(*m);
    if (stat_->io.coolant.mist) orders.emplace_back(EMC_COOLANT_MIST_ON());
    if (stat_->io.coolant.flood) orders.emplace_back(EMC_COOLANT_FLOOD_ON());
    return orders;
}

void DryRun::hand_over(EMC_STAT &stat, InterpList &list, std::unique_ptr<TaskCanon> *canon,
                       std::unique_ptr<Interp> *interp) {
    canon_->attach(stat, list);
    interp_->keep_parameters(true);
    *interp = std::move(interp_); // the old interpreter goes before the canon it calls
    *canon = std::move(canon_);
}
