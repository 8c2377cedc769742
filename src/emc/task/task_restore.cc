// SPDX-License-Identifier: GPL-2.0-or-later
//
// task_restore.cc - start at a line with everything restored that the program sets before it.
//
// Three steps: look (a dry run, a slice a cycle), show (status and a message), and, when the
// operator confirms, restore: tool change, up, across, spindles and coolant, down, modes and
// offsets; then the program goes on. Nothing moves or starts before the confirmation, and what
// was shown is not done when program, offsets or tool changed meanwhile.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "dry_run.hh"
#include "task.hh"
#include "task_text.hh"

namespace {

constexpr int LINES_A_CYCLE = 2000;
constexpr double SAME_PLACE = 1e-6; // machine units

std::string number(double v) {
    char text[40];
    snprintf(text, sizeof text, "%.4f", v == 0 ? 0 : v);
    std::string s = text;
    while (s.back() == '0') s.pop_back();
    if (s.back() == '.') s.pop_back();
    return s;
}

// " X1 Z-3" of the axes of the mask; zero ones only when `all`.
std::string words(const EmcPose &p, int mask, bool all) {
    const double v[] = {p.tran.x, p.tran.y, p.tran.z, p.a, p.b, p.c, p.u, p.v, p.w};
    std::string text;
    for (int i = 0; i < 9; i++)
        if ((mask & (1 << i)) && (all || v[i] != 0)) text += std::string(" ") + "XYZABCUVW"[i] + number(v[i]);
    return text;
}

std::string or_none(const std::string &text) { return text.empty() ? " none" : text; }

bool same_place(const EmcPose &a, const EmcPose &b) {
    const double d[] = {a.tran.x - b.tran.x, a.tran.y - b.tran.y, a.tran.z - b.tran.z, a.a - b.a, a.b - b.b,
                        a.c - b.c,           a.u - b.u,           a.v - b.v,           a.w - b.w};
    for (double x : d)
        if (std::fabs(x) > SAME_PLACE) return false;
    return true;
}

EmcPose less(const EmcPose &p, const EmcPose &q) {
    return {{p.tran.x - q.tran.x, p.tran.y - q.tran.y, p.tran.z - q.tran.z},
            p.a - q.a,
            p.b - q.b,
            p.c - q.c,
            p.u - q.u,
            p.v - q.v,
            p.w - q.w};
}

} // namespace

void Task::forget_restore() {
    restore_ = Restore::none;
    dry_.reset();
    stat_.restore_line = 0;
    stat_.restore_text[0] = 0;
}

int Task::plan_restore(int line) {
    forget_restore();
    if (!may_run()) return -1;
    if (line < 1) {
        operator_error("A start that restores needs a line number from 1 on");
        return -1;
    }
    synch();
    dry_ = std::make_unique<DryRun>(stat_, motion_.limits, canon_settings_);
    std::unique_ptr<Interp> interp = make_interpreter(dry_->canon());
    if (!interp) return -1;
    interp->keep_parameters(false);
    if (int r = interp->init(interp_options()); r > INTERP_MIN_ERROR) {
        operator_error(interp->error_text(r));
        forget_restore();
        return -1;
    }
    if (!dry_->begin(std::move(interp), *canon_, *interp_, program_, line)) {
        operator_error(dry_->error().c_str());
        forget_restore();
        return -1;
    }
    looked_offsets_ = executed_offsets_;
    looked_tool_ = stat_.io.tool.toolInSpindle;
    looked_prepared_ = stat_.io.tool.pocketPrepped;
    restore_ = Restore::looking;
    return 0;
}

// A slice of the dry run.
void Task::look_ahead() {
    switch (dry_->step(LINES_A_CYCLE)) {
    case DryRun::Result::more: return;
    case DryRun::Result::ended:
    case DryRun::Result::failed:
        operator_error(("No start at that line: " + dry_->error()).c_str());
        forget_restore();
        plan_error_ = true;
        return;
    case DryRun::Result::reached: break;
    }
    restore_ = Restore::shown;
    stat_.restore_line = dry_->line();
    const std::string text = restore_text();
    copy_text(stat_.restore_text, text.c_str());
    operator_display(("Line " + std::to_string(dry_->line()) + " waits for your confirmation. " + text)
                         .substr(0, LINELEN - 1)
                         .c_str());
}

std::string Task::restore_text() const {
    const EMC_STAT &then = dry_->stat();
    const int mask = stat_.motion.traj.axis_mask;
    std::string text = "Start at line " + std::to_string(dry_->line()) + " of " + program_ + ":\n";
    auto add = [&](const std::string &line) { text += "- " + line + "\n"; };
    if (dry_->tool() != stat_.io.tool.toolInSpindle)
        add("tool T" + std::to_string(dry_->tool()) + " is changed in for T" +
            std::to_string(stat_.io.tool.toolInSpindle));
    else add("tool T" + std::to_string(dry_->tool()) + " stays");
    if (dry_->prepared() >= 0 && dry_->stat().io.tool.pocketPrepped != looked_prepared_)
        add("tool T" + std::to_string(dry_->prepared()) + " is prepared");
    for (const AnyMessage &m : dry_->tool_table())
        add("the tool table's T" + std::to_string(as<EMC_TOOL_SET_OFFSET>(*m).toolno) + " is set");
    const EmcPose &end = dry_->position(), &here = stat_.motion.traj.position;
    if (same_place(end, here)) add("the machine is in place");
    else {
        const double z = std::max(here.tran.z, dry_->highest_z());
        EmcPose across = end;
        across.tran.z = z;
        add("moves, machine coordinates: up to Z" + number(z) + ", across to" + words(across, mask & ~4, true) +
            ", down to Z" + number(end.tran.z) +
            (dry_->feed() > 0 ? " at feed " + number(dry_->feed() * 60) : " at rapid"));
    }
    for (int i = 0; i < stat_.motion.traj.spindles; i++) {
        const double speed = then.motion.spindle[i].speed;
        add("spindle " + std::to_string(i) +
            (speed == 0 ? " off"
                        : (speed > 0 ? " clockwise " : " counterclockwise ") + number(std::fabs(speed)) + " rpm"));
    }
    add(std::string("coolant") + (then.io.coolant.mist ? " mist" : "") + (then.io.coolant.flood ? " flood" : "") +
        (then.io.coolant.mist || then.io.coolant.flood ? " on" : " off"));
    static const char *systems[] = {"G53", "G54", "G55", "G56", "G57", "G58", "G59", "G59.1", "G59.2", "G59.3"};
    const int index = then.task.g5x_index;
    add(std::string("offsets: ") + systems[index >= 1 && index <= 9 ? index : 0] +
        or_none(words(then.task.g5x_offset, mask, false)) + ", rotation " + number(then.task.rotation_xy) + ", G92" +
        or_none(words(then.task.g92_offset, mask, false)) + ", tool length" +
        or_none(words(then.task.toolOffset, mask, false)));
    int g[ACTIVE_G_CODES];
    double settings[ACTIVE_SETTINGS];
    dry_->interp().active_g_codes(g);
    dry_->interp().active_settings(settings);
    std::string modes = "modes:";
    for (int i = 1; i < ACTIVE_G_CODES; i++)
        if (g[i] >= 0) modes += " G" + std::to_string(g[i] / 10) + (g[i] % 10 ? "." + std::to_string(g[i] % 10) : "");
    add(modes + ", F" + number(settings[1]) + ", S" + number(settings[2]));
    for (const std::string &n : dry_->notes()) add("note: " + n);
    return text + cut_text();
}

// What a run that was cut off had in force, beside what a start here would have.
std::string Task::cut_text() const {
    if (cut_.empty()) return "";
    const bool same = cut_.get("hash") == stat_.program_hash;
    if (!same && cut_.get("program") != program_) return "";
    std::string text =
        "The run that was cut off at line " + cut_.get("line") + " (" + cut_.get("time") + "), beside this start:\n";
    auto compare = [&](bool equal, const std::string &what) {
        text += "- " + (equal ? what + " is the same" : "DIFFERS: " + what + " was changed since") + "\n";
    };
    compare(same, "the program");
    compare(cut_.get("table") == hash_and_name(io_.table()), "the tool table");
    compare(cut_.get("ini") == hash_and_name(ini_file_), "the INI file");
    if (dry_->line() != cut_.line()) {
        text += "- DIFFERS: this is line " + std::to_string(dry_->line()) + "\n";
        return text;
    }
    auto then = std::make_unique<EMC_STAT>(dry_->stat());
    dry_->interp().active_g_codes(then->task.activeGCodes);
    dry_->interp().active_m_codes(then->task.activeMCodes);
    dry_->interp().active_settings(then->task.activeSettings);
    const std::string other = cut_.differences(journal_record(*then, {}));
    const std::string change = cut_.get("change");
    if (change != "?")
        text += "- UNSURE: it was changing to " + change + ": look which tool is in the spindle\n";
    return text + (other.empty() ? "- offsets, rotation, tool, tool length and modes are the same\n" : other) +
           "- the machine stood at " + cut_.get("position") + "\n";
}

int Task::plan_restore_confirm(int line) {
    if (restore_ != Restore::shown || line != stat_.restore_line) {
        operator_error("Nothing is shown for that line that could be confirmed");
        return -1;
    }
    if (!may_run()) {
        forget_restore();
        return -1;
    }
    if (std::memcmp(looked_offsets_.values, executed_offsets_.values, sizeof looked_offsets_.values) != 0 ||
        looked_tool_ != stat_.io.tool.toolInSpindle) {
        operator_error("Offsets or tool changed since the start was shown: have it shown again");
        forget_restore();
        return -1;
    }
    EMC_TASK_STAT &t = stat_.task;
    stop_stepping();
    error_stop_due_ = false;
    running_tag_ = {};
    t.interpState = EMC_TASK_INTERP_READING;
    t.task_paused = 0;
    restore_ = Restore::tool;
    if (dry_->tool() == stat_.io.tool.toolInSpindle) return 0;
    list_.set_level(0);
    const std::string change = "T" + std::to_string(dry_->tool()) + " M6";
    copy_text(t.command, change.c_str());
    return mdi_result(interp_->execute(change.c_str(), 0)); // with the user's own change routine, if there is one
}

// After the tool change: the interpreter that looked ahead takes over, the machine goes to its place.
void Task::restore_step() {
    if (wait_ || mdi_goes_on()) return;
    if (!idle() || stat_.motion.traj.queue > 0 || stat_.motion.status != RCS_DONE || stat_.io.status != RCS_DONE)
        return;
    if (stat_.io.tool.toolInSpindle != dry_->tool()) {
        operator_error(
            ("The tool change did not bring T" + std::to_string(dry_->tool()) + ": the start is given up").c_str());
        command_failed();
        forget_restore();
        stat_.task.interpState = EMC_TASK_INTERP_IDLE;
        return;
    }
    const std::unique_ptr<DryRun> dry = std::move(dry_);
    const int line = dry->line();
    const EmcPose end = dry->position();
    EmcPose here = stat_.motion.traj.position;
    if (canon_->offsets_applied) here = less(here, canon_->offsets);
    const std::vector<AnyMessage> modes = dry->modes(), starts = dry->starts();
    const std::vector<AnyMessage> &table = dry->tool_table();
    interp_->close();
    dry->hand_over(stat_, list_, &canon_, &interp_);
    wire_canon();
    interp_->set_mdi_slice(static_cast<int>(interp_max_len_));
    interp_->get_offsets(read_offsets_.values);
    auto append = [&](const std::vector<AnyMessage> &orders) {
        for (const AnyMessage &m : orders) list_.append(*m, line);
    };
    append(table);
    if (dry->prepared() >= 0 && dry->stat().io.tool.pocketPrepped != stat_.io.tool.pocketPrepped) {
        EMC_TOOL_PREPARE prepare;
        prepare.tool = dry->prepared();
        list_.append(prepare, line);
    }
    const bool travel = !same_place(end, here);
    if (travel) {
        EMC_TRAJ_SET_TERM_COND exact;
        exact.cond = EMCMOT_TERM_COND_EXACT;
        exact.planner_type = -1;
        exact.scurve_peak_scale = -1;
        list_.append(exact, line);
        canon_->approach_above(here, end, std::max(here.tran.z, dry->highest_z()));
    }
    append(starts);
    if (travel) canon_->approach_down(end, dry->feed());
    append(modes);
    forget_restore();
    line_read_ = true;
}
