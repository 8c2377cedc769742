// SPDX-License-Identifier: GPL-2.0-or-later
//
// task_canon.hh - canonical calls of the interpreter to messages in task's list.
//
// In:     calls of Interp in program units and coordinates
// Out:    messages in machine units and coordinates, in an InterpList
// Units:  inside mm, degrees, seconds; UNIT at the borders: Units below
// Thread: [task]
// Source: canonical sheet, section 7
#ifndef KERF_TASK_CANON_HH
#define KERF_TASK_CANON_HH

#include <array>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "canon.hh"
#include "interp_list.hh"
#include "messages.hh"
#include "motion.h"

// Per-axis limits from the INI file, machine units and seconds. 0 jerk: none given.
struct AxisLimits {
    std::array<double, EMCMOT_MAX_AXIS> velocity{}, acceleration{}, jerk{};
};

// What canon must know of the installation.
struct CanonSettings {
    std::vector<double> tool_change_position; // machine units; 0, 3, 6 or 9 values
    std::string parameter_file;
};

class TaskCanon : public Canon {
public:
    TaskCanon(EMC_STAT &stat, InterpList &list, const AxisLimits &limits, const CanonSettings &settings);
    ~TaskCanon() override;

    // Runs M1nn; set by task: true when the program exists. (num 0..99)
    std::function<bool(int num)> user_code_exists;
    std::function<std::string(int num, double p, double q)> user_code_command;
    std::function<bool(const char *name, double *value)> hal_lookup;
    std::function<int()> source_line; // line for messages that carry none of their own

    bool optional_stop = true, block_delete = true;
    // For looking ahead in a program: as `other` stands, without its files. The tool in the
    // spindle is then the one of the status, not what the changer holds.
    void take_state(const TaskCanon &other);
    // From now on for the machine itself.
    void attach(EMC_STAT &stat, InterpList &list);
    // Moves in machine coordinates from where the machine is: up, across, and (feed in machine
    // units a second, 0 rapid) down to `end`.
    void approach_above(const EmcPose &from, const EmcPose &end, double z);
    void approach_down(const EmcPose &end, double feed);

    bool chain_pending() const { return !chain_.empty(); }
    size_t emitted() const { return emitted_; }

    void INIT_CANON() override;
    void SET_G5X_OFFSET(int index, const EmcPose &offset) override;
    void SET_G92_OFFSET(const EmcPose &offset) override;
    void SET_XY_ROTATION(double degrees) override;
    void USE_LENGTH_UNITS(CANON_UNITS units) override;
    void SELECT_PLANE(CANON_PLANE plane) override { plane_ = plane; }
    void SET_FEED_MODE(int spindle, int mode) override;
    void SET_FEED_RATE(double rate) override;
    void SET_MOTION_CONTROL_MODE(CANON_MOTION_MODE mode, double tolerance, int planner_type,
                                 double scurve_peak_scale) override;
    void SET_NAIVECAM_TOLERANCE(double tolerance) override;
    void USE_TOOL_LENGTH_OFFSET(const EmcPose &offset) override;
    void CANON_UPDATE_END_POINT(const EmcPose &position) override;
    void UPDATE_TAG(const state_tag_t &tag) override { tag_ = tag; }
    bool wants_tags() const override { return true; }

    void STRAIGHT_TRAVERSE(int line, const EmcPose &end) override;
    void STRAIGHT_FEED(int line, const EmcPose &end) override;
    void ARC_FEED(int line, double first_end, double second_end, double first_axis, double second_axis, int rotation,
                  double axis_end_point, const EmcPose &end) override;
    void NURBS_G5_FEED(int line, const std::vector<NURBS_CONTROL_POINT> &points, unsigned order,
                       CANON_PLANE plane) override;
    void NURBS_G6_FEED(int line, const std::vector<NURBS_G6_CONTROL_POINT> &points, unsigned order, double feedrate,
                       int q_option, CANON_PLANE plane) override;
    void RIGID_TAP(int line, double x, double y, double z, double scale) override;
    void STRAIGHT_PROBE(int line, const EmcPose &end, unsigned char type) override;
    void TURN_PROBE_ON() override;
    void DWELL(double seconds) override;
    void START_SPEED_FEED_SYNCH(int spindle, double feed_per_revolution, bool velocity_mode) override;
    void STOP_SPEED_FEED_SYNCH() override;
    int UNLOCK_ROTARY(int line, int joint) override;
    int LOCK_ROTARY(int line, int joint) override;

    void SET_SPINDLE_MODE(int spindle, double css_max) override;
    void SET_SPINDLE_SPEED(int spindle, double speed) override;
    void START_SPINDLE_CLOCKWISE(int spindle, int wait_for_atspeed) override {
        start_spindle(spindle, 1, wait_for_atspeed);
    }
    void START_SPINDLE_COUNTERCLOCKWISE(int spindle, int wait_for_atspeed) override {
        start_spindle(spindle, -1, wait_for_atspeed);
    }
    void STOP_SPINDLE_TURNING(int spindle, int wait_for_atspeed) override;
    void ORIENT_SPINDLE(int spindle, double degrees, int direction) override;
    void WAIT_SPINDLE_ORIENT_COMPLETE(int spindle, double timeout_s) override;

    void SET_TOOL_TABLE_ENTRY(int idx, int toolno, const EmcPose &offset, double diameter, double frontangle,
                              double backangle, int orientation) override;
    void SELECT_TOOL(int toolno) override;
    void CHANGE_TOOL() override;
    void CHANGE_TOOL_NUMBER(int idx) override;
    void RELOAD_TOOLDATA() override;

    void COMMENT(const char *text) override;
    void MESSAGE(const char *text) override;
    void LOG(const char *text) override;
    void LOGOPEN(const char *name) override { open_log(name, "w", "LOGOPEN"); }
    void LOGAPPEND(const char *name) override { open_log(name, "a", "LOGAPPEND"); }
    void LOGCLOSE() override;
    void CANON_ERROR(const char *text) override;
    void DISABLE_ADAPTIVE_FEED() override { adaptive_feed(0); }
    void ENABLE_ADAPTIVE_FEED() override { adaptive_feed(1); }
    void DISABLE_FEED_OVERRIDE() override { feed_override(0); }
    void ENABLE_FEED_OVERRIDE() override { feed_override(1); }
    void DISABLE_SPEED_OVERRIDE(int spindle) override { speed_override(spindle, 0); }
    void ENABLE_SPEED_OVERRIDE(int spindle) override { speed_override(spindle, 1); }
    void DISABLE_FEED_HOLD() override { feed_hold(0); }
    void ENABLE_FEED_HOLD() override { feed_hold(1); }
    void FLOOD_ON() override { plain<EMC_COOLANT_FLOOD_ON>(); }
    void FLOOD_OFF() override { plain<EMC_COOLANT_FLOOD_OFF>(); }
    void MIST_ON() override { plain<EMC_COOLANT_MIST_ON>(); }
    void MIST_OFF() override { plain<EMC_COOLANT_MIST_OFF>(); }
    void SET_MOTION_OUTPUT_BIT(int i) override { output_bit(i, 1, 0); }
    void CLEAR_MOTION_OUTPUT_BIT(int i) override { output_bit(i, 0, 0); }
    void SET_AUX_OUTPUT_BIT(int i) override { output_bit(i, 1, 1); }
    void CLEAR_AUX_OUTPUT_BIT(int i) override { output_bit(i, 0, 1); }
    void SET_MOTION_OUTPUT_VALUE(int i, double v) override { output_value(i, v, 0); }
    void SET_AUX_OUTPUT_VALUE(int i, double v) override { output_value(i, v, 1); }
    int WAIT(int index, CANON_INPUT input, CANON_WAIT wait, double timeout_s) override;
    bool USER_DEFINED_FUNCTION_EXISTS(int num) override {
        return num >= 0 && num < USER_DEFINED_FUNCTION_NUM && user_code_exists && user_code_exists(num);
    }
    void USER_DEFINED_FUNCTION(int num, double p, double q) override;

    void SET_BLOCK_DELETE(bool on) override { block_delete = on; }
    bool GET_BLOCK_DELETE() override { return block_delete; }
    void SET_OPTIONAL_PROGRAM_STOP(bool on) override { optional_stop = on; }
    bool GET_OPTIONAL_PROGRAM_STOP() override { return optional_stop; }
    void OPTIONAL_PROGRAM_STOP() override { plain<EMC_TASK_PLAN_OPTIONAL_STOP>(); }
    void PROGRAM_STOP() override { plain<EMC_TASK_PLAN_PAUSE>(); }
    void PROGRAM_END() override { plain<EMC_TASK_PLAN_END>(); }
    void FINISH() override { flush(); }
    void ON_RESET() override { chain_.clear(); }

    double GET_EXTERNAL_FEED_RATE() override;
    double GET_EXTERNAL_TRAVERSE_RATE() override;
    bool GET_EXTERNAL_FLOOD() override { return stat_->io.coolant.flood != 0; }
    bool GET_EXTERNAL_MIST() override { return stat_->io.coolant.mist != 0; }
    CANON_UNITS GET_EXTERNAL_LENGTH_UNIT_TYPE() override { return units_; }
    double GET_EXTERNAL_LENGTH_UNITS() override;
    double GET_EXTERNAL_ANGLE_UNITS() override;
    CANON_MOTION_MODE GET_EXTERNAL_MOTION_CONTROL_MODE() override { return motion_mode_; }
    double GET_EXTERNAL_MOTION_CONTROL_TOLERANCE() override { return to_program_length(motion_tolerance_); }
    double GET_EXTERNAL_MOTION_CONTROL_NAIVECAM_TOLERANCE() override { return to_program_length(naivecam_tolerance_); }
    std::string GET_EXTERNAL_PARAMETER_FILE_NAME() override { return settings_.parameter_file; }
    CANON_PLANE GET_EXTERNAL_PLANE() override { return plane_; }
    EmcPose GET_EXTERNAL_POSITION() override;
    EmcPose GET_EXTERNAL_PROBE_POSITION() override;
    int GET_EXTERNAL_PROBE_TRIPPED_VALUE() override { return stat_->motion.traj.probe_tripped; }
    bool GET_EXTERNAL_QUEUE_EMPTY() override;
    double GET_EXTERNAL_SPEED(int spindle) override {
        return spindle >= 0 && spindle < EMCMOT_MAX_SPINDLES ? spindle_[spindle].speed : 0;
    }
    CANON_DIRECTION GET_EXTERNAL_SPINDLE(int spindle) override;
    EmcPose GET_EXTERNAL_TOOL_LENGTH_OFFSET() override { return to_program(tool_offset_); }
    int GET_EXTERNAL_TOOL_SLOT() override;
    int GET_EXTERNAL_SELECTED_TOOL_SLOT() override { return stat_->io.tool.pocketPrepped; }
    CANON_TOOL_TABLE GET_EXTERNAL_TOOL_TABLE(int idx) override;
    int GET_EXTERNAL_TOOL_TABLE_LAST() override { return tooldata_last_index_get(); }
    int GET_EXTERNAL_TC_FAULT() override { return stat_->io.fault; }
    int GET_EXTERNAL_TC_REASON() override { return stat_->io.reason; }
    bool GET_EXTERNAL_FEED_OVERRIDE_ENABLE() override { return stat_->motion.traj.feed_override_enabled; }
    bool GET_EXTERNAL_SPINDLE_OVERRIDE_ENABLE(int spindle) override {
        return spindle >= 0 && spindle < EMCMOT_MAX_SPINDLES && stat_->motion.spindle[spindle].spindle_override_enabled;
    }
    bool GET_EXTERNAL_ADAPTIVE_FEED_ENABLE() override { return stat_->motion.traj.adaptive_feed_enabled; }
    bool GET_EXTERNAL_FEED_HOLD_ENABLE() override { return stat_->motion.traj.feed_hold_enabled; }
    int GET_EXTERNAL_DIGITAL_INPUT(int index, int dflt) override;
    double GET_EXTERNAL_ANALOG_INPUT(int index, double dflt) override;
    int GET_EXTERNAL_AXIS_MASK() override { return stat_->motion.traj.axis_mask; }
    bool GET_EXTERNAL_OFFSET_APPLIED() override { return offsets_applied; }
    EmcPose GET_EXTERNAL_OFFSETS() override { return machine_to_internal(offsets); }
    bool hal_value(const char *name, double *value) override { return hal_lookup && hal_lookup(name, value); }

    // A spindle was started (-1, 1) or stopped (0) by other means than the program: what an S
    // word does next follows it. spindle -1: all of them.
    void spindle_is(int spindle, int dir);

    // While it is true S words are kept and give no order: what is restored comes into force at rest, and spindles
    // that somebody has started by then go on.
    bool keeps_speeds = false;

    // G97 for all spindles; one that turns goes on until the next S word.
    void constant_rpm();

    // External axis offsets, copied from motion each cycle (machine units).
    bool offsets_applied = false;
    EmcPose offsets{};

private:
    struct Point { EmcPose pose; int line; state_tag_t tag; };          // chained straight feed, internal units
    struct Path { double value = 0; bool cartesian = false, angular = false; double t = 0; };
    struct Spindle { double speed = 0, css_maximum = 0, css_factor = 0; int dir = 0; bool synched = false; };

    // Units
    double program_factor() const {
        return units_ == CANON_UNITS_INCHES ? 25.4 : units_ == CANON_UNITS_CM ? 10.0 : 1.0;
    }
    double from_program_length(double v) const { return v * program_factor(); }
    double to_program_length(double v) const { return v / program_factor(); }
    double linear_scale() const;  // machine units per mm
    double angular_scale() const; // machine units per degree
    EmcPose from_program(const EmcPose &p) const;
    EmcPose to_program(const EmcPose &p) const;
    EmcPose to_machine(const EmcPose &p) const;
    EmcPose machine_to_internal(const EmcPose &p) const;

    // Frames
    EmcPose to_absolute(const EmcPose &program) const; // program units and frame -> internal, absolute
    EmcPose offset_pose(const EmcPose &internal) const;
    EmcPose to_frame(const EmcPose &absolute) const;   // internal absolute -> program units and frame
    void rotate(double *x, double *y, double degrees) const;

    // Limits of a straight move from end_ to p
    std::array<double, 9> deltas(const EmcPose &p, bool *cartesian, bool *angular) const;
    Path straight_velocity(const EmcPose &p) const;
    Path straight_acceleration(const EmcPose &p) const;
    Path straight_jerk(const EmcPose &p) const;
    Path straight_limit(const EmcPose &p, const std::array<double, 9> &limit, bool cubic) const;
    double axis_limit(const std::array<double, 9> &v, int axis) const; // internal units
    double path_to_machine(const Path &p, double value) const;

    // Emission
    template <class T> void emit(const T &m) { emit_at(m, source_line ? source_line() : 0); }
    template <class T> void emit_at(const T &m, int line) { list_->append(m, line); emitted_++; }
    template <class T> void plain() { flush(); T m; emit(m); }
    void flush();
    bool linkable(const EmcPose &p) const;
    void chain(int line, const EmcPose &p);
    void traverse_to(int line, const EmcPose &p);
    bool beside_the_tap(const EmcPose &end, EmcPose *over) const;
    void machine_move(const EmcPose &machine, double feed);
    void straight_segment(int line, const EmcPose &p, const state_tag_t &tag);
    void arc(int line, double first_end, double second_end, double first_axis, double second_axis, int rotation,
             double axis_end, const EmcPose &end);
    void sync_off_for_move();
    void sync_on_after_move();
    void start_spindle(int spindle, int dir, int wait);
    template <class T> void fill_speed(T *m, int spindle);
    void refresh_css();
    double x_offset() const { return linear_scale() * (g5x_.tran.x + g92_.tran.x + tool_offset_.tran.x); }
    void adaptive_feed(int on);
    void feed_override(int on);
    void speed_override(int spindle, int on);
    void feed_hold(int on);
    void output_bit(int index, int value, int now);
    void output_value(int index, double value, int now);
    void open_log(const char *name, const char *mode, const char *what);
    // Splines
    struct P2 { double x, y; };
    void spline_point(int line, double x, double y);
    void biarc(int line, P2 p0, P2 t0, P2 p4, P2 t4, double r);
    void tangent_arc(int line, P2 from, P2 tangent, P2 to);
    P2 plane_position() const;

    EMC_STAT *stat_;
    InterpList *list_;
    const AxisLimits &limits_;
    const CanonSettings &settings_;
    EmcPose g5x_{}, g92_{}, tool_offset_{}; // internal units
    EmcPose end_{};                         // canonical end point: internal, absolute
    double rotation_ = 0;                   // degrees
    int g5x_index_ = 1;
    CANON_UNITS units_ = CANON_UNITS_MM;
    CANON_PLANE plane_ = CANON_PLANE_XY;
    CANON_MOTION_MODE motion_mode_ = CANON_CONTINUOUS;
    double motion_tolerance_ = 0, naivecam_tolerance_ = 0; // mm
    double linear_feed_ = 0, angular_feed_ = 0;            // mm/s, deg/s; feed mode 1: as given
    int feed_mode_ = 0, feed_spindle_ = 0, sync_spindle_ = 0;
    EMC_TRAJ_SET_SPINDLESYNC sync_; // as last asked for
    int rotary_unlocked_ = -1;
    std::array<Spindle, EMCMOT_MAX_SPINDLES> spindle_{};
    std::vector<Point> chain_;
    state_tag_t tag_{};
    FILE *log_ = nullptr, *probe_log_ = nullptr;
    EmcPose last_probed_{};
    size_t emitted_ = 0;
    bool looking_ahead_ = false; // nothing is done: no files, tools as the status says
};

#endif
