/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * interp.hh - the RS274/NGC interpreter: G-code in, canonical calls out.
 *
 * In:     a program file or single lines (MDI), an INI file, a parameter file
 * Out:    calls of the Canon given to the constructor
 * Thread: [task]; an Interp is used by one thread at a time. A process may hold
 *         several; they share nothing (the Python plugin, if asked for, is one per process).
 * Source: G-code sheets; stages and files: README.md in this folder
 *
 * An interpreter of another language derives from it and replaces what is virtual
 * (src/emc/canterp); its library has the function makeInterp.
 *
 * Ordinary use: init, open, then read and execute in turn until a result other
 * than INTERP_OK. After INTERP_EXECUTE_FINISH the caller waits until the machine
 * has done all it was told, calls synch(), and goes on reading.
 */
#ifndef KERF_INTERP_HH
#define KERF_INTERP_HH

#include <memory>
#include <string>
#include <vector>

#include "canon.hh"

enum InterpReturn {
    INTERP_OK = 0,
    INTERP_EXIT = 1,           ///< program ended (M2, M30, M99 in main)
    INTERP_EXECUTE_FINISH = 2, ///< wait for the machine, then continue
    INTERP_ENDFILE = 3,        ///< closing % line
    INTERP_FILE_NOT_OPEN = 4,
    INTERP_ERROR = 5, ///< see error_text() and fault()
    INTERP_MIN_ERROR = 3 ///< results above this are errors
};

enum { ACTIVE_G_CODES = 17, ACTIVE_M_CODES = 10, ACTIVE_SETTINGS = 5, INTERP_LINELEN = 255 };

/// A mistake in a program: where, what, and what would be right.
struct Fault {
    std::string file; ///< empty for MDI
    int line = 0;     ///< from 1; MDI: as given by the caller
    int column = 0;   ///< from 1, in `text`; 0: the line as a whole
    int length = 0;   ///< characters of the offending text
    std::string text; ///< source line
    std::string what; ///< the documented message
    std::string fix;  ///< what to do; may be empty
    /// "FILE:LINE:COLUMN: WHAT", the source line, a caret line, the remedy.
    std::string report() const;
};

namespace ngc
{
class ProgramCopies;
}

struct InterpOptions {
    std::string ini_file; ///< empty: no INI, all defaults
    bool task = false;    ///< value of #<_task>
    /// Programs run as they were when opened, and what they call as it was at the first call,
    /// whatever happens on disk. Null: files are read as they are.
    std::shared_ptr<ngc::ProgramCopies> copies;
    /// INI_FILE_NAME of the environment and defaults for the rest
    static InterpOptions from_environment();
};

struct Setup;

class Interp
{
  public:
    explicit Interp(Canon &canon);
    virtual ~Interp();
    Interp(const Interp &) = delete;
    Interp &operator=(const Interp &) = delete;

    // ---- life ---------------------------------------------------------------
    /// Reads INI and parameter file, sets default modes, synchs. May be called again.
    virtual int init(const InterpOptions &options);
    /// Saves the parameters; nothing may be called after it but init and the destructor.
    virtual int exit();
    /// Forgets calls, loops and what is held back; modal state stays.
    int reset();
    /// Re-reads what the machine knows: position, tool, feed, modes; saves the parameters.
    int synch();
    /// Why the parameters could not be saved at the last synch(); empty when they were.
    const std::string &parameter_trouble() const;

    // ---- running --------------------------------------------------------------
    virtual int open(const char *filename);
    virtual int close();
    /// Reads the next line of the open program (or of a called file).
    virtual int read();
    /// Reads one MDI line; sequence number as last set by execute(line, number), else 0.
    virtual int read(const char *line);
    /// Executes what was read.
    virtual int execute();
    /// Reads and executes one MDI line; subs that it calls run until they end or wait.
    /// While call_level() > 0 after INTERP_EXECUTE_FINISH, execute(nullptr) continues.
    int execute(const char *line);
    int execute(const char *line, int sequence_number);
    /// execute(line) gives control back with INTERP_OK after so many lines of called subs; while
    /// mdi_waits(), execute(nullptr) goes on and reset() ends it. 0 (at first): only at the end.
    void set_mdi_slice(int lines);
    /// An MDI line has more to do: it waits for the machine, or its slice is used up.
    bool mdi_waits() const;
    /// M99 in the main program goes back to the start (task) or ends it (elsewhere).
    void set_loop_on_main_m99(bool on);
    /// After an abort: [RS274NGC]ON_ABORT_COMMAND with the reason. INTERP_OK, -1 when there is none.
    int on_abort(int reason, const char *message);
    /// Brings the modal state back to that of the move that was executing.
    virtual int restore_from_tag(const state_tag_t &tag);
    /// Offsets as the machine has them in force, when reading was further ahead: parameters
    /// OFFSETS_FIRST..OFFSETS_LAST and the tool offset, machine units.
    enum { OFFSETS_FIRST = 5161, OFFSETS_LAST = 5390, OFFSETS = OFFSETS_LAST - OFFSETS_FIRST + 1 };
    void get_offsets(double *values) const;
    void restore_offsets(const double *values, const EmcPose &tool_offset);

    /// Becomes like `other` in modes, positions, tools and parameters, after init and before
    /// open. Calls no canon, whose state must be taken over too; writes no parameter file until
    /// keep_parameters(true). For looking ahead in a program.
    void take_state(const Interp &other);
    void keep_parameters(bool on);
    /// The operator switched these by hand while nothing runs: saved states (M70, M73) have it so.
    void spindle_switched(int spindle, CANON_DIRECTION turning); ///< -1: all
    void coolant_switched(bool mist, bool flood);
    /// A stop switched spindles and coolant off: states saved before do not bring them back.
    void outputs_stopped();

    // ---- what is going on -----------------------------------------------------
    /// 0 line, 1 motion, 2 group 0, 3 plane, 4 comp, ...: codes times ten, -1 none
    void active_g_codes(int *codes) const;
    void active_m_codes(int *codes) const;
    void active_settings(double *values) const; ///< line, F, S, path tolerance, naive tolerance
    /// The same three from a move's tag. False: the tag is not valid.
    static bool active_modes(int *g, int *m, double *settings, const state_tag_t &tag);
    void fill_tag(state_tag_t *tag) const;

    int line() const;            ///< last line read
    int sequence_number() const; ///< the same, for messages
    int call_level() const;      ///< 0: main program or MDI
    int main_line() const;       ///< of the main program: line(), or the one that calls
    int remap_level() const;
    virtual const char *command() const;    ///< text of the last line read
    const char *line_text() const { return command(); }
    const char *file() const;       ///< program or sub file being read
    const char *main_file() const;  ///< program that was opened last
    size_t line_length() const;
    int file_open() const;
    const char *file_name(char *buf, size_t size) const;

    // ---- errors ---------------------------------------------------------------
    /// Message of a result code: the saved text for INTERP_ERROR, "" when there is none.
    const char *error_text(int code) const;
    void set_error_text(const char *text);
    const Fault &fault() const;
    /// Names of the stages the last error went through, innermost first; "" at the end.
    const char *stack_name(int index) const;

    // ---- values ---------------------------------------------------------------
    double parameter(int number) const; ///< 1..5601, else 0
    bool set_parameter(int number, double value);
    bool named_parameter(const char *name, double *value);
    void set_log_level(int level);
    std::string parameter_file() const;

    Setup &setup() { return *s; } ///< for the parts of the interpreter, remaps and tests

  private:
    std::unique_ptr<Setup> s;
};

/// Entry of a pluggable interpreter library ([TASK]INTERPRETER, rs274 -p).
typedef Interp *(*makeInterp_t)(Canon &);
/// Where the library of that name is: below lib/linuxcnc, unless the name is a whole path.
std::string interpreter_path(const std::string &library);
/// The built-in interpreter when no library is named; null and *why when it can't be had.
std::unique_ptr<Interp> make_interpreter(const std::string &library, Canon &canon, std::string *why);

#endif
