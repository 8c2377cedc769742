// SPDX-License-Identifier: GPL-2.0-or-later
//
// journal.cc - see journal.hh.
#include "journal.hh"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <ctime>
#include <fstream>
#include <sstream>

namespace {

constexpr int64_t EVERY_NS = 500'000'000; // wall time: it is for people, and for a power cut

int64_t wall_ns() {
    timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return t.tv_sec * 1'000'000'000LL + t.tv_nsec;
}

std::string words(const EmcPose &p, int mask) {
    const double v[] = {p.tran.x, p.tran.y, p.tran.z, p.a, p.b, p.c, p.u, p.v, p.w};
    std::string text;
    for (int i = 0; i < 9; i++) {
        if (!(mask & (1 << i))) continue;
        char word[40];
        snprintf(word, sizeof word, " %c%.6f", "XYZABCUVW"[i], v[i] == 0 ? 0 : v[i]);
        text += word;
    }
    return text;
}

std::string codes(const int *c, int count, char letter) {
    std::string text;
    for (int i = 1; i < count; i++) { // the first is a sequence number
        if (c[i] < 0) continue;
        char word[20];
        if (letter == 'M') snprintf(word, sizeof word, " M%d", c[i]);
        else snprintf(word, sizeof word, " G%g", c[i] / 10.0);
        text += word;
    }
    return text;
}

std::string describe(const EMC_STAT &s, const std::string &program) {
    const EMC_TASK_STAT &t = s.task;
    const int mask = s.motion.traj.axis_mask;
    char now[40] = "";
    const time_t seconds = time(nullptr);
    tm parts;
    if (localtime_r(&seconds, &parts)) strftime(now, sizeof now, "%Y-%m-%d %H:%M:%S", &parts);
    char line[120];
    std::string text = "program " + program + "\n";
    text += "line " + std::to_string(t.motionLine > 0 ? t.motionLine : t.currentLine) + "\n";
    text += std::string("time ") + now + "\n";
    text += "position" + words(s.motion.traj.actualPosition, mask) + "\n";
    text += "system " + std::to_string(t.g5x_index) + words(t.g5x_offset, mask) + "\n";
    text += "g92" + words(t.g92_offset, mask) + "\n";
    snprintf(line, sizeof line, "rotation %.6f\n", t.rotation_xy);
    text += line;
    text += "tool T" + std::to_string(s.io.tool.toolInSpindle) + words(t.toolOffset, mask) + "\n";
    text += "codes" + codes(t.activeGCodes, EMC_ACTIVE_G_CODES, 'G') + codes(t.activeMCodes, EMC_ACTIVE_M_CODES, 'M') +
            "\n";
    snprintf(line, sizeof line, "settings F%.6f S%.6f\n", t.activeSettings[1], t.activeSettings[2]);
    text += line;
    for (int i = 0; i < s.motion.traj.spindles; i++) {
        snprintf(line, sizeof line, "spindle %d %.6f\n", i, s.motion.spindle[i].speed);
        text += line;
    }
    text += std::string("coolant mist ") + (s.io.coolant.mist ? "on" : "off") + " flood " +
            (s.io.coolant.flood ? "on" : "off") + "\n";
    return text;
}

} // namespace

Journal::~Journal() {
    {
        std::lock_guard<std::mutex> hold(lock_);
        end_ = true;
    }
    news_.notify_one();
    if (writer_.joinable()) writer_.join();
}

std::string Journal::open(const std::string &file) {
    file_ = file;
    if (file_.empty()) return "";
    std::ifstream in(file_);
    std::stringstream left;
    left << in.rdbuf();
    return left.str();
}

void Journal::update(const EMC_STAT &stat, const std::string &program, bool running) {
    if (file_.empty()) return;
    if (!running) {
        if (running_) put("");
        running_ = false;
        return;
    }
    const int64_t now = wall_ns();
    if (running_ && now < last_ns_ + EVERY_NS) return;
    running_ = true;
    last_ns_ = now;
    put(describe(stat, program));
}

void Journal::put(const std::string &text) {
    {
        std::lock_guard<std::mutex> hold(lock_);
        text_ = text;
        fresh_ = true;
    }
    if (!writer_.joinable()) writer_ = std::thread([this] { write_behind(); });
    news_.notify_one();
}

void Journal::write_behind() {
    const std::string next = file_ + ".new";
    std::unique_lock<std::mutex> hold(lock_);
    for (;;) {
        news_.wait(hold, [this] { return fresh_ || end_; });
        if (!fresh_) return;
        fresh_ = false;
        const std::string text = text_;
        hold.unlock();
        if (text.empty()) {
            unlink(file_.c_str());
        } else if (int fd = ::open(next.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644); fd >= 0) {
            const bool good =
                write(fd, text.data(), text.size()) == static_cast<ssize_t>(text.size()) && fdatasync(fd) == 0;
            close(fd);
            if (good) rename(next.c_str(), file_.c_str());
            else unlink(next.c_str());
        }
        hold.lock();
    }
}
