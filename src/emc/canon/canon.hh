/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * canon.hh - the canonical machining functions: what an interpreter asks of a machine.
 *
 * A Canon is given to an Interp and receives its calls in program order. The
 * task's queue, the printer of rs274, the preview and the dry run derive from it.
 *
 * Units:  lengths are program units (G20/G21), angles degrees, rates program units
 *         a minute, or a revolution when the feed mode is 1; exceptions are named.
 *         Positions are in the active coordinate system: G92, rotation, G5x and
 *         tool offset have still to be applied, in this order.
 * Thread: [task]; calls come only from inside Interp's functions.
 * Source: canonical sheet, section 1
 */
#ifndef KERF_CANON_HH
#define KERF_CANON_HH

#include <string>
#include <vector>

#include "emcpos.h"
#include "state_tag.h"
#include "tooldata.h"

enum CANON_PLANE {
    CANON_PLANE_XY = 1,
    CANON_PLANE_YZ,
    CANON_PLANE_XZ,
    CANON_PLANE_UV,
    CANON_PLANE_VW,
    CANON_PLANE_UW
};
enum CANON_UNITS { CANON_UNITS_INCHES = 1, CANON_UNITS_MM, CANON_UNITS_CM };
enum CANON_MOTION_MODE { CANON_EXACT_STOP = 1, CANON_EXACT_PATH, CANON_CONTINUOUS };
enum CANON_SPEED_FEED_MODE { CANON_SYNCHED = 1, CANON_INDEPENDENT };
enum CANON_DIRECTION { CANON_STOPPED = 1, CANON_CLOCKWISE, CANON_COUNTERCLOCKWISE };
enum CANON_FEED_REFERENCE { CANON_WORKPIECE = 1, CANON_XYZ };
enum CANON_SIDE { CANON_SIDE_RIGHT = 1, CANON_SIDE_LEFT, CANON_SIDE_OFF };
enum CANON_AXIS {
    CANON_AXIS_X = 1,
    CANON_AXIS_Y,
    CANON_AXIS_Z,
    CANON_AXIS_A,
    CANON_AXIS_B,
    CANON_AXIS_C,
    CANON_AXIS_U,
    CANON_AXIS_V,
    CANON_AXIS_W
};
enum CANON_INPUT { ANALOG_INPUT = 0, DIGITAL_INPUT = 1 };
/// L of M66
enum CANON_WAIT : int {
    WAIT_MODE_IMMEDIATE = 0,
    WAIT_MODE_RISE,
    WAIT_MODE_FALL,
    WAIT_MODE_HIGH,
    WAIT_MODE_LOW
};

enum { USER_DEFINED_FUNCTION_NUM = 100, CANON_MAX_SPINDLES = 8, PARAMETER_FILE_NAME_LENGTH = 100 };

struct NURBS_CONTROL_POINT { double x, y, w; };   ///< G5 family: plane coordinates and weight
struct NURBS_G6_CONTROL_POINT { double x, y, r, k; }; ///< G6.2: plane coordinates, weight, knot

class Canon
{
  public:
    virtual ~Canon() = default;

    // ---- state --------------------------------------------------------------
    virtual void INIT_CANON() {}
    /// index 1..9 = G54..G59.3
    virtual void SET_G5X_OFFSET(int index, const EmcPose &offset) { (void)index, (void)offset; }
    virtual void SET_G92_OFFSET(const EmcPose &offset) { (void)offset; }
    virtual void SET_XY_ROTATION(double degrees) { (void)degrees; }
    virtual void USE_LENGTH_UNITS(CANON_UNITS units) { (void)units; }
    virtual void SELECT_PLANE(CANON_PLANE plane) { (void)plane; }
    virtual void SET_FEED_REFERENCE(CANON_FEED_REFERENCE reference) { (void)reference; }
    /// mode 0: units a minute, 1: units a revolution of that spindle
    virtual void SET_FEED_MODE(int spindle, int mode) { (void)spindle, (void)mode; }
    virtual void SET_FEED_RATE(double rate) { (void)rate; }
    virtual void SET_TRAVERSE_RATE(double rate) { (void)rate; }
    /// tolerance only for CANON_CONTINUOUS; planner_type and peak_scale < 0: unchanged
    virtual void SET_MOTION_CONTROL_MODE(CANON_MOTION_MODE mode, double tolerance, int planner_type = -1,
                                         double scurve_peak_scale = -1.0)
    {
        (void)mode, (void)tolerance, (void)planner_type, (void)scurve_peak_scale;
    }
    virtual void SET_NAIVECAM_TOLERANCE(double tolerance) { (void)tolerance; }
    virtual void USE_TOOL_LENGTH_OFFSET(const EmcPose &offset) { (void)offset; }
    /// Run from line: forces the end point; only units are converted.
    virtual void CANON_UPDATE_END_POINT(const EmcPose &position) { (void)position; }
    /// Modal state for the motions that follow. Only called when wants_tags().
    virtual void UPDATE_TAG(const state_tag_t &tag) { (void)tag; }
    virtual bool wants_tags() const { return false; }

    // ---- motion; line: source line, -1 for moves that stand in no line ----------
    virtual void STRAIGHT_TRAVERSE(int line, const EmcPose &end) = 0;
    virtual void STRAIGHT_FEED(int line, const EmcPose &end) = 0;
    /// XY: first X second Y; YZ: Y, Z; XZ: first Z second X. rotation > 0: counterclockwise,
    /// |rotation| n: more than n-1, up to n turns. end's plane axes are not used but
    /// hold the same end point.
    virtual void ARC_FEED(int line, double first_end, double second_end, double first_axis, double second_axis,
                          int rotation, double axis_end_point, const EmcPose &end) = 0;
    virtual void NURBS_G5_FEED(int line, const std::vector<NURBS_CONTROL_POINT> &points, unsigned order,
                               CANON_PLANE plane)
    {
        (void)line, (void)points, (void)order, (void)plane;
    }
    /// q_option 1 biarcs, 2 arcs at equal arc length, 3 lines
    virtual void NURBS_G6_FEED(int line, const std::vector<NURBS_G6_CONTROL_POINT> &points, unsigned order,
                               double feedrate, int q_option, CANON_PLANE plane)
    {
        (void)line, (void)points, (void)order, (void)feedrate, (void)q_option, (void)plane;
    }
    virtual void RIGID_TAP(int line, double x, double y, double z, double scale)
    {
        (void)line, (void)x, (void)y, (void)z, (void)scale;
    }
    /// type bit 0: no error when not tripped; bit 1: until contact is lost
    virtual void STRAIGHT_PROBE(int line, const EmcPose &end, unsigned char type) { (void)line, (void)end, (void)type; }
    virtual void TURN_PROBE_ON() {}
    virtual void TURN_PROBE_OFF() {}
    virtual void DWELL(double seconds) { (void)seconds; }
    virtual void START_SPEED_FEED_SYNCH(int spindle, double feed_per_revolution, bool velocity_mode)
    {
        (void)spindle, (void)feed_per_revolution, (void)velocity_mode;
    }
    virtual void STOP_SPEED_FEED_SYNCH() {}
    virtual int UNLOCK_ROTARY(int line, int joint) { return (void)line, (void)joint, 0; }
    virtual int LOCK_ROTARY(int line, int joint) { return (void)line, (void)joint, 0; }

    // ---- spindle --------------------------------------------------------------
    /// css_max 0: constant rpm; else constant surface speed, that many rpm at most
    virtual void SET_SPINDLE_MODE(int spindle, double css_max) { (void)spindle, (void)css_max; }
    virtual void SET_SPINDLE_SPEED(int spindle, double speed) { (void)spindle, (void)speed; }
    virtual void START_SPINDLE_CLOCKWISE(int spindle, int wait_for_atspeed = 1)
    {
        (void)spindle, (void)wait_for_atspeed;
    }
    virtual void START_SPINDLE_COUNTERCLOCKWISE(int spindle, int wait_for_atspeed = 1)
    {
        (void)spindle, (void)wait_for_atspeed;
    }
    virtual void STOP_SPINDLE_TURNING(int spindle, int wait_for_atspeed = 1) { (void)spindle, (void)wait_for_atspeed; }
    /// direction 0 shortest, 1 clockwise, 2 counterclockwise
    virtual void ORIENT_SPINDLE(int spindle, double degrees, int direction)
    {
        (void)spindle, (void)degrees, (void)direction;
    }
    virtual void WAIT_SPINDLE_ORIENT_COMPLETE(int spindle, double timeout_s) { (void)spindle, (void)timeout_s; }
    virtual void SPINDLE_RETRACT_TRAVERSE() {}
    virtual void SPINDLE_RETRACT() {}
    virtual void LOCK_SPINDLE_Z() {}
    virtual void USE_SPINDLE_FORCE() {}
    virtual void USE_NO_SPINDLE_FORCE() {}

    // ---- tools ------------------------------------------------------------------
    /// idx: place in the tool data; offset and diameter in machine units
    virtual void SET_TOOL_TABLE_ENTRY(int idx, int toolno, const EmcPose &offset, double diameter,
                                      double frontangle, double backangle, int orientation)
    {
        (void)idx, (void)toolno, (void)offset, (void)diameter, (void)frontangle, (void)backangle, (void)orientation;
    }
    virtual void SELECT_TOOL(int toolno) { (void)toolno; }
    virtual void CHANGE_TOOL() {}
    virtual void CHANGE_TOOL_NUMBER(int idx) { (void)idx; }
    virtual void RELOAD_TOOLDATA() {}

    // ---- the rest of the machine ----------------------------------------------
    virtual void CLAMP_AXIS(CANON_AXIS axis) { (void)axis; }
    virtual void UNCLAMP_AXIS(CANON_AXIS axis) { (void)axis; }
    virtual void PALLET_SHUTTLE() {}
    virtual void COMMENT(const char *text) { (void)text; }
    virtual void MESSAGE(const char *text) { (void)text; }
    virtual void LOG(const char *text) { (void)text; }
    virtual void LOGOPEN(const char *name) { (void)name; }
    virtual void LOGAPPEND(const char *name) { (void)name; }
    virtual void LOGCLOSE() {}
    virtual void CANON_ERROR(const char *text) { (void)text; }
    virtual void DISABLE_ADAPTIVE_FEED() {}
    virtual void ENABLE_ADAPTIVE_FEED() {}
    virtual void DISABLE_FEED_OVERRIDE() {}
    virtual void ENABLE_FEED_OVERRIDE() {}
    virtual void DISABLE_SPEED_OVERRIDE(int spindle) { (void)spindle; }
    virtual void ENABLE_SPEED_OVERRIDE(int spindle) { (void)spindle; }
    virtual void DISABLE_FEED_HOLD() {}
    virtual void ENABLE_FEED_HOLD() {}
    virtual void FLOOD_ON() {}
    virtual void FLOOD_OFF() {}
    virtual void MIST_ON() {}
    virtual void MIST_OFF() {}
    /// MOTION: with the start of the next motion; AUX: in queue order, at once
    virtual void SET_MOTION_OUTPUT_BIT(int index) { (void)index; }
    virtual void CLEAR_MOTION_OUTPUT_BIT(int index) { (void)index; }
    virtual void SET_AUX_OUTPUT_BIT(int index) { (void)index; }
    virtual void CLEAR_AUX_OUTPUT_BIT(int index) { (void)index; }
    virtual void SET_MOTION_OUTPUT_VALUE(int index, double value) { (void)index, (void)value; }
    virtual void SET_AUX_OUTPUT_VALUE(int index, double value) { (void)index, (void)value; }
    /// -1: no such input
    virtual int WAIT(int index, CANON_INPUT input, CANON_WAIT wait, double timeout_s)
    {
        return (void)index, (void)input, (void)wait, (void)timeout_s, 0;
    }
    /// M100..M199: num 0..99; missing words are -1
    virtual bool USER_DEFINED_FUNCTION_EXISTS(int num) { return (void)num, false; }
    virtual void USER_DEFINED_FUNCTION(int num, double p, double q) { (void)num, (void)p, (void)q; }

    // ---- program --------------------------------------------------------------
    virtual void SET_BLOCK_DELETE(bool on) { (void)on; }
    virtual bool GET_BLOCK_DELETE() { return false; } ///< on: lines that start with / are dropped
    virtual void SET_OPTIONAL_PROGRAM_STOP(bool on) { (void)on; }
    virtual bool GET_OPTIONAL_PROGRAM_STOP() { return true; }
    virtual void OPTIONAL_PROGRAM_STOP() {}
    virtual void PROGRAM_STOP() {}
    virtual void PROGRAM_END() {}
    virtual void FINISH() {}   ///< flush what is held back
    virtual void ON_RESET() {} ///< drop what is held back

    /// Other code is about to write to standard output.
    virtual void flush_output() {}
    /// A message to the operator at once, not in queue order.
    virtual void operator_error(const char *text);
    /// A (PRINT,...) line, without newline, at interpretation time.
    virtual void print_line(const char *text);

    // ---- what the machine says; values in program units -------------------------
    virtual double GET_EXTERNAL_FEED_RATE() { return 0; }
    virtual double GET_EXTERNAL_TRAVERSE_RATE() { return 0; }
    virtual bool GET_EXTERNAL_FLOOD() { return false; }
    virtual bool GET_EXTERNAL_MIST() { return false; }
    virtual CANON_UNITS GET_EXTERNAL_LENGTH_UNIT_TYPE() { return CANON_UNITS_MM; } ///< program units
    virtual double GET_EXTERNAL_LENGTH_UNITS() = 0;                                ///< machine units per mm
    virtual double GET_EXTERNAL_ANGLE_UNITS() { return 1; }                        ///< machine units per degree
    virtual CANON_MOTION_MODE GET_EXTERNAL_MOTION_CONTROL_MODE() { return CANON_CONTINUOUS; }
    virtual double GET_EXTERNAL_MOTION_CONTROL_TOLERANCE() { return 0; }
    virtual double GET_EXTERNAL_MOTION_CONTROL_NAIVECAM_TOLERANCE() { return 0; }
    virtual std::string GET_EXTERNAL_PARAMETER_FILE_NAME() { return {}; } ///< empty: none is kept
    virtual void SET_PARAMETER_FILE_NAME(const char *name) { (void)name; }
    virtual CANON_PLANE GET_EXTERNAL_PLANE() { return CANON_PLANE_XY; }
    virtual EmcPose GET_EXTERNAL_POSITION() = 0;
    virtual EmcPose GET_EXTERNAL_PROBE_POSITION() { return GET_EXTERNAL_POSITION(); }
    virtual double GET_EXTERNAL_PROBE_VALUE() { return 0; }
    virtual int GET_EXTERNAL_PROBE_TRIPPED_VALUE() { return 0; }
    virtual bool GET_EXTERNAL_QUEUE_EMPTY() { return true; }
    virtual double GET_EXTERNAL_SPEED(int spindle) { return (void)spindle, 0; }
    virtual CANON_DIRECTION GET_EXTERNAL_SPINDLE(int spindle) { return (void)spindle, CANON_STOPPED; }
    virtual EmcPose GET_EXTERNAL_TOOL_LENGTH_OFFSET() { return EmcPose{}; }
    virtual int GET_EXTERNAL_TOOL_SLOT() { return 0; }           ///< index of the tool in the spindle
    virtual int GET_EXTERNAL_SELECTED_TOOL_SLOT() { return -1; } ///< index of the prepared tool, -1 none
    /// The last index that may hold a tool.
    virtual int GET_EXTERNAL_TOOL_TABLE_LAST() { return CANON_POCKETS_MAX - 1; }
    virtual CANON_TOOL_TABLE GET_EXTERNAL_TOOL_TABLE(int idx) { return (void)idx, tooldata_entry_init(); }
    virtual int GET_EXTERNAL_TC_FAULT() { return 0; }
    virtual int GET_EXTERNAL_TC_REASON() { return 0; }
    virtual bool GET_EXTERNAL_FEED_OVERRIDE_ENABLE() { return true; }
    virtual bool GET_EXTERNAL_SPINDLE_OVERRIDE_ENABLE(int spindle) { return (void)spindle, true; }
    virtual bool GET_EXTERNAL_ADAPTIVE_FEED_ENABLE() { return false; }
    virtual bool GET_EXTERNAL_FEED_HOLD_ENABLE() { return true; }
    virtual int GET_EXTERNAL_DIGITAL_INPUT(int index, int dflt) { return (void)index, dflt; }
    virtual double GET_EXTERNAL_ANALOG_INPUT(int index, double dflt) { return (void)index, dflt; }
    virtual int GET_EXTERNAL_AXIS_MASK() { return 0x3f; } ///< bit 0 X ... bit 8 W
    virtual bool GET_EXTERNAL_OFFSET_APPLIED() { return false; }
    virtual EmcPose GET_EXTERNAL_OFFSETS() { return EmcPose{}; }
    /// Value of a HAL pin, signal or parameter for #<_hal[name]>; false: not there.
    virtual bool hal_value(const char *name, double *value) { return (void)name, (void)value, false; }
};

#endif
