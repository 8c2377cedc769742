// SPDX-License-Identifier: GPL-2.0-or-later
//
// journal.hh - where a running program stands, on disk: what a power cut leaves for the operator.
//
// In:     the status, each cycle
// Out:    a small text file, written anew at least once a second while a program runs, always
//         whole; removed when the program has ended
// Thread: [task]; a thread of its own waits for the disk
#ifndef KERF_JOURNAL_HH
#define KERF_JOURNAL_HH

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "messages.hh"

class Journal {
public:
    Journal() = default;
    ~Journal();
    Journal(const Journal &) = delete;
    Journal &operator=(const Journal &) = delete;

    // file: "" for none. Returns what the last run left, "" when it ended in order.
    std::string open(const std::string &file);
    // running: a program is being executed. Afterwards the file goes, however it was ended.
    void update(const EMC_STAT &stat, const std::string &program, bool running);
private:
    void put(const std::string &text); // "": the file goes
    void write_behind();
    std::string file_;
    bool running_ = false;
    int64_t last_ns_ = 0;
    std::thread writer_;
    std::mutex lock_;
    std::condition_variable news_;
    std::string text_;       // under the lock, as the next two
    bool fresh_ = false, end_ = false;
};

#endif
