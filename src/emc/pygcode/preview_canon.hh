/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * preview_canon.hh - the world as the preview shows it to the interpreter.
 *
 * Everything goes on at once and arrives where it was sent; lengths leave in inches.
 * Thread: the caller's
 * Source: preview sheet, sections 2 and 4
 */
#ifndef KERF_PREVIEW_CANON_HH
#define KERF_PREVIEW_CANON_HH

#include <array>
#include <string>
#include <vector>

#include "canon.hh"
#include "emc/canon/hal_number.hh"

class PreviewCanon : public Canon
{
  public:
    void SET_G5X_OFFSET(int index, const EmcPose &offset) override;
    void SET_G92_OFFSET(const EmcPose &offset) override;
    void SET_XY_ROTATION(double degrees) override;
    void USE_LENGTH_UNITS(CANON_UNITS u) override;
    void SELECT_PLANE(CANON_PLANE p) override;
    void SET_FEED_RATE(double rate) override;
    void SET_MOTION_CONTROL_MODE(CANON_MOTION_MODE mode, double tol, int, double) override
    {
        control_mode = mode;
        tolerance = tol;
    }
    void SET_NAIVECAM_TOLERANCE(double tol) override { naive_tolerance = tol; }
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
    void DWELL(double seconds) override;
    void SET_SPINDLE_SPEED(int spindle, double s) override
    {
        if (spindle == 0) speed = s;
    }
    void SELECT_TOOL(int toolno) override { selected_tool = toolno; }
    void CHANGE_TOOL() override { on_tool_change(last_line(), selected_tool); }
    void COMMENT(const char *text) override { on_comment(text); }
    void MESSAGE(const char *text) override { on_message(text); }
    bool USER_DEFINED_FUNCTION_EXISTS(int) override { return true; }
    void USER_DEFINED_FUNCTION(int num, double p, double q) override { on_user_m(last_line(), num, p, q); }
    bool hal_value(const char *name, double *value) override { return hal_number(name, value); }
    bool GET_OPTIONAL_PROGRAM_STOP() override { return false; }

    double GET_EXTERNAL_FEED_RATE() override { return feed_rate; }
    CANON_UNITS GET_EXTERNAL_LENGTH_UNIT_TYPE() override { return units; }
    CANON_MOTION_MODE GET_EXTERNAL_MOTION_CONTROL_MODE() override { return control_mode; }
    double GET_EXTERNAL_MOTION_CONTROL_TOLERANCE() override { return tolerance; }
    double GET_EXTERNAL_MOTION_CONTROL_NAIVECAM_TOLERANCE() override { return naive_tolerance; }
    CANON_PLANE GET_EXTERNAL_PLANE() override { return plane; }
    EmcPose GET_EXTERNAL_POSITION() override { return position; }
    EmcPose GET_EXTERNAL_TOOL_LENGTH_OFFSET() override { return tool_offset; }
    int GET_EXTERNAL_SELECTED_TOOL_SLOT() override { return 0; }

  protected:
    // What derived canons get: inches, degrees, inches a minute.
    virtual void on_g5x(int index, const EmcPose &offset) = 0;
    virtual void on_g92(const EmcPose &offset) = 0;
    virtual void on_rotation(double degrees) = 0;
    virtual void on_plane(int plane) = 0;
    virtual void on_feed_rate(double rate) = 0;
    virtual void on_tool_offset(int line, const EmcPose &offset) = 0;
    virtual void on_traverse(int line, const EmcPose &end) = 0;
    virtual void on_feed(int line, const EmcPose &end) = 0;
    virtual void on_probe(int line, const EmcPose &end) = 0;
    virtual void on_tap(int line, double x, double y, double z) = 0;
    virtual void on_arc(int line, double first_end, double second_end, double first_axis, double second_axis,
                        int rotation, double axis_end, const EmcPose &end) = 0;
    virtual void on_dwell(int line, double seconds) = 0;
    virtual void on_tool_change(int line, int toolno) = 0;
    virtual void on_comment(const char *text) = 0;
    virtual void on_message(const char *text) = 0;
    virtual void on_user_m(int line, int num, double p, double q) = 0;
    virtual int last_line() = 0; ///< line of the block that runs

    double to_inch(double length) const { return units == CANON_UNITS_INCHES ? length : length / 25.4; }
    EmcPose to_inch(const EmcPose &p) const;

    CANON_UNITS units = CANON_UNITS_INCHES;
    CANON_PLANE plane = CANON_PLANE_XY;
    EmcPose position{}; // program units
    EmcPose tool_offset{};
    double rotation = 0;
    double feed_rate = 1, speed = 0;
    int selected_tool = 0;

  private:
    template <class Change> void keep_place(Change change);
    void spline_point(int line, double a, double b, CANON_PLANE p);
    CANON_MOTION_MODE control_mode = CANON_CONTINUOUS;
    double tolerance = 0.1, naive_tolerance = 0.1;
    EmcPose g5x{}, g92{}; // program units
};

// ---- shared geometry (arc_segments.cc) ---------------------------------------------------

/// A point of nine axes.
using Point9 = std::array<double, 9>;

/// Offsets between program and machine coordinates, in one unit.
struct PreviewFrame {
    Point9 g5x{}, g92{};
    double cosine = 1, sine = 0;
    Point9 to_machine(const Point9 &p) const;
    Point9 from_machine(const Point9 &p) const;
};

/// The arc as machine points, the start left out, the end exact. plane: CANON_PLANE value.
/// length_scale: mm a unit of the coordinates, for the test of a full circle.
void arc_segments(std::vector<Point9> &out, const PreviewFrame &frame, int plane, const Point9 &start_machine,
                  double x1, double y1, double cx, double cy, int rot, double z1, const Point9 &end_program,
                  int max_segments, double length_scale);

inline Point9 point9(const EmcPose &p) { return {p.tran.x, p.tran.y, p.tran.z, p.a, p.b, p.c, p.u, p.v, p.w}; }

#endif
