/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * check_program.hh - everything wrong or suspicious in a program, without a machine.
 *
 * Thread: the caller's; no state outlives the call
 */
#ifndef KERF_CHECK_PROGRAM_HH
#define KERF_CHECK_PROGRAM_HH

#include <string>
#include <vector>

#include "interp.hh"

struct Finding {
    enum Severity { WARNING, ERROR } severity;
    Fault fault; ///< what: the message; fix: the remedy
};

struct CheckOptions {
    InterpOptions interp;           ///< ini_file: limits, axes, tool table, subs
    std::string parameter_file;     ///< read only
    std::string tool_file;          ///< empty: [EMCIO]TOOL_TABLE of the INI; neither: tools are not checked
    double arc_mismatch_mm = 0.005; ///< arcs whose radii differ by more are mentioned
    long max_lines = 20000000;      ///< executed lines before a loop counts as endless
    int max_findings = 1000;
};

/// Runs the program past its errors and reads what did not run. Sorted by file and line.
std::vector<Finding> check_program(const std::string &file, const CheckOptions &options);

std::string findings_as_json(const std::vector<Finding> &findings);

#endif
