// SPDX-License-Identifier: GPL-2.0-or-later
//
// journal.cc - see journal.hh.
#include "journal.hh"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <sstream>

#include "program_copy.hh"
#include "replace_file.hh"

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

// The file of a move that is not in the main program.
std::string called_file(const EMC_STAT &s, const std::string &program) {
    return s.task.callLevel > 0 && program != s.task.file ? std::string(" of ") + s.task.file : "";
}

} // namespace

JournalRecord journal_record(const EMC_STAT &s, const JournalPlace &place) {
    const EMC_TASK_STAT &t = s.task;
    const int mask = s.motion.traj.axis_mask;
    char now[40] = "";
    const time_t seconds = time(nullptr);
    tm parts;
    if (localtime_r(&seconds, &parts)) strftime(now, sizeof now, "%Y-%m-%d %H:%M:%S", &parts);
    char line[120];
    std::string text = "program " + place.program + "\n";
    text += "hash " + place.hash + "\n";
    text += "line " + std::to_string(place.line) + "\n";
    if (t.callLevel > 0)
        text += "called line " + std::to_string(t.motionLine) + called_file(s, place.program) + ", call depth " +
                std::to_string(t.callLevel) + "\n";
    text += std::string("time ") + now + "\n";
    text += "position" + words(s.motion.traj.actualPosition, mask) + "\n";
    text += "system " + std::to_string(t.g5x_index) + words(t.g5x_offset, mask) + "\n";
    text += "g92" + words(t.g92_offset, mask) + "\n";
    snprintf(line, sizeof line, "rotation %.6f\n", t.rotation_xy);
    text += line;
    text += "tool T" + std::to_string(s.io.tool.toolInSpindle) + words(t.toolOffset, mask) + "\n";
    if (place.changing_to >= 0) text += "change T" + std::to_string(place.changing_to) + "\n";
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
    return JournalRecord(text);
}

std::string hash_and_name(const std::string &file) {
    const std::shared_ptr<ngc::ProgramCopy> copy = file.empty() ? nullptr : ngc::ProgramCopy::of(file);
    return (copy ? copy->hash() : "-") + " " + file;
}

std::string JournalRecord::get(const std::string &word) const {
    const size_t at = ("\n" + text_).find("\n" + word + " ");
    if (at == std::string::npos) return "?";
    const size_t from = at + word.size() + 1;
    return text_.substr(from, text_.find('\n', from) - from);
}

bool JournalRecord::whole() const {
    const std::string number = get("line");
    return get("program") != "?" && text_.back() == '\n' && !number.empty() && number.size() < 10 &&
           number.find_first_not_of("0123456789") == std::string::npos;
}

int JournalRecord::line() const { return atoi(get("line").c_str()); }

// Codes without those of a line itself: how it moves (the first one), and G92, which has an item of its own.
static std::string lasting(const std::string &codes) {
    std::istringstream words(codes);
    std::string text, word;
    words >> word;
    while (words >> word)
        if (word.compare(0, 3, "G92") != 0) text += (text.empty() ? "" : " ") + word;
    return text;
}

std::string JournalRecord::differences(const JournalRecord &now) const {
    static const struct {
        const char *word, *name;
    } items[] = {{"system", "work offsets were"}, {"g92", "G92 was"},    {"rotation", "rotation was"},
                 {"tool", "tool was"},            {"codes", "modes were"}};
    std::string text;
    for (const auto &item : items) {
        std::string was = get(item.word), is = now.get(item.word);
        if (item.word == std::string("codes"))
            for (std::string *codes : {&was, &is}) *codes = lasting(*codes);
        if (was != is && was != "?")
            text += std::string("- DIFFERS: ") + item.name + " " + was + ", would be " + is + "\n";
    }
    return text;
}

Journal::~Journal() {
    {
        std::lock_guard<std::mutex> hold(lock_);
        end_ = true;
    }
    news_.notify_one();
    if (writer_.joinable()) writer_.join();
}

static JournalRecord read_record(const std::string &file) {
    std::ifstream in(file);
    std::stringstream text;
    text << in.rdbuf();
    return JournalRecord(text.str());
}

JournalRecord Journal::open(const std::string &file, const Files &files, std::string *trouble) {
    file_ = file;
    files_ = files;
    if (file_.empty() || access(file_.c_str(), F_OK) != 0) return {};
    const JournalRecord left = read_record(file_);
    if (left.whole()) return left;
    const JournalRecord before = read_record(file_ + ".bak");
    *trouble = "The journal of a run that was cut off is damaged: " + file_ +
               (before.whole() ? ". The one before is used: " + file_ + ".bak" : "");
    return before.whole() ? before : JournalRecord();
}

void Journal::update(const EMC_STAT &stat, const JournalPlace &place, bool running) {
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
    put(journal_record(stat, place).text());
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
    std::unique_lock<std::mutex> hold(lock_);
    for (;;) {
        news_.wait(hold, [this] { return fresh_ || end_; });
        if (!fresh_) return;
        fresh_ = false;
        std::string text = text_;
        hold.unlock();
        if (text.empty()) {
            unlink(file_.c_str());
            unlink((file_ + ".bak").c_str());
        } else {
            text += "table " + hash_and_name(files_.table) + "\nini " + hash_and_name(files_.ini) + "\n";
            linuxcnc::replace_file(file_, text, true);
        }
        hold.lock();
    }
}
