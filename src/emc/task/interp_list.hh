// SPDX-License-Identifier: GPL-2.0-or-later
//
// interp_list.hh - what the interpreter asked for and task has not done yet: messages in
// program order, each with its source line. [task]
#ifndef KERF_INTERP_LIST_HH
#define KERF_INTERP_LIST_HH

#include <cstring>
#include <deque>
#include <memory>

#include "nml.hh"

// A copy of a message of any class.
class AnyMessage {
public:
    AnyMessage() = default;
    explicit AnyMessage(const NMLmsg &m) : bytes_(new unsigned char[static_cast<size_t>(m.size)]) {
        std::memcpy(bytes_.get(), &m, static_cast<size_t>(m.size));
    }
    explicit operator bool() const { return bytes_ != nullptr; }
    const NMLmsg &operator*() const { return *reinterpret_cast<const NMLmsg *>(bytes_.get()); }
    NMLmsg &operator*() { return *reinterpret_cast<NMLmsg *>(bytes_.get()); }
    NMLTYPE type() const { return bytes_ ? (**this)._type : 0; }
    void reset() { bytes_.reset(); }
private:
    std::unique_ptr<unsigned char[]> bytes_;
};

class InterpList {
public:
    struct Entry {
        int line = 0;
        int level = 0; // of subroutine calls
        int main_line = 0; // of the main program: line, or the one that calls
        AnyMessage message;
    };
    void append(const NMLmsg &m, int line) { entries_.push_back({line, level_, level_ ? main_line_ : line, AnyMessage(m)}); }
    bool empty() const { return entries_.empty(); }
    size_t size() const { return entries_.size(); }
    Entry take() {
        Entry e = std::move(entries_.front());
        entries_.pop_front();
        return e;
    }
    void clear() { entries_.clear(); }
    // Where reading is; main_line: of the call, when the level is not 0.
    void set_level(int level, int main_line = 0) {
        level_ = level;
        main_line_ = main_line;
    }
    // Drops the actions of lines that a run-from-line passes; messages to the operator stay.
    template <class Keep> void drop_unless(Keep keep) {
        std::deque<Entry> kept;
        for (Entry &e : entries_)
            if (keep(e)) kept.push_back(std::move(e));
        entries_.swap(kept);
    }
private:
    std::deque<Entry> entries_;
    int level_ = 0, main_line_ = 0;
};

#endif
