// SPDX-License-Identifier: GPL-2.0-or-later
//
// accept.hh - which command is taken in which situation. [any] Source: task sheet, section 4.
#ifndef KERF_ACCEPT_HH
#define KERF_ACCEPT_HH

#include <vector>

#include "messages.hh"

// Machine not on, or on in a mode; AUTO is told apart by the interpreter's state.
enum class Situation { off, manual, auto_idle, auto_reading, auto_paused, auto_waiting, mdi };
constexpr int SITUATIONS = 7;

enum class Answer : char {
    yes = 'y',    // done at once
    no = 'n',     // refused, the operator is told
    queue = 'q',  // put into the list, followed by a synchronisation
    ignore = 'i', // nothing happens and nobody is told
    manual = 'm'  // machine off: yes in manual mode, else ignore
};

// One row of the table: a message and its answer in each situation, in the order above.
struct AcceptRow {
    NMLTYPE type;
    char answers[SITUATIONS + 1];
};

const std::vector<AcceptRow> &accept_table();
Answer accept(NMLTYPE type, Situation s); // what is not in the table is refused everywhere

Situation situation(const EMC_TASK_STAT &task);

// The first field of a command whose number is infinite or none at all; nullptr when all are numbers.
const char *field_without_number(const NMLmsg &command);

#endif
