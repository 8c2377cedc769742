/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * canon_module.cc - Python module `emccanon`: canonical calls from handlers.
 *
 * Source: remap sheet, section 9
 */
#include "py_interp.hh"
#include "stages.hh"

namespace py = pybind11;

namespace ngc
{

Setup *&current_setup()
{
    static Setup *setup = nullptr; // Python runs one handler at a time
    return setup;
}

namespace
{

Setup &setup()
{
    if (!current_setup()) throw std::runtime_error("emccanon: no interpreter is running");
    return *current_setup();
}

Canon &canon() { return setup().canon; }

EmcPose pose(double x, double y, double z, double a, double b, double c, double u, double v, double w)
{
    EmcPose p;
    p.tran = {x, y, z};
    p.a = a;
    p.b = b;
    p.c = c;
    p.u = u;
    p.v = v;
    p.w = w;
    return p;
}

// Functions without arguments, by pointer to member.
struct Plain {
    const char *name;
    void (Canon::*call)();
};

const Plain plain[] = {
    {"CHANGE_TOOL", &Canon::CHANGE_TOOL},
    {"RELOAD_TOOLDATA", &Canon::RELOAD_TOOLDATA},
    {"DISABLE_ADAPTIVE_FEED", &Canon::DISABLE_ADAPTIVE_FEED},
    {"ENABLE_ADAPTIVE_FEED", &Canon::ENABLE_ADAPTIVE_FEED},
    {"DISABLE_FEED_HOLD", &Canon::DISABLE_FEED_HOLD},
    {"ENABLE_FEED_HOLD", &Canon::ENABLE_FEED_HOLD},
    {"DISABLE_FEED_OVERRIDE", &Canon::DISABLE_FEED_OVERRIDE},
    {"ENABLE_FEED_OVERRIDE", &Canon::ENABLE_FEED_OVERRIDE},
    {"FINISH", &Canon::FINISH},
    {"ON_RESET", &Canon::ON_RESET},
    {"FLOOD_OFF", &Canon::FLOOD_OFF},
    {"FLOOD_ON", &Canon::FLOOD_ON},
    {"MIST_OFF", &Canon::MIST_OFF},
    {"MIST_ON", &Canon::MIST_ON},
    {"INIT_CANON", &Canon::INIT_CANON},
    {"LOGCLOSE", &Canon::LOGCLOSE},
    {"OPTIONAL_PROGRAM_STOP", &Canon::OPTIONAL_PROGRAM_STOP},
    {"PALLET_SHUTTLE", &Canon::PALLET_SHUTTLE},
    {"PROGRAM_END", &Canon::PROGRAM_END},
    {"PROGRAM_STOP", &Canon::PROGRAM_STOP},
    {"SPINDLE_RETRACT", &Canon::SPINDLE_RETRACT},
    {"SPINDLE_RETRACT_TRAVERSE", &Canon::SPINDLE_RETRACT_TRAVERSE},
    {"STOP_SPEED_FEED_SYNCH", &Canon::STOP_SPEED_FEED_SYNCH},
    {"TURN_PROBE_OFF", &Canon::TURN_PROBE_OFF},
    {"TURN_PROBE_ON", &Canon::TURN_PROBE_ON},
    {"USE_NO_SPINDLE_FORCE", &Canon::USE_NO_SPINDLE_FORCE},
};

struct OneInt {
    const char *name;
    void (Canon::*call)(int);
};

const OneInt one_int[] = {
    {"CHANGE_TOOL_NUMBER", &Canon::CHANGE_TOOL_NUMBER},
    {"SELECT_TOOL", &Canon::SELECT_TOOL},
    {"DISABLE_SPEED_OVERRIDE", &Canon::DISABLE_SPEED_OVERRIDE},
    {"ENABLE_SPEED_OVERRIDE", &Canon::ENABLE_SPEED_OVERRIDE},
    {"SET_AUX_OUTPUT_BIT", &Canon::SET_AUX_OUTPUT_BIT},
    {"CLEAR_AUX_OUTPUT_BIT", &Canon::CLEAR_AUX_OUTPUT_BIT},
    {"SET_MOTION_OUTPUT_BIT", &Canon::SET_MOTION_OUTPUT_BIT},
    {"CLEAR_MOTION_OUTPUT_BIT", &Canon::CLEAR_MOTION_OUTPUT_BIT},
};

struct OneText {
    const char *name;
    void (Canon::*call)(const char *);
};

const OneText one_text[] = {
    {"COMMENT", &Canon::COMMENT}, {"LOG", &Canon::LOG},         {"LOGOPEN", &Canon::LOGOPEN},
    {"LOGAPPEND", &Canon::LOGAPPEND}, {"MESSAGE", &Canon::MESSAGE},
    {"SET_PARAMETER_FILE_NAME", &Canon::SET_PARAMETER_FILE_NAME},
};

struct OneReal {
    const char *name;
    void (Canon::*call)(double);
};

const OneReal one_real[] = {
    {"DWELL", &Canon::DWELL},
    {"SET_FEED_RATE", &Canon::SET_FEED_RATE},
    {"SET_NAIVECAM_TOLERANCE", &Canon::SET_NAIVECAM_TOLERANCE},
    {"SET_TRAVERSE_RATE", &Canon::SET_TRAVERSE_RATE},
    {"SET_XY_ROTATION", &Canon::SET_XY_ROTATION},
};

void bind_enums(py::module_ &m)
{
    py::enum_<CANON_PLANE>(m, "CANON_PLANE")
        .value("CANON_PLANE_XY", CANON_PLANE_XY).value("CANON_PLANE_YZ", CANON_PLANE_YZ)
        .value("CANON_PLANE_XZ", CANON_PLANE_XZ).value("CANON_PLANE_UV", CANON_PLANE_UV)
        .value("CANON_PLANE_VW", CANON_PLANE_VW).value("CANON_PLANE_UW", CANON_PLANE_UW).export_values();
    py::enum_<CANON_UNITS>(m, "CANON_UNITS")
        .value("CANON_UNITS_INCHES", CANON_UNITS_INCHES).value("CANON_UNITS_MM", CANON_UNITS_MM)
        .value("CANON_UNITS_CM", CANON_UNITS_CM).export_values();
    py::enum_<CANON_MOTION_MODE>(m, "CANON_MOTION_MODE")
        .value("CANON_EXACT_STOP", CANON_EXACT_STOP).value("CANON_EXACT_PATH", CANON_EXACT_PATH)
        .value("CANON_CONTINUOUS", CANON_CONTINUOUS).export_values();
    py::enum_<CANON_SPEED_FEED_MODE>(m, "CANON_FEED_SPEED_MODE")
        .value("CANON_SYNCHED", CANON_SYNCHED).value("CANON_INDEPENDENT", CANON_INDEPENDENT).export_values();
    py::enum_<CANON_DIRECTION>(m, "CANON_DIRECTION")
        .value("CANON_STOPPED", CANON_STOPPED).value("CANON_CLOCKWISE", CANON_CLOCKWISE)
        .value("CANON_COUNTERCLOCKWISE", CANON_COUNTERCLOCKWISE).export_values();
    py::enum_<CANON_FEED_REFERENCE>(m, "CANON_FEED_REFERENCE")
        .value("CANON_WORKPIECE", CANON_WORKPIECE).value("CANON_XYZ", CANON_XYZ).export_values();
    py::enum_<CANON_SIDE>(m, "CANON_SIDE")
        .value("CANON_SIDE_RIGHT", CANON_SIDE_RIGHT).value("CANON_SIDE_LEFT", CANON_SIDE_LEFT)
        .value("CANON_SIDE_OFF", CANON_SIDE_OFF).export_values();
    py::enum_<CANON_AXIS>(m, "CANON_AXIS")
        .value("CANON_AXIS_X", CANON_AXIS_X).value("CANON_AXIS_Y", CANON_AXIS_Y).value("CANON_AXIS_Z", CANON_AXIS_Z)
        .value("CANON_AXIS_A", CANON_AXIS_A).value("CANON_AXIS_B", CANON_AXIS_B).value("CANON_AXIS_C", CANON_AXIS_C)
        .value("CANON_AXIS_U", CANON_AXIS_U).value("CANON_AXIS_V", CANON_AXIS_V).value("CANON_AXIS_W", CANON_AXIS_W)
        .export_values();
}

void bind_motion(py::module_ &m)
{
    using D = double;
    m.def("STRAIGHT_FEED", [](int line, D x, D y, D z, D a, D b, D c, D u, D v, D w) {
        canon().STRAIGHT_FEED(line, pose(x, y, z, a, b, c, u, v, w));
    });
    m.def("STRAIGHT_TRAVERSE", [](int line, D x, D y, D z, D a, D b, D c, D u, D v, D w) {
        canon().STRAIGHT_TRAVERSE(line, pose(x, y, z, a, b, c, u, v, w));
    });
    m.def("STRAIGHT_PROBE", [](int line, D x, D y, D z, D a, D b, D c, D u, D v, D w, int type) {
        canon().STRAIGHT_PROBE(line, pose(x, y, z, a, b, c, u, v, w), static_cast<unsigned char>(type));
    });
    m.def("ARC_FEED", [](int line, D first_end, D second_end, D first_axis, D second_axis, int rotation, D axis_end,
                         D a, D b, D c, D u, D v, D w) {
        const Setup &s = setup();
        EmcPose end = pose(0, 0, 0, a, b, c, u, v, w);
        const int first = s.plane == CANON_PLANE_XZ ? 2 : s.plane == CANON_PLANE_YZ ? 1 : 0;
        axis(end, first) = first_end;
        axis(end, (first + 1) % 3) = second_end;
        axis(end, (first + 2) % 3) = axis_end;
        canon().ARC_FEED(line, first_end, second_end, first_axis, second_axis, rotation, axis_end, end);
    });
    m.def("RIGID_TAP", [](int line, D x, D y, D z, D scale) { canon().RIGID_TAP(line, x, y, z, scale); });
    m.def("SET_G5X_OFFSET", [](int index, D x, D y, D z, D a, D b, D c, D u, D v, D w) {
        canon().SET_G5X_OFFSET(index, pose(x, y, z, a, b, c, u, v, w));
    });
    m.def("SET_G92_OFFSET", [](D x, D y, D z, D a, D b, D c, D u, D v, D w) {
        canon().SET_G92_OFFSET(pose(x, y, z, a, b, c, u, v, w));
    });
    m.def("USE_TOOL_LENGTH_OFFSET", [](const EmcPose &p) { canon().USE_TOOL_LENGTH_OFFSET(p); });
    m.def("SET_TOOL_TABLE_ENTRY",
          [](int idx, int toolno, const EmcPose &p, D diameter, D front, D back, int orientation) {
              canon().SET_TOOL_TABLE_ENTRY(idx, toolno, p, diameter, front, back, orientation);
          });
    m.def("SET_FEED_MODE", [](int spindle, int mode) { canon().SET_FEED_MODE(spindle, mode); });
    m.def("SELECT_PLANE", [](CANON_PLANE p) { canon().SELECT_PLANE(p); });
    m.def("USE_LENGTH_UNITS", [](CANON_UNITS u) { canon().USE_LENGTH_UNITS(u); });
    m.def("SET_SPINDLE_MODE", [](int spindle, D mode) { canon().SET_SPINDLE_MODE(spindle, mode); });
    m.def("SET_SPINDLE_SPEED", [](int spindle, D speed) { canon().SET_SPINDLE_SPEED(spindle, speed); });
    m.def("START_SPINDLE_CLOCKWISE", [](int spindle, int wait) { canon().START_SPINDLE_CLOCKWISE(spindle, wait); });
    m.def("START_SPINDLE_COUNTERCLOCKWISE",
          [](int spindle, int wait) { canon().START_SPINDLE_COUNTERCLOCKWISE(spindle, wait); });
    m.def("STOP_SPINDLE_TURNING", [](int spindle, int wait) { canon().STOP_SPINDLE_TURNING(spindle, wait); });
    m.def("START_SPEED_FEED_SYNCH", [](int spindle, D feed, bool velocity) {
        canon().START_SPEED_FEED_SYNCH(spindle, feed, velocity);
    });
    m.def("SET_AUX_OUTPUT_VALUE", [](int i, D v) { canon().SET_AUX_OUTPUT_VALUE(i, v); });
    m.def("SET_MOTION_OUTPUT_VALUE", [](int i, D v) { canon().SET_MOTION_OUTPUT_VALUE(i, v); });
    m.def("WAIT", [](int index, int type, int wait, D timeout) {
        return canon().WAIT(index, CANON_INPUT(type), CANON_WAIT(wait), timeout);
    });
    m.def("CLAMP_AXIS", [](CANON_AXIS a) { canon().CLAMP_AXIS(a); });
    m.def("LOCK_ROTARY", [](int line, int joint) { return canon().LOCK_ROTARY(line, joint); });
    m.def("UNLOCK_ROTARY", [](int line, int joint) { return canon().UNLOCK_ROTARY(line, joint); });
    m.def("SET_BLOCK_DELETE", [](bool on) { canon().SET_BLOCK_DELETE(on); });
    m.def("GET_BLOCK_DELETE", [] { return canon().GET_BLOCK_DELETE(); });
    m.def("SET_OPTIONAL_PROGRAM_STOP", [](bool on) { canon().SET_OPTIONAL_PROGRAM_STOP(on); });
    m.def("GET_OPTIONAL_PROGRAM_STOP", [] { return canon().GET_OPTIONAL_PROGRAM_STOP(); });
    m.def("CANON_ERROR", [](const std::string &text) {
        if (!text.empty()) canon().CANON_ERROR(text.c_str());
    });
    // Compensation is done inside the interpreter; the canonical calls have no effect.
    m.def("SET_CUTTER_RADIUS_COMPENSATION", [](D) {});
    m.def("START_CUTTER_RADIUS_COMPENSATION", [](CANON_SIDE) {});
    m.def("STOP_CUTTER_RADIUS_COMPENSATION", [] {});
}

void bind_queued(py::module_ &m)
{
    m.def("enqueue_SET_FEED_RATE", [](double f) { enqueue_feed_rate(setup(), f); });
    m.def("enqueue_SET_FEED_MODE", [](int spindle, int mode) { enqueue_feed_mode(setup(), spindle, mode); });
    m.def("enqueue_DWELL", [](double t) { enqueue_dwell(setup(), t); });
    m.def("enqueue_MIST_ON", [] { enqueue_coolant(setup(), true, true); });
    m.def("enqueue_MIST_OFF", [] { enqueue_coolant(setup(), true, false); });
    m.def("enqueue_FLOOD_ON", [] { enqueue_coolant(setup(), false, true); });
    m.def("enqueue_FLOOD_OFF", [] { enqueue_coolant(setup(), false, false); });
    m.def("enqueue_START_SPINDLE_CLOCKWISE", [](int s) { enqueue_spindle_start(setup(), s, CANON_CLOCKWISE); });
    m.def("enqueue_START_SPINDLE_COUNTERCLOCKWISE",
          [](int s) { enqueue_spindle_start(setup(), s, CANON_COUNTERCLOCKWISE); });
    m.def("enqueue_STOP_SPINDLE_TURNING", [](int s) { enqueue_spindle_stop(setup(), s); });
    m.def("enqueue_SET_SPINDLE_MODE", [](int s, double mode) { enqueue_spindle_mode(setup(), s, mode); });
    m.def("enqueue_SET_SPINDLE_SPEED", [](int s, double speed) { enqueue_spindle_speed(setup(), s, speed); });
    m.def("enqueue_SET_SPINDLE_SPEED", [](double speed) { enqueue_spindle_speed(setup(), 0, speed); });
    m.def("enqueue_COMMENT", [](const std::string &text) { enqueue_comment(setup(), text.c_str()); });
}

void bind_queries(py::module_ &m)
{
    m.def("GET_EXTERNAL_ADAPTIVE_FEED_ENABLE", [] { return int(canon().GET_EXTERNAL_ADAPTIVE_FEED_ENABLE()); });
    m.def("GET_EXTERNAL_ANALOG_INPUT", [](int i, double d) { return canon().GET_EXTERNAL_ANALOG_INPUT(i, d); });
    m.def("GET_EXTERNAL_DIGITAL_INPUT", [](int i, int d) { return canon().GET_EXTERNAL_DIGITAL_INPUT(i, d); });
    m.def("GET_EXTERNAL_ANGLE_UNITS", [] { return canon().GET_EXTERNAL_ANGLE_UNITS(); });
    m.def("GET_EXTERNAL_LENGTH_UNITS", [] { return canon().GET_EXTERNAL_LENGTH_UNITS(); });
    m.def("GET_EXTERNAL_AXIS_MASK", [] { return canon().GET_EXTERNAL_AXIS_MASK(); });
    m.def("GET_EXTERNAL_FEED_HOLD_ENABLE", [] { return int(canon().GET_EXTERNAL_FEED_HOLD_ENABLE()); });
    m.def("GET_EXTERNAL_FEED_OVERRIDE_ENABLE", [] { return int(canon().GET_EXTERNAL_FEED_OVERRIDE_ENABLE()); });
    m.def("GET_EXTERNAL_SPINDLE_OVERRIDE_ENABLE",
          [](int s) { return int(canon().GET_EXTERNAL_SPINDLE_OVERRIDE_ENABLE(s)); });
    m.def("GET_EXTERNAL_FEED_RATE", [] { return canon().GET_EXTERNAL_FEED_RATE(); });
    m.def("GET_EXTERNAL_TRAVERSE_RATE", [] { return canon().GET_EXTERNAL_TRAVERSE_RATE(); });
    m.def("GET_EXTERNAL_FLOOD", [] { return int(canon().GET_EXTERNAL_FLOOD()); });
    m.def("GET_EXTERNAL_MIST", [] { return int(canon().GET_EXTERNAL_MIST()); });
    m.def("GET_EXTERNAL_MOTION_CONTROL_MODE", [] { return canon().GET_EXTERNAL_MOTION_CONTROL_MODE(); });
    m.def("GET_EXTERNAL_MOTION_CONTROL_TOLERANCE", [] { return canon().GET_EXTERNAL_MOTION_CONTROL_TOLERANCE(); });
    m.def("GET_EXTERNAL_MOTION_CONTROL_NAIVECAM_TOLERANCE",
          [] { return canon().GET_EXTERNAL_MOTION_CONTROL_NAIVECAM_TOLERANCE(); });
    m.def("GET_EXTERNAL_PARAMETER_FILE_NAME", [](const std::string &, int) {});
    m.def("GET_EXTERNAL_PLANE", [] { return canon().GET_EXTERNAL_PLANE(); });
    m.def("GET_EXTERNAL_PROBE_TRIPPED_VALUE", [] { return canon().GET_EXTERNAL_PROBE_TRIPPED_VALUE(); });
    m.def("GET_EXTERNAL_PROBE_VALUE", [] { return canon().GET_EXTERNAL_PROBE_VALUE(); });
    m.def("GET_EXTERNAL_QUEUE_EMPTY", [] { return int(canon().GET_EXTERNAL_QUEUE_EMPTY()); });
    m.def("GET_EXTERNAL_SELECTED_TOOL_SLOT", [] { return canon().GET_EXTERNAL_SELECTED_TOOL_SLOT(); });
    m.def("GET_EXTERNAL_TOOL_SLOT", [] { return canon().GET_EXTERNAL_TOOL_SLOT(); });
    m.def("GET_EXTERNAL_SPEED", [](int s) { return canon().GET_EXTERNAL_SPEED(s); });
    m.def("GET_EXTERNAL_SPINDLE", [](int s) { return canon().GET_EXTERNAL_SPINDLE(s); });
    m.def("GET_EXTERNAL_TC_FAULT", [] { return canon().GET_EXTERNAL_TC_FAULT(); });
    m.def("GET_EXTERNAL_TOOL_TABLE", [](int i) { return canon().GET_EXTERNAL_TOOL_TABLE(i); });
    m.def("GET_EXTERNAL_OFFSET_APPLIED", [] { return int(canon().GET_EXTERNAL_OFFSET_APPLIED()); });
    m.def("GET_EXTERNAL_OFFSETS", [] { return canon().GET_EXTERNAL_OFFSETS(); });
    for (int i = 0; i < AXES; ++i) {
        const std::string letter(1, char(AXIS_LETTERS[i] - 32));
        m.def(("GET_EXTERNAL_POSITION_" + letter).c_str(), [i] { return axis(canon().GET_EXTERNAL_POSITION(), i); });
        m.def(("GET_EXTERNAL_PROBE_POSITION_" + letter).c_str(),
              [i] { return axis(canon().GET_EXTERNAL_PROBE_POSITION(), i); });
        m.def(("GET_EXTERNAL_TOOL_LENGTH_" + letter + "OFFSET").c_str(),
              [i] { return axis(canon().GET_EXTERNAL_TOOL_LENGTH_OFFSET(), i); });
    }
}

} // namespace

void bind_canon(py::module_ &m)
{
    bind_enums(m);
    for (const Plain &f : plain) m.def(f.name, [call = f.call] { (canon().*call)(); });
    for (const OneInt &f : one_int) m.def(f.name, [call = f.call](int i) { (canon().*call)(i); });
    for (const OneReal &f : one_real) m.def(f.name, [call = f.call](double v) { (canon().*call)(v); });
    for (const OneText &f : one_text)
        m.def(f.name, [call = f.call](const std::string &t) { (canon().*call)(t.c_str()); });
    bind_motion(m);
    bind_queued(m);
    bind_queries(m);
}

void install_modules()
{
    py::gil_scoped_acquire gil;
    py::dict modules = py::module_::import("sys").attr("modules");
    if (modules.contains("interpreter") && py::hasattr(modules["interpreter"], "InterpReturn")) return;
    // Definitions that live as long as Python does.
    static py::module_::module_def interpreter_def, canon_def;
    py::module_ interpreter =
        py::module_::create_extension_module("interpreter", "The running interpreter.", &interpreter_def);
    bind_interpreter(interpreter);
    modules["interpreter"] = interpreter;
    py::module_ emccanon = py::module_::create_extension_module("emccanon", "Canonical calls.", &canon_def);
    bind_canon(emccanon);
    modules["emccanon"] = emccanon;
}

} // namespace ngc
