/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * canterp.hh - an interpreter whose programs are the text of canonical calls.
 *
 * In:     a file, or MDI lines, of one call a line, as rs274 prints them: with or without number
 *         and N field; blank lines and lines that begin with ; # or ( are comments
 * Out:    those calls on the Canon. It makes none of its own, so that what rs274 prints prints
 *         itself; only task is told that all offsets are zero at first. Nothing is read from or
 *         written to the parameter file.
 * Thread: [task]
 * Source: canonical sheet, sections 1 and 2; [TASK]INTERPRETER = canterp.so
 */
#ifndef KERF_CANTERP_HH
#define KERF_CANTERP_HH

#include <string>
#include <string_view>
#include <vector>

#include "setup.hh"

namespace canterp
{

/// What is kept between calls, beside the modal state in Setup.
struct State {
    int planner_type = -1; // of SET_PLANNER_MODE, for the SET_MOTION_CONTROL_MODE behind it
    double peak_scale = -1;
    bool synched = false; // moves follow a spindle: they need no feed
};

/// Numbers of one call: lengths in program units, words as the values of their enumeration.
struct Arguments {
    std::vector<double> v;
    std::string text;
    int integer(size_t i) const { return int(v[i]); }
};

struct Call {
    const char *name;
    /// One letter an argument, | between other ways to call it: n number, i integer from 0 on,
    /// z any integer, s spindle, g system 1..9, b 0 or 1, t quoted text, e text as it is; words:
    /// U units, P plane, M control mode, R feed reference, S side, A axis.
    const char *arguments;
    /// INTERP_OK, or INTERP_EXECUTE_FINISH, INTERP_EXIT; an error: *what says which.
    int (*run)(Setup &s, State &state, const Arguments &a, std::string *what);
    /// The call ends nothing that PROGRAM_END has left: it may stand behind it.
    bool trailing = false;
};

/// Null when there is no such call.
const Call *find_call(std::string_view name);
/// All names; "; the nearest one is ..." when one is near to this one, else "".
std::string known_calls();
std::string nearest_call(std::string_view name);

struct Mistake {
    size_t column = 0, length = 0; // from 0, in the line
    std::string what, fix;
};

/// One line; call is null for blank lines and comments.
struct Line {
    const Call *call = nullptr;
    Arguments arguments;
    size_t field = 0; // where the N field, or without one the call, begins
};

/// False: *mistake says why. spindles: how many the machine has.
bool parse(std::string_view text, int spindles, Line *line, Mistake *mistake);

} // namespace canterp

class Canterp final : public Interp
{
  public:
    explicit Canterp(Canon &canon) : Interp(canon) {}
    using Interp::execute;

    int init(const InterpOptions &options) override;
    int exit() override { return INTERP_OK; }
    int open(const char *filename) override;
    int close() override;
    int read() override;
    int read(const char *line) override;
    int execute() override;
    int restore_from_tag(const state_tag_t &tag) override;
    const char *command() const override { return shown; }

  private:
    int take(std::string_view text);
    int run();
    int wrong(const canterp::Mistake &mistake);
    void close_file();

    canterp::Line line;
    canterp::State state;
    std::string text;   // of the line, as it stands
    bool due = false;   // calls that only FINISH makes sure of
    char shown[1024] = ""; // the line from its N field on; stays at its address
};

#endif
