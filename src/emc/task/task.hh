// SPDX-License-Identifier: GPL-2.0-or-later
//
// task.hh - the task controller: takes the operator's commands, runs programs, gives motion
// and I/O their orders one after another, publishes the status.
//
// In:     commands (NML), canonical messages of the interpreter, motion and HAL status
// Out:    motion commands, I/O, status and operator messages (NML)
// Thread: [task], one loop: see Task::cycle
// Source: task sheet
#ifndef KERF_TASK_HH
#define KERF_TASK_HH

#include <deque>
#include <memory>
#include <string>

#include "accept.hh"
#include "control.hh"
#include "dry_run.hh"
#include "fault_stop.hh"
#include "ini_settings.hh"
#include "interp.hh"
#include "interp_list.hh"
#include "io_control.hh"
#include "jog_owners.hh"
#include "journal.hh"
#include "motion_link.hh"
#include "offsets_now.hh"
#include "program_copy.hh"
#include "task_canon.hh"
#include "user_codes.hh"

class Task {
public:
    explicit Task(std::string ini_file);
    ~Task();

    // Everything up to the first cycle; false with a message, or when `*stop` is set.
    bool start(const volatile int *stop);
    // Cycles until `*stop` is set (by a signal handler).
    void run(const volatile int *stop);
    void shutdown();

private:
    // ---- the phases of a cycle ----
    void cycle();
    void read_command();
    void plan();
    void execute();
    void update_motion();
    void watch_enable();
    void watch_stalls();
    void watch_estop();
    void watch_errors();
    void watch_fault_stop();
    void watch_program_error();
    void watch_jogs();
    void watch_control();
    void publish();
    void open_journal();
    bool connect_channels();
    std::unique_ptr<Interp> make_interpreter(TaskCanon &canon);
    InterpOptions interp_options() const;
    void wire_canon();

    // ---- plan ----
    int refuse(const NMLmsg &m, Situation s);
    int refuse_stranger(const NMLmsg &m);
    int refuse_number(const NMLmsg &m, const char *field);
    int take_control(const char *name);
    int do_command(const NMLmsg &m); // immediate
    int set_mode(int mode);
    bool hands_at_the_spindle();
    void switched_by_hand(int spindle, int dir);
    int set_state(int state);
    int plan_open(const EMC_TASK_PLAN_OPEN &m);
    int copy_program(size_t bytes);
    int open_failed(const std::string &name, int code);
    void watch_copies();
    int plan_close();
    bool may_run();
    int plan_run(int line);
    int plan_step();
    int plan_pause();
    int plan_resume();
    int plan_init();
    int plan_execute(const char *text);
    void read_ahead();
    bool skip_line();
    void finish_program();
    void mdi_cycle();
    int mdi_cancel(int serial);
    int mdi_run(const char *text);
    int mdi_result(int r);
    bool mdi_goes_on();
    // ---- start at a line with all restored (task_restore.cc) ----
    int plan_restore(int line);
    int plan_restore_confirm(int line);
    void look_ahead();
    std::string restore_text() const;
    std::string cut_text() const;
    void restore_step();
    void forget_restore();

    void interp_failed(int code, bool executing);
    const char *tell_fault(int code); // the interpreter's last, to the operator and in the status; its text
    void forget_fault();
    void failed_at(int line);         // of the program: where an order or a move failed
    void wait_and_synch();

    // ---- execute ----
    int issue(const NMLmsg &m);
    int precondition(const NMLmsg &m) const;
    bool changes_nothing(const NMLmsg &m) const;
    int postcondition(const NMLmsg &m) const;
    bool step_holds();
    void take_next();
    void issue_pending();
    void wait_for(bool motion, bool io);
    void wait_delay();
    void wait_system_command();
    int user_code_failed(); // -1
    void wait_orient();
    void recover();
    void set_exec(int state);
    bool input_reached();

    // ---- stopping ----
    void abort_task();
    void all_spindles_off();
    void spindles_off_after_fault();
    bool leave_limit_switch();
    int override_limits(int joint);
    int joint_on_switch() const; // -1: none
    void on_abort(int reason, const char *text = "");
    void clear_program();
    void stop_stepping();
    void synch();
    void synch_later();

    // ---- messages to the operator; printed too ----
    int operator_message(const NMLmsg &m, EmcMessageSource source = EMC_SOURCE_TASK);
    void send_messages();
    void log_message(const NMLmsg &m, EmcMessageSource source);
    void operator_error(const char *text);
    void operator_text(const char *text);
    void operator_display(const char *text);

    bool all_homed() const;
    bool orders_left() const; // in the list, or waiting for their turn
    bool idle() const; // nothing in the list, nothing pending, nothing being waited for
    template <class T> const T &as(const NMLmsg &m) const { return static_cast<const T &>(m); }

    std::string ini_file_;
    linuxcnc::IniFile ini_;
    EMC_STAT stat_;
    InterpList list_;
    MotionLink motion_;
    IoControl io_;
    Settings settings_;
    IniPins ini_pins_;
    CanonSettings canon_settings_;
    std::unique_ptr<TaskCanon> canon_;
    std::unique_ptr<Interp> interp_;
    UserCodes user_codes_;
    Child child_;
    std::unique_ptr<NML> command_channel_, status_channel_, error_channel_;
    std::unique_ptr<NML> log_channel_; // null: the .nml file has none
    EMC_MESSAGE_LOG log_;

    std::deque<AnyMessage> messages_; // to the operator, not yet sent
    AnyMessage command_;         // the last one read
    int command_serial_ = 0;
    int command_writer_ = 0;     // process
    JogOwners jog_owners_;
    Journal journal_;
    JournalRecord cut_;          // of the run that was cut off, until another one begins
    int order_line_ = 0;         // line of the main program that the last order belongs to
    int main_line_ = 0;          // ... that is under way
    int64_t jogs_looked_at_ = 0;
    bool plan_error_ = false, execute_error_ = false;
    Control control_;
    bool refused_stranger_ = false; // the last command: of a program that has no control
    bool control_error_ = false;    // the last command of the one that has control has failed
    void command_failed();          // ... in its execution
    InterpList::Entry pending_;  // taken from the list, not yet issued
    bool wait_ = false;          // a queue buster: no reading until all is done
    bool synching_ = false;
    state_tag_t running_tag_{};  // of the last move of the program that was made
    std::string told_trouble_;   // with the parameter file
    OffsetsNow read_offsets_, executed_offsets_; // as read ahead, as in force
    void note_offsets();
    void forget_offsets();
    int requested_mode_ = EMC_TASK_MODE_MANUAL;
    int remembered_interp_ = EMC_TASK_INTERP_IDLE; // what PAUSE interrupted
    int start_line_ = 0;
    bool stepping_ = false, step_given_ = false;
    int step_line_ = 0;
    int64_t chain_due_ = 0;      // ns: when the emergency stop chain should be closed after a reset; 0 no matter
    bool was_on_ = false, was_enabled_ = false;
    unsigned stalls_ = 0; // that the operator was told of
    bool eager_ = false;
    int64_t delay_until_ = 0;    // ns
    bool input_watched_ = false, input_armed_ = false;
    EMC_AUX_INPUT_WAIT input_;
    int64_t orient_until_ = 0;
    FaultStop fault_stop_;
    bool error_stop_due_ = false; // a program ended by an error: its outputs are still on
    int64_t error_stop_at_ = 0;
    std::string program_;        // opened last
    std::shared_ptr<ngc::ProgramCopies> copies_ = std::make_shared<ngc::ProgramCopies>(); // what is executed
    std::shared_ptr<ngc::ProgramCopy> opening_; // a long program is being copied, some of it each cycle
    int64_t copies_looked_at_ = 0;
    // Start at a line: what was asked, and how things stood then.
    enum class Restore { none, looking, shown, tool } restore_ = Restore::none;
    std::unique_ptr<DryRun> dry_;
    OffsetsNow looked_offsets_;
    int looked_tool_ = 0, looked_prepared_ = -1;
    bool line_read_ = false;         // the interpreter has read a line that is to be executed
    bool run_from_line_restores_ = false;
    // MDI
    struct MdiLine { int serial; std::string text; }; // the command that brought it
    std::deque<MdiLine> mdi_queue_;
    size_t mdi_queue_max_ = SIZE_MAX; // lines that may wait
    void show_mdi_queue();
    bool mdi_continue_ = false;  // a called subroutine has more to do
    bool mdi_sliced_ = false;    // ... and does not wait for the machine
    // upload of a program
    std::string upload_name_;
    int upload_fd_ = -1;
    size_t upload_done_ = 0;

    double cycle_time_ = 0.1;
    size_t interp_max_len_ = 1000;
    std::string io_error_ = "toolchanger error %d";
    unsigned debug_ = 0;
    bool soft_fault_shown_ = false;
    int last_motion_id_ = 0;
    int64_t motion_id_since_ = 0;
    unsigned long cycles_ = 0;
};

#endif
