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

// What a journal says: lines of a word and its values.
class JournalRecord {
public:
    JournalRecord() = default;
    explicit JournalRecord(std::string text) : text_(std::move(text)) {}
    bool empty() const { return text_.empty(); }
    bool whole() const; // names a program and a line of it
    std::string get(const std::string &word) const; // "?" when it is not there
    int line() const;                               // of the main program; 0 unknown
    const std::string &text() const { return text_; }

    // What differs in `now`, a line for each item of offsets, tool and modes; empty: nothing.
    std::string differences(const JournalRecord &now) const;

private:
    std::string text_;
};

// What is running: the program, the SHA-256 of its text, the line of the main program, the tool that is being changed
// in (0: none, the spindle is emptied; -1: no change is going on).
struct JournalPlace {
    std::string program, hash;
    int line = 0;
    int changing_to = -1;
};
JournalRecord journal_record(const EMC_STAT &stat, const JournalPlace &place);

class Journal {
public:
    Journal() = default;
    ~Journal();
    Journal(const Journal &) = delete;
    Journal &operator=(const Journal &) = delete;

    // The files whose text must be the same when a run is taken up again.
    struct Files {
        std::string table, ini;
    };
    // file: "" for none. Returns what the last run left, empty when it ended in order. trouble: the
    // file is damaged; then the one before it is returned, if there is one.
    JournalRecord open(const std::string &file, const Files &files, std::string *trouble);
    // running: a program is being executed. Afterwards the file goes, however it was ended.
    void update(const EMC_STAT &stat, const JournalPlace &place, bool running);

private:
    void put(const std::string &text); // "": the file goes
    void write_behind();
    std::string file_;
    Files files_;
    bool running_ = false;
    int64_t last_ns_ = 0;
    std::thread writer_;
    std::mutex lock_;
    std::condition_variable news_;
    std::string text_;       // under the lock, as the next two
    bool fresh_ = false, end_ = false;
};

// "SHA-256 FILE" of a file, as in the journal.
std::string hash_and_name(const std::string &file);

#endif
