// SPDX-License-Identifier: GPL-2.0-or-later
//
// kerf_motion.cc - Python module kerf_motion: motion commands and status, without task.
//
// For tests and diagnosis. Thread: task.
//   connect(key=100, timeout=1.0)      to the segment of this instance
//   send(code, **fields)               writes a command (motion.h field names; pos, center,
//                                      normal, tool_offset as sequences), returns EMCMOT_COMM_*
//   status() -> dict                   the status block; joints, axes, spindles as lists of dicts
//   config() -> dict
//   error() -> str | None              oldest operator error
//   codes: ABORT, ENABLE, ... as module attributes
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <cstring>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>
#include "emcpose.h"
#include "usrmotintf.h"

namespace py = pybind11;

namespace {

using Setter = std::function<void(emcmot_command_t &, const py::handle &)>;

EmcPose pose_of(const py::handle &value)
{
    EmcPose pose = {};
    int axis = 0;
    for (auto item : py::cast<py::sequence>(value)) {
        double *at = emcPoseAxis(&pose, axis++);
        if (!at) throw std::invalid_argument("a pose has at most nine numbers");
        *at = py::cast<double>(item);
    }
    return pose;
}

PmCartesian cartesian_of(const py::handle &value)
{
    auto v = py::cast<std::vector<double>>(value);
    if (v.size() != 3) throw std::invalid_argument("a vector has three numbers");
    return {v[0], v[1], v[2]};
}

template <class T, class V> Setter number(T emcmot_command_t::*field)
{
    return [field](emcmot_command_t &c, const py::handle &v) { c.*field = static_cast<T>(py::cast<V>(v)); };
}
Setter real(double emcmot_command_t::*field) { return number<double, double>(field); }
Setter integer(int emcmot_command_t::*field) { return number<int, int>(field); }
Setter byte(unsigned char emcmot_command_t::*field) { return number<unsigned char, int>(field); }
Setter pose(EmcPose emcmot_command_t::*field)
{
    return [field](emcmot_command_t &c, const py::handle &v) { c.*field = pose_of(v); };
}
Setter vector(PmCartesian emcmot_command_t::*field)
{
    return [field](emcmot_command_t &c, const py::handle &v) { c.*field = cartesian_of(v); };
}

const std::map<std::string, Setter> &setters()
{
    using C = emcmot_command_t;
#define REAL(f) {#f, real(&C::f)}
#define INT(f) {#f, integer(&C::f)}
#define BYTE(f) {#f, byte(&C::f)}
    static const std::map<std::string, Setter> table = {
        REAL(motor_offset), REAL(maxLimit), REAL(minLimit), REAL(min_pos_speed), REAL(max_neg_speed),
        {"pos", pose(&C::pos)}, {"center", vector(&C::center)}, {"normal", vector(&C::normal)},
        {"tool_offset", pose(&C::tool_offset)}, INT(turn), REAL(vel), REAL(ini_maxvel), INT(motion_type),
        REAL(spindlesync), REAL(acc), REAL(jerk), REAL(ini_maxjerk), INT(planner_type), REAL(scurve_peak_scale),
        REAL(backlash), INT(id), INT(termCond), REAL(tolerance), INT(joint), INT(axis), INT(spindle), REAL(scale),
        REAL(offset), REAL(home), REAL(home_final_vel), REAL(search_vel), REAL(latch_vel), INT(flags),
        INT(home_sequence), INT(volatile_home), REAL(minFerror), REAL(maxFerror), INT(debug), BYTE(now), BYTE(out),
        BYTE(start), BYTE(end), BYTE(mode), REAL(comp_nominal), REAL(comp_forward), REAL(comp_reverse),
        BYTE(probe_type), INT(probe_jog_err_inhibit), INT(probe_home_err_inhibit), REAL(orientation), INT(state),
        INT(direction), REAL(timeout), BYTE(wait_for_spindle_at_speed), INT(arcBlendOptDepth), INT(arcBlendEnable),
        INT(arcBlendFallbackEnable), INT(arcBlendGapCycles), REAL(arcBlendRampFreq), REAL(arcBlendTangentKinkRatio),
        REAL(maxFeedScale), REAL(ext_offset_vel), REAL(ext_offset_acc), INT(probe_feed_contact),
        INT(probe_rapid_contact),
        REAL(probe_filter),
    };
#undef REAL
#undef INT
#undef BYTE
    return table;
}

int send(int code, const py::kwargs &fields)
{
    static emcmot_command_t command;
    std::memset(&command, 0, sizeof(command));
    command.command = static_cast<cmd_code_t>(code);
    command.motion_type = EMC_MOTION_TYPE_FEED;
    for (auto field : fields) {
        auto name = py::cast<std::string>(field.first);
        if (name == "line") { /* of the state tag */
            command.tag.fields[GM_FIELD_LINE_NUMBER] = py::cast<int>(field.second);
            continue;
        }
        if (name == "flag") {
            command.tag.packed_flags = py::cast<unsigned>(field.second);
            continue;
        }
        if (name == "feed") {
            command.tag.fields_float[GM_FIELD_FLOAT_FEED] = py::cast<float>(field.second);
            continue;
        }
        if (name == "tag_field" || name == "tag_float") { /* {index: value} */
            for (auto item : py::cast<py::dict>(field.second)) {
                auto n = py::cast<unsigned>(item.first);
                if (n >= static_cast<unsigned>(name == "tag_field" ? +GM_FIELD_MAX_FIELDS : +GM_FIELD_FLOAT_MAX_FIELDS))
                    throw std::invalid_argument("no such field of a tag");
                if (name == "tag_field") command.tag.fields[n] = py::cast<int>(item.second);
                else command.tag.fields_float[n] = py::cast<float>(item.second);
            }
            continue;
        }
        auto setter = setters().find(name);
        if (setter == setters().end()) throw std::invalid_argument("no field " + name + " in a motion command");
        setter->second(command, field.second);
    }
    py::gil_scoped_release release;
    return usrmotWriteEmcmotCommand(&command);
}

py::tuple tuple_of(const EmcPose &p)
{
    return py::make_tuple(p.tran.x, p.tran.y, p.tran.z, p.a, p.b, p.c, p.u, p.v, p.w);
}

py::dict joint_dict(const emcmot_joint_status_t &j)
{
    py::dict d;
    d["flag"] = j.flag;
    d["homed"] = j.homed;
    d["homing"] = j.homing;
    d["pos_cmd"] = j.pos_cmd;
    d["pos_fb"] = j.pos_fb;
    d["vel_cmd"] = j.vel_cmd;
    d["acc_cmd"] = j.acc_cmd;
    d["ferror"] = j.ferror;
    d["ferror_high_mark"] = j.ferror_high_mark;
    d["backlash"] = j.backlash;
    d["max_pos_limit"] = j.max_pos_limit;
    d["min_pos_limit"] = j.min_pos_limit;
    return d;
}

py::dict spindle_dict(const spindle_status_t &s)
{
    py::dict d;
    d["speed"] = s.speed;
    d["scale"] = s.scale;
    d["net_scale"] = s.net_scale;
    d["state"] = s.state;
    d["direction"] = s.direction;
    d["brake"] = s.brake;
    d["locked"] = s.locked;
    d["orient_state"] = s.orient_state;
    d["orient_fault"] = s.orient_fault;
    d["at_speed"] = s.at_speed;
    d["spindleRevs"] = s.spindleRevs;
    d["spindleSpeedIn"] = s.spindleSpeedIn;
    return d;
}

py::dict status()
{
    static emcmot_status_t s;
    int r;
    do r = usrmotReadEmcmotStatus(&s);
    while (r == EMCMOT_COMM_SPLIT_READ_TIMEOUT);
    if (r != 0) throw std::runtime_error("not connected to motion");
    py::dict d;
    d["commandStatus"] = static_cast<int>(s.commandStatus);
    d["motion_state"] = static_cast<int>(s.motion_state);
    d["flag"] = s.motionFlag;
    d["enabled"] = (s.motionFlag & EMCMOT_MOTION_ENABLE_BIT) != 0;
    d["inpos"] = (s.motionFlag & EMCMOT_MOTION_INPOS_BIT) != 0;
    d["coord"] = (s.motionFlag & EMCMOT_MOTION_COORD_BIT) != 0;
    d["teleop"] = (s.motionFlag & EMCMOT_MOTION_TELEOP_BIT) != 0;
    d["error"] = (s.motionFlag & EMCMOT_MOTION_ERROR_BIT) != 0;
    d["carte_pos_cmd"] = tuple_of(s.carte_pos_cmd);
    d["carte_pos_cmd_ok"] = s.carte_pos_cmd_ok;
    d["carte_pos_fb"] = tuple_of(s.carte_pos_fb);
    d["carte_pos_fb_ok"] = s.carte_pos_fb_ok;
    d["feed_scale"] = s.feed_scale;
    d["rapid_scale"] = s.rapid_scale;
    d["net_feed_scale"] = s.net_feed_scale;
    d["enables_new"] = static_cast<int>(s.enables_new);
    d["enables_queued"] = static_cast<int>(s.enables_queued);
    d["on_soft_limit"] = s.on_soft_limit;
    d["probing"] = s.probing;
    d["probeTripped"] = s.probeTripped;
    d["probeVal"] = s.probeVal;
    d["probedPos"] = tuple_of(s.probedPos);
    d["heartbeat"] = s.heartbeat;
    d["config_num"] = s.config_num;
    d["id"] = s.id;
    d["depth"] = s.depth;
    d["activeDepth"] = s.activeDepth;
    d["queueFull"] = s.queueFull;
    d["paused"] = s.paused;
    d["stepping"] = s.stepping;
    d["overrideLimitMask"] = s.overrideLimitMask;
    d["reverse_run"] = s.reverse_run;
    d["motionType"] = s.motionType;
    d["distance_to_go"] = s.distance_to_go;
    d["current_vel"] = s.current_vel;
    d["vel"] = s.vel;
    d["acc"] = s.acc;
    d["jerk"] = s.jerk;
    d["requested_vel"] = s.requested_vel;
    d["planner_type"] = s.planner_type;
    d["scurve_peak_scale"] = s.scurve_peak_scale;
    d["tool_offset"] = tuple_of(s.tool_offset);
    d["atspeed_next_feed"] = s.atspeed_next_feed;
    d["eoffset_pose"] = tuple_of(s.eoffset_pose);
    d["external_offsets_applied"] = s.external_offsets_applied;
    d["jogging_active"] = s.jogging_active;
    d["spindleSync"] = s.spindleSync;
    py::list joints, spindles, di, dout, ai, ao;
    for (const auto &j : s.joint_status) joints.append(joint_dict(j));
    for (const auto &p : s.spindle_status) spindles.append(spindle_dict(p));
    for (int i = 0; i < EMCMOT_MAX_DIO; i++) {
        di.append(s.synch_di[i]);
        dout.append(s.synch_do[i]);
        ai.append(s.analog_input[i]);
        ao.append(s.analog_output[i]);
    }
    d["joint"] = joints;
    d["spindle"] = spindles;
    d["synch_di"] = di;
    d["synch_do"] = dout;
    d["analog_input"] = ai;
    d["analog_output"] = ao;
    return d;
}

py::dict config()
{
    static emcmot_config_t c;
    int r;
    do r = usrmotReadEmcmotConfig(&c);
    while (r == EMCMOT_COMM_SPLIT_READ_TIMEOUT);
    if (r != 0) throw std::runtime_error("not connected to motion");
    py::dict d;
    d["config_num"] = c.config_num;
    d["numJoints"] = c.numJoints;
    d["numExtraJoints"] = c.numExtraJoints;
    d["numSpindles"] = c.numSpindles;
    d["kinType"] = static_cast<int>(c.kinType);
    d["numDIO"] = c.numDIO;
    d["numAIO"] = c.numAIO;
    d["trajCycleTime"] = c.trajCycleTime;
    d["servoCycleTime"] = c.servoCycleTime;
    d["interpolationRate"] = c.interpolationRate;
    d["limitVel"] = c.limitVel;
    d["maxFeedScale"] = c.maxFeedScale;
    return d;
}

py::object error()
{
    char text[EMCMOT_ERROR_LEN];
    if (usrmotReadEmcmotError(text) != 0) return py::none();
    return py::str(py::bytes(text).attr("decode")("utf-8", "replace"));
}

const char *const names[] = {
    "ABORT", "ENABLE", "DISABLE", "PAUSE", "REVERSE", "FORWARD", "RESUME", "STEP", "FREE", "COORD", "TELEOP",
    "SPINDLE_SCALE", "SS_ENABLE", "FEED_SCALE", "RAPID_SCALE", "FS_ENABLE", "FH_ENABLE", "AF_ENABLE",
    "OVERRIDE_LIMITS", "SET_LINE", "SET_CIRCLE", "CLEAR_PROBE_FLAGS", "PROBE", "RIGID_TAP", "SET_VEL",
    "SET_VEL_LIMIT", "SET_ACC", "SET_JERK", "SET_PLANNER_TYPE", "SET_SCURVE_PEAK_SCALE", "SET_TERM_COND",
    "SET_NUM_JOINTS", "SET_NUM_SPINDLES", "SET_WORLD_HOME", "SET_DEBUG", "SET_DOUT", "SET_AOUT",
    "SET_SPINDLESYNC", "SPINDLE_ON", "SPINDLE_OFF", "SPINDLE_INCREASE", "SPINDLE_DECREASE",
    "SPINDLE_BRAKE_ENGAGE", "SPINDLE_BRAKE_RELEASE", "SPINDLE_ORIENT", "SET_OFFSET", "SET_MAX_FEED_OVERRIDE",
    "SETUP_ARC_BLENDS", "SET_PROBE_ERR_INHIBIT", "JOG_CONT", "JOG_INCR", "JOG_ABS", "JOG_ABORT",
    "JOINT_ACTIVATE", "JOINT_DEACTIVATE", "JOINT_HOME", "JOINT_UNHOME", "SET_JOINT_POSITION_LIMITS",
    "SET_JOINT_BACKLASH", "SET_JOINT_MIN_FERROR", "SET_JOINT_MAX_FERROR", "SET_JOINT_VEL_LIMIT",
    "SET_JOINT_ACC_LIMIT", "SET_JOINT_HOMING_PARAMS", "SET_JOINT_JERK_LIMIT", "UPDATE_JOINT_HOMING_PARAMS",
    "SET_JOINT_MOTOR_OFFSET", "SET_JOINT_COMP", "SET_AXIS_POSITION_LIMITS", "SET_AXIS_VEL_LIMIT",
    "SET_AXIS_ACC_LIMIT", "SET_AXIS_LOCKING_JOINT", "SET_AXIS_JERK_LIMIT", "SET_SPINDLE_PARAMS",
};
static_assert(sizeof(names) / sizeof(names[0]) == EMCMOT_SET_SPINDLE_PARAMS, "one name per command code");

} // namespace

PYBIND11_MODULE(kerf_motion, m)
{
    m.doc() = "Commands to and status of the motion controller, without task.";
    m.def("connect", [](int key, double timeout) {
        if (usrmotInit("kerf_motion", key, timeout) != 0) throw std::runtime_error("no motion segment");
    }, py::arg("key") = DEFAULT_SHMEM_KEY, py::arg("timeout") = DEFAULT_EMCMOT_COMM_TIMEOUT);
    m.def("disconnect", [] { usrmotExit(); });
    m.def("quiet", [](bool on) { usrmotSetQuiet(on); }, "do not print refused commands");
    m.def("send", &send);
    m.def(
        "load_comp",
        [](int joint, const std::string &file, int type) { return usrmotLoadComp(joint, file.c_str(), type); },
        py::arg("joint"), py::arg("file"), py::arg("type") = 0);
    m.def("status", &status);
    m.def("config", &config);
    m.def("error", &error);
    int code = 1;
    for (const char *name : names) m.attr(name) = code++;
}
