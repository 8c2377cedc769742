/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * printer.hh - the canon of rs274: calls as text, and a simple model of a machine.
 *
 * Thread: [task]
 * Source: canonical sheet, sections 2 and 4
 */
#ifndef KERF_PRINTER_HH
#define KERF_PRINTER_HH

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "canon.hh"

class CanonPrinter : public Canon
{
  public:
    CanonPrinter();
    ~CanonPrinter() override;

    /// Where the text goes; the stream stays the caller's.
    void set_output(FILE *f);
    void flush();
    /// Raw text of the line being read, for the N field.
    void set_line_text(const char *text) { line_text = text; }
    void set_machine_units(double units_per_mm) { machine_units = units_per_mm; }
    void set_parameter_file(const std::string &name) { parameter_file = name; }

    void INIT_CANON() override {}
    void SET_G5X_OFFSET(int index, const EmcPose &offset) override;
    void SET_G92_OFFSET(const EmcPose &offset) override;
    void SET_XY_ROTATION(double degrees) override;
    void USE_LENGTH_UNITS(CANON_UNITS units) override;
    void SELECT_PLANE(CANON_PLANE plane) override;
    void SET_FEED_REFERENCE(CANON_FEED_REFERENCE reference) override;
    void SET_FEED_MODE(int spindle, int mode) override;
    void SET_FEED_RATE(double rate) override;
    void SET_TRAVERSE_RATE(double rate) override;
    void SET_MOTION_CONTROL_MODE(CANON_MOTION_MODE mode, double tolerance, int planner_type,
                                 double scurve_peak_scale) override;
    void SET_NAIVECAM_TOLERANCE(double tolerance) override;
    void USE_TOOL_LENGTH_OFFSET(const EmcPose &offset) override;
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
    void TURN_PROBE_ON() override { call("TURN_PROBE_ON()"); }
    void TURN_PROBE_OFF() override { call("TURN_PROBE_OFF()"); }
    void DWELL(double seconds) override;
    void START_SPEED_FEED_SYNCH(int spindle, double feed_per_revolution, bool velocity_mode) override;
    void STOP_SPEED_FEED_SYNCH() override { call("STOP_SPEED_FEED_SYNCH()"); }
    void SET_SPINDLE_MODE(int spindle, double css_max) override;
    void SET_SPINDLE_SPEED(int spindle, double speed) override;
    void START_SPINDLE_CLOCKWISE(int spindle, int wait_for_atspeed) override;
    void START_SPINDLE_COUNTERCLOCKWISE(int spindle, int wait_for_atspeed) override;
    void STOP_SPINDLE_TURNING(int spindle, int wait_for_atspeed) override;
    void ORIENT_SPINDLE(int spindle, double degrees, int direction) override;
    void WAIT_SPINDLE_ORIENT_COMPLETE(int spindle, double timeout_s) override;
    void SPINDLE_RETRACT_TRAVERSE() override { call("SPINDLE_RETRACT_TRAVERSE()"); }
    void SPINDLE_RETRACT() override { call("SPINDLE_RETRACT()"); }
    void USE_NO_SPINDLE_FORCE() override { call("USE_NO_SPINDLE_FORCE()"); }
    void SET_TOOL_TABLE_ENTRY(int idx, int toolno, const EmcPose &offset, double diameter, double frontangle,
                              double backangle, int orientation) override;
    void SELECT_TOOL(int toolno) override;
    void CHANGE_TOOL() override;
    void CHANGE_TOOL_NUMBER(int idx) override;
    void RELOAD_TOOLDATA() override { call("RELOAD_TOOLDATA()"); }
    void CLAMP_AXIS(CANON_AXIS axis) override;
    void UNCLAMP_AXIS(CANON_AXIS axis) override;
    void PALLET_SHUTTLE() override { call("PALLET_SHUTTLE()"); }
    void COMMENT(const char *text) override { quoted("COMMENT", text); }
    void MESSAGE(const char *text) override { quoted("MESSAGE", text); }
    void LOG(const char *text) override { quoted("LOG", text); }
    void LOGOPEN(const char *name) override { quoted("LOGOPEN", name); }
    void LOGAPPEND(const char *name) override { quoted("LOGAPPEND", name); }
    void LOGCLOSE() override { call("LOGCLOSE()"); }
    void CANON_ERROR(const char *text) override;
    void DISABLE_ADAPTIVE_FEED() override { call("DISABLE_ADAPTIVE_FEED()"); }
    void ENABLE_ADAPTIVE_FEED() override { call("ENABLE_ADAPTIVE_FEED()"); }
    void DISABLE_FEED_OVERRIDE() override;
    void ENABLE_FEED_OVERRIDE() override;
    void DISABLE_SPEED_OVERRIDE(int spindle) override;
    void ENABLE_SPEED_OVERRIDE(int spindle) override;
    void DISABLE_FEED_HOLD() override { call("DISABLE_FEED_HOLD()"); }
    void ENABLE_FEED_HOLD() override { call("ENABLE_FEED_HOLD()"); }
    void FLOOD_ON() override { flood = true, call("FLOOD_ON()"); }
    void FLOOD_OFF() override { flood = false, call("FLOOD_OFF()"); }
    void MIST_ON() override { mist = true, call("MIST_ON()"); }
    void MIST_OFF() override { mist = false, call("MIST_OFF()"); }
    void SET_MOTION_OUTPUT_BIT(int index) override { indexed("SET_MOTION_OUTPUT_BIT", index); }
    void CLEAR_MOTION_OUTPUT_BIT(int index) override { indexed("CLEAR_MOTION_OUTPUT_BIT", index); }
    void SET_AUX_OUTPUT_BIT(int index) override { indexed("SET_AUX_OUTPUT_BIT", index); }
    void CLEAR_AUX_OUTPUT_BIT(int index) override { indexed("CLEAR_AUX_OUTPUT_BIT", index); }
    void SET_MOTION_OUTPUT_VALUE(int index, double value) override;
    void SET_AUX_OUTPUT_VALUE(int index, double value) override;
    void SET_BLOCK_DELETE(bool on) override { block_delete = on; }
    bool GET_BLOCK_DELETE() override { return block_delete; }
    void SET_OPTIONAL_PROGRAM_STOP(bool on) override { optional_stop = on; }
    bool GET_OPTIONAL_PROGRAM_STOP() override { return optional_stop; }
    void OPTIONAL_PROGRAM_STOP() override { call("OPTIONAL_PROGRAM_STOP()"); }
    void PROGRAM_STOP() override { call("PROGRAM_STOP()"); }
    void PROGRAM_END() override { call("PROGRAM_END()"); }
    void FINISH() override { call("FINISH()"); }
    void ON_RESET() override { call("ON_RESET()"); }
    void print_line(const char *text) override;
    void flush_output() override
    {
        direct = true; // from now on its lines and ours alternate
        flush();
    }
    void operator_error(const char *text) override
    {
        flush();
        Canon::operator_error(text);
    }

    double GET_EXTERNAL_FEED_RATE() override { return feed_rate; }
    bool GET_EXTERNAL_FLOOD() override { return flood; }
    bool GET_EXTERNAL_MIST() override { return mist; }
    CANON_UNITS GET_EXTERNAL_LENGTH_UNIT_TYPE() override { return units; }
    double GET_EXTERNAL_LENGTH_UNITS() override { return machine_units; }
    CANON_MOTION_MODE GET_EXTERNAL_MOTION_CONTROL_MODE() override { return control_mode; }
    double GET_EXTERNAL_MOTION_CONTROL_TOLERANCE() override { return tolerance; }
    double GET_EXTERNAL_MOTION_CONTROL_NAIVECAM_TOLERANCE() override { return naive_tolerance; }
    std::string GET_EXTERNAL_PARAMETER_FILE_NAME() override { return parameter_file; }
    void SET_PARAMETER_FILE_NAME(const char *name) override { parameter_file = name; }
    CANON_PLANE GET_EXTERNAL_PLANE() override { return plane; }
    EmcPose GET_EXTERNAL_POSITION() override { return position; }
    EmcPose GET_EXTERNAL_PROBE_POSITION() override { return probe; }
    double GET_EXTERNAL_PROBE_VALUE() override { return 1.0; }
    double GET_EXTERNAL_SPEED(int spindle) override { return speed[spindle]; }
    CANON_DIRECTION GET_EXTERNAL_SPINDLE(int spindle) override { return turning[spindle]; }
    EmcPose GET_EXTERNAL_TOOL_LENGTH_OFFSET() override { return tool_offset; }
    int GET_EXTERNAL_TOOL_SLOT() override { return active_slot; }
    int GET_EXTERNAL_SELECTED_TOOL_SLOT() override { return 0; }
    CANON_TOOL_TABLE GET_EXTERNAL_TOOL_TABLE(int idx) override;
    int GET_EXTERNAL_TOOL_TABLE_LAST() override { return tooldata_last_index_get(); }
    bool GET_EXTERNAL_FEED_OVERRIDE_ENABLE() override { return feed_override; }
    bool GET_EXTERNAL_SPINDLE_OVERRIDE_ENABLE(int spindle) override { return speed_override[spindle]; }

  private:
    struct Line;
    void begin(Line &l);
    void call(const char *text);
    void quoted(const char *name, const char *text);
    void indexed(const char *name, int index);
    void formatted(const char *format, ...) __attribute__((format(printf, 2, 3)));
    void motion(const char *name, size_t length, const EmcPose &end);
    char *reserve(size_t size);

    FILE *out = stdout;
    const char *line_text = nullptr; // stays at its address, its text changes
    std::vector<char> buffer;
    size_t used = 0;
    bool direct = false; // every line at once
    long number = 0; // of the last line printed

    // the machine
    EmcPose position{}, probe{}, g5x{}, g92{}, tool_offset{};
    CANON_UNITS units = CANON_UNITS_MM;
    double machine_units = 0.03937007874016;
    CANON_PLANE plane = CANON_PLANE_XY;
    CANON_MOTION_MODE control_mode = CANON_CONTINUOUS;
    double tolerance = 0, naive_tolerance = 0;
    double feed_rate = 0;
    double speed[CANON_MAX_SPINDLES] = {};
    CANON_DIRECTION turning[CANON_MAX_SPINDLES];
    bool speed_override[CANON_MAX_SPINDLES];
    bool feed_override = true, flood = false, mist = false;
    int active_slot = 1, selected_tool = 0;
    bool block_delete = true, optional_stop = true;
    std::string parameter_file;
};

#endif
